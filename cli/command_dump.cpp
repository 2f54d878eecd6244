// perentie dump: what one phase makes of a script, as text.
#include <memory>

#include "commands.hpp"
#include "model.hpp"
#include "perentie/parser/dump.hpp"
#include "perentie/parser/lexer.hpp"
#include "perentie/parser/parse.hpp"
#include "perentie/parser/print.hpp"

namespace perentie::cli {
namespace {

struct Options {
  std::string file;
  std::string phase = "ast";
};

ExitCode dump(const Options& options, Console& console) {
  Input input;
  const auto file = input.read(options.file);
  if (!file) {
    console.print(input.diagnostics, input.sources);
    return ExitCode::io_error;
  }
  std::string text;
  if (options.phase == "tokens") {
    base::Interner names;
    const parser::TokenStream tokens = parser::lex(*file, input.sources, names, input.diagnostics);
    text = parser::dump_tokens(tokens, names, input.sources);
  } else if (options.phase == "core") {
    const auto script = semantics::Script::load(*file, input.sources, input.diagnostics);
    if (script != nullptr) text = script->core_listing();
  } else {
    const parser::SyntaxTree tree = parser::parse_script(*file, input.sources, input.diagnostics);
    text =
        options.phase == "ast" ? parser::dump_ast(tree, input.sources) : parser::print_script(tree);
  }
  console.result(text);
  console.print(input.diagnostics, input.sources);
  return input.diagnostics.has_errors() ? ExitCode::model_error : ExitCode::ok;
}

}  // namespace

Command add_dump(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("dump", "Show what a phase makes of a script");
  app->add_option("FILE", options->file, "The CSPM script")->required();
  app->add_option("--phase", options->phase,
                  "tokens, ast (the tree), print (the tree as CSPM), or core (machine code)")
      ->check(CLI::IsMember({"tokens", "ast", "print", "core"}))
      ->capture_default_str();
  app->footer("Example:\n  perentie dump corpus/rover/rover.csp --phase tokens");
  return {app, [options](Console& console) { return dump(*options, console); }};
}

}  // namespace perentie::cli
