#include "repl.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "check_report.hpp"
#include "perentie/base/text.hpp"
#include "perentie/parser/parse.hpp"
#include "perentie/semantics/check.hpp"

namespace perentie::cli {
namespace {

struct CommandInfo {
  std::string_view word;
  std::string_view arguments;
  std::string_view help;
};

constexpr auto commands = std::to_array<CommandInfo>({
    {"assertions", "", "the assertions of the script, as `perentie check` numbers them"},
    {"help", "", "this list"},
    {"load", "FILE", "load a script; definitions made with `let` are forgotten"},
    {"processes", "", "the processes of the script"},
    {"quit", "", "leave (as Ctrl-D does)"},
    {"reload", "", "load the same script again"},
    {"run", "N", "check the assertion of this number"},
    {"type", "EXPR", "the type of an expression"},
});

// Declarations that only a script can hold.
constexpr std::array script_words = std::to_array<std::string_view>(
    {"channel", "datatype", "subtype", "nametype", "module", "instance", "include", "Timed"});

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view first_word(std::string_view text) {
  const auto end = std::find_if(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '\'';
  });
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

// The expressions of an assertion.
std::vector<parser::ExprId> expressions_of(const parser::SyntaxTree& tree,
                                           const parser::Assertion& assertion) {
  std::vector<parser::ExprId> found;
  if (const auto* r = std::get_if<parser::RefinementAssertion>(&assertion.claim)) {
    found = {r->specification, r->implementation};
  } else if (const auto* p = std::get_if<parser::PropertyAssertion>(&assertion.claim)) {
    found = {p->process};
  } else {
    const auto& trace = std::get<parser::HasTraceAssertion>(assertion.claim);
    const auto events = tree.list(trace.trace);
    found = {trace.process};
    found.insert(found.end(), events.begin(), events.end());
  }
  if (assertion.options.tau_priority) found.push_back(assertion.options.tau_priority);
  return found;
}

// A script of nothing, so that expressions can be evaluated before one is loaded.
std::unique_ptr<semantics::Script> empty_script(Input& input) {
  const auto file = input.sources.add("<nothing>", "");
  return semantics::Script::load(*file, input.sources, input.diagnostics);
}

}  // namespace

bool Repl::load(const std::string& path) {
  auto session = std::make_unique<Session>();
  path_ = path;
  definitions_.clear();
  if (const auto file = session->input.read(path)) {
    session->script =
        semantics::Script::load(*file, session->input.sources, session->input.diagnostics);
  }
  const bool ok = session->script != nullptr;
  open(std::move(session));
  return ok;
}

void Repl::forget_diagnostics(Input& input) {
  input.diagnostics.clear();
  console_.forget_printed();
}

void Repl::open(std::unique_ptr<Session> session) {
  console_.print(session->input.diagnostics, session->input.sources);
  forget_diagnostics(session->input);
  if (!session->script) session->script = empty_script(session->input);
  session->assertions = semantics::assertions_of(session->script->tree());
  session->script->show_calls(call_stack_);
  session_ = std::move(session);
}

std::string Repl::name() const {
  return path_.empty() ? "perentie" : std::filesystem::path(path_).filename().string();
}

bool Repl::answer(std::string_view line) {
  if (!session_) {
    auto session = std::make_unique<Session>();
    session->script = empty_script(session->input);
    open(std::move(session));
  }
  const std::string_view text = trimmed(line);
  if (text.empty() || text.starts_with("--")) return true;
  if (text.front() == ':') return command(text.substr(1));
  session_->script->set_limits(budget_.limits());
  const std::string_view word = first_word(text);
  // `let d within e` is an expression.
  if (word == "let" && text.find(" within ") == std::string_view::npos) {
    define(std::string(text.substr(word.size())));
  } else if (word == "transparent" || word == "external") {
    define(std::string(text));
  } else if (word == "assert") {
    claim(std::string(text));
  } else if (word == "print") {
    evaluate(std::string(text.substr(word.size())));
  } else if (std::ranges::find(script_words, word) != script_words.end()) {
    console_.error(fmt::format(
        "`{}` belongs into a script: write it there and `:load` that. Here are expressions, `let`, "
        "`transparent`, `external`, `assert` and `print`",
        word));
  } else {
    evaluate(std::string(text));
  }
  return true;
}

// Each `let` is in the scope of those before it, so earlier ones keep the names that they saw.
std::string Repl::in_scope(const std::string& expression) const {
  std::string text;
  for (const std::string& definitions : definitions_) {
    text += fmt::format("let\n{}\nwithin ", definitions);
  }
  return text + expression;
}

void Repl::report(bool answered) {
  Input& input = session_->input;
  console_.print(input.diagnostics, input.sources);
  if (!answered) {
    if (const auto limit = session_->script->limit()) {
      console_.error(fmt::format("inconclusive: {}", base::describe(*limit)));
    }
  }
  forget_diagnostics(input);
}

void Repl::evaluate(const std::string& expression) {
  semantics::Script& script = *session_->script;
  base::Diagnostics& diagnostics = session_->input.diagnostics;
  std::optional<std::string> value;
  if (const auto read = script.expression(in_scope(expression), diagnostics)) {
    if (script.type_of(*read) != "Proc") {
      value = script.evaluate(*read, diagnostics);
    } else if (const auto process = script.process(*read, diagnostics)) {
      value = script.definitions(*process, diagnostics);
    }
  }
  if (value) console_.result(*value + '\n');
  report(value.has_value());
}

void Repl::show_type(const std::string& expression) {
  semantics::Script& script = *session_->script;
  const auto read = script.expression(in_scope(expression), session_->input.diagnostics);
  if (read) console_.result(fmt::format("{} :: {}\n", expression, script.type_of(*read)));
  report(true);
}

void Repl::define(const std::string& definitions) {
  definitions_.push_back(definitions);
  const bool ok =
      session_->script->expression(in_scope("true"), session_->input.diagnostics).has_value();
  if (!ok) definitions_.pop_back();
  report(true);
}

// The text of an assertion whose expressions see the definitions of the session.
std::string Repl::assertion_in_scope(const std::string& text) const {
  base::SourceMap sources;
  base::Diagnostics ignored;  // what is wrong is reported when the text is read in its scope
  parser::SyntaxTree tree;
  const auto file = sources.add("", text);
  const auto assertion = parser::parse_assertion(*file, tree, sources, ignored);
  if (!assertion || definitions_.empty()) return text;
  std::vector<base::Span> spans;
  for (const parser::ExprId e : expressions_of(tree, *assertion)) {
    spans.push_back(tree.exprs[e].span);
  }
  std::ranges::sort(spans, {}, &base::Span::begin);
  std::string result;
  std::uint32_t end = 0;
  for (const base::Span& span : spans) {
    result += text.substr(end, span.begin - end);
    result += fmt::format("({})", in_scope(text.substr(span.begin, span.end - span.begin)));
    end = span.end;
  }
  return result + text.substr(end);
}

void Repl::claim(const std::string& assertion) {
  auto claimed =
      session_->script->assertion(assertion_in_scope(assertion), session_->input.diagnostics);
  if (claimed) {
    claimed->text = trimmed(std::string_view(assertion).substr(std::string_view("assert").size()));
    session_->assertions.push_back(std::move(*claimed));
    const std::size_t number = session_->assertions.size();
    console_.result(fmt::format("assertion {0} (check it with `:run {0}`)\n", number));
  }
  report(claimed.has_value());
}

void Repl::run(const std::string& number) {
  const auto& assertions = session_->assertions;
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), n);
  if (error != std::errc() || *end != '\0' || n == 0 || n > assertions.size()) {
    console_.error(
        fmt::format("there is no assertion {}: there are {}", number, assertions.size()));
    return;
  }
  Input& input = session_->input;
  CheckedAssertion checked{n, &assertions[n - 1], {}, {}, {}};
  checked.result =
      semantics::check(*session_->script, assertions[n - 1],
                       {.limits = budget_.limits(), .progress = {}}, input.diagnostics);
  console_.result(assertion_as_text(checked, {.sources = input.sources, .file = path_}));
  report(true);
}

void Repl::show_processes() {
  for (const std::string& process : session_->script->process_names()) {
    console_.result(process + '\n');
  }
}

void Repl::show_assertions() {
  std::size_t number = 0;
  for (const auto& assertion : session_->assertions) {
    console_.result(fmt::format("{}. {}\n", ++number, assertion.text));
  }
}

void Repl::help() const {
  console_.result(
      "An expression is evaluated; `let f(x) = x + 1` adds a definition, `transparent normal` and\n"
      "`external prioritise` import, `assert STOP [T= STOP` adds an assertion.\n");
  for (const CommandInfo& c : commands) {
    console_.result(fmt::format("  :{:<10} {:<5} {}\n", c.word, c.arguments, c.help));
  }
}

// Commands may be cut short as long as it is clear which one is meant.
bool Repl::command(std::string_view line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  const std::string argument(trimmed(line.substr(end)));
  std::vector<const CommandInfo*> meant;
  for (const CommandInfo& c : commands) {
    if (!word.empty() && c.word.starts_with(word)) meant.push_back(&c);
  }
  if (meant.size() > 1) {
    std::vector<std::string> words;
    for (const CommandInfo* c : meant) words.push_back(fmt::format("`:{}`", c->word));
    console_.error(fmt::format("`:{}` may be {}", word, fmt::join(words, " or ")));
    return true;
  }
  if (meant.empty()) {
    std::vector<std::string_view> words;
    for (const CommandInfo& c : commands) words.push_back(c.word);
    const auto near = base::nearest_words(word, words);
    console_.error(fmt::format(
        "there is no command `:{}`; {}", word,
        near.empty() ? "`:help` lists them" : fmt::format("did you mean `:{}`?", near.front())));
    return true;
  }
  const std::string_view chosen = meant.front()->word;
  if (!meant.front()->arguments.empty() && argument.empty()) {
    console_.error(fmt::format("`:{}` needs {}", chosen, meant.front()->arguments));
    return true;
  }
  if (chosen == "quit") return false;
  if (chosen == "assertions") show_assertions();
  if (chosen == "help") help();
  if (chosen == "load") load(argument);
  if (chosen == "processes") show_processes();
  if (chosen == "run") run(argument);
  if (chosen == "type") show_type(argument);
  if (chosen == "reload") {
    if (path_.empty()) {
      console_.error("no script is loaded");
    } else {
      load(std::string(path_));
    }
  }
  return true;
}

std::vector<std::string> Repl::completions(std::string_view word) const {
  std::vector<std::string> found;
  const auto add = [&](std::string_view candidate) {
    if (candidate.starts_with(word)) found.emplace_back(candidate);
  };
  if (word.starts_with(":")) {
    for (const CommandInfo& c : commands) add(fmt::format(":{}", c.word));
  } else {
    if (session_) {
      for (const auto& definition : session_->script->types()) add(definition.name);
    }
    for (const semantics::BuiltinInfo& builtin : semantics::builtin_table) {
      if (builtin.import == semantics::Import::no) add(builtin.name);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace perentie::cli
