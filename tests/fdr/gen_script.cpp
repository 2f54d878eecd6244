#include "gen_script.hpp"

#include <array>
#include <ostream>
#include <random>
#include <set>

namespace perentie::test {
namespace {

constexpr std::size_t processes = 3;
constexpr std::array events{"a", "b", "c"};

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : engine_(seed) {}

  GenScript script() {
    GenScript made;
    for (std::size_t i = 0; i < processes; ++i) made.definitions.push_back(sequential(2, false));
    const std::size_t assertions = 1 + below(3);
    for (std::size_t i = 0; i < assertions; ++i) made.assertions.push_back(assertion());
    return made;
  }

 private:
  std::size_t below(std::size_t end) { return engine_() % end; }
  std::string event() { return events[below(events.size())]; }
  std::string name() { return "P" + std::to_string(below(processes)); }
  // A set of one or two events, seldom empty.
  std::string set() {
    if (below(12) == 0) return "{}";
    const std::string first = event();
    const std::string second = event();
    return first == second ? "{" + first + "}" : "{" + first + ", " + second + "}";
  }

  // A process without operators that stay in place. A name is guarded by an event before it.
  GenTerm sequential(int depth, bool guarded) {
    const std::size_t kind = below(guarded ? 10 : 6);
    if (kind >= 8 || (depth == 0 && kind >= 6)) return {name()};
    if (kind == 7) return {below(2) == 0 ? "STOP" : "SKIP"};
    if (depth == 0) return {event() + " -> %", {guarded_end()}};
    if (kind == 4) return binary("% [] %", depth, guarded);
    if (kind == 5) return binary("% |~| %", depth, guarded);
    return {event() + " -> %", {sequential(depth - 1, true)}};
  }
  GenTerm binary(const char* shape, int depth, bool guarded) {
    GenTerm left = sequential(depth - 1, guarded);
    return {shape, {std::move(left), sequential(depth - 1, guarded)}};
  }
  GenTerm guarded_end() {
    const std::size_t kind = below(6);
    return {kind == 0 ? "STOP" : kind == 1 ? "SKIP" : name()};
  }

  GenTerm process(int depth) {
    if (depth == 0 || below(6) == 0) return leaf();
    switch (below(21)) {
      case 0:
      case 1:
        return {"% \\ " + set(), {process(depth - 1)}};
      case 2:
        return {"% |\\ " + set(), {process(depth - 1)}};
      case 3:
        return {"%[[" + event() + " <- " + event() + "]]", {process(depth - 1)}};
      case 4:
        return {"normal(%)", {process(depth - 1)}};
      case 5:
        return {"prioritise(%, <" + set() + ", {" + event() + "}>)", {process(depth - 1)}};
      case 6:
        return {event() + " -> %", {process(depth - 1)}};
      case 7:
        return two("% ||| %", depth);
      case 8:
      case 9:
      case 10:
        return two("% [|" + set() + "|] %", depth);
      case 11:
        return two("% [" + set() + " || " + set() + "] %", depth);
      case 12:
        return two("% [] %", depth);
      case 13:
        return two("% |~| %", depth);
      case 14:
        return two("% ; %", depth);
      case 15:
        return two("% /\\ %", depth);
      case 16:
        return two("% [> %", depth);
      case 17:
        return two("% [|" + set() + "|> %", depth);
      case 18:
        return two("% [+" + set() + "+] %", depth);
      case 19:
        return two("% /+" + set() + "+\\ %", depth);
      default:
        return two("% [" + event() + " <-> " + event() + "] %", depth);
    }
  }
  GenTerm two(std::string shape, int depth) {
    GenTerm left = process(depth - 1);
    return {std::move(shape), {std::move(left), process(depth - 1)}};
  }
  GenTerm leaf() {
    switch (below(12)) {
      case 0:
        return {"STOP"};
      case 1:
        return {"SKIP"};
      case 2:
        return {below(3) == 0 ? "DIV" : "CHAOS(" + set() + ")"};
      case 3:
        return {"RUN(" + set() + ")"};
      case 4:
        return {event() + " -> %", {GenTerm{name()}}};
      default:
        return {name()};
    }
  }

  GenTerm assertion() {
    constexpr std::array models{"T", "F", "FD"};
    const std::string negation = below(6) == 0 ? "not " : "";
    const int depth = 1 + static_cast<int>(below(2));
    switch (below(8)) {
      case 0:
        return {negation + "% :[deadlock free [" + models[1 + below(2)] + "]]", {process(depth)}};
      case 1:
        return {negation + "% :[divergence free [FD]]", {process(depth)}};
      case 2:
        return {negation + "% :[deterministic [" + models[1 + below(2)] + "]]", {process(depth)}};
      case 3: {
        std::string trace = event();
        for (std::size_t i = below(3); i > 0; --i) trace += ", " + event();
        const std::string model = models[below(3)];
        return {negation + "% :[has trace [" + model + "]]: <" + trace + ">", {process(depth)}};
      }
      default: {
        const std::string priority = below(6) == 0 ? " :[tau priority]: " + set() : "";
        GenTerm made = two(negation + "% [" + models[below(3)] + "= %" + priority, depth + 1);
        // A refinement that may hold: the implementation is one choice of the specification.
        if (below(3) == 0) {
          made.operands[0] = {below(2) == 0 ? "% |~| %" : "% [] %",
                              {made.operands[1], made.operands[0]}};
        }
        return made;
      }
    }
  }

  std::mt19937_64 engine_;
};

// A process that needs no brackets as an operand.
bool is_atom(const GenTerm& term) {
  return term.operands.empty() || (term.shape.back() == ')' && term.shape[0] != '%');
}

bool is_prefix(const GenTerm& term) { return term.shape.find(" -> %") != std::string::npos; }

void print(const GenTerm& term, std::string& out) {
  std::size_t next = 0;
  for (const char c : term.shape) {
    if (c != '%') {
      out += c;
      continue;
    }
    const GenTerm& operand = term.operands[next++];
    const bool bare = is_atom(operand) || (is_prefix(term) && is_prefix(operand));
    if (!bare) out += '(';
    print(operand, out);
    if (!bare) out += ')';
  }
}

bool is_name(const GenTerm& term) { return term.operands.empty() && term.shape[0] == 'P'; }

void collect_names(const GenTerm& term, std::vector<std::size_t>& names) {
  if (is_name(term)) names.push_back(std::stoul(term.shape.substr(1)));
  for (const GenTerm& operand : term.operands) collect_names(operand, names);
}

// Simpler terms, one step each. A term that need not be guarded may be a name.
std::vector<GenTerm> simpler(const GenTerm& term, bool guarded) {
  std::vector<GenTerm> found;
  if (term.shape != "STOP") found.push_back({"STOP"});
  for (const GenTerm& operand : term.operands) {
    if (guarded || !is_prefix(term)) found.push_back(operand);
  }
  for (std::size_t i = 0; i < term.operands.size(); ++i) {
    for (GenTerm& smaller : simpler(term.operands[i], guarded || is_prefix(term))) {
      found.push_back(term);
      found.back().operands[i] = std::move(smaller);
    }
  }
  return found;
}

}  // namespace

std::string to_text(const GenScript& script) {
  std::vector<std::size_t> stack;
  for (const GenTerm& assertion : script.assertions) collect_names(assertion, stack);
  std::set<std::size_t> names;
  while (!stack.empty()) {
    const std::size_t name = stack.back();
    stack.pop_back();
    if (names.insert(name).second) collect_names(script.definitions[name], stack);
  }
  std::string text = "channel a, b, c\ntransparent normal\nexternal prioritise\n";
  for (const std::size_t name : names) {
    text += "P" + std::to_string(name) + " = ";
    print(script.definitions[name], text);
    text += '\n';
  }
  for (const GenTerm& assertion : script.assertions) {
    text += "assert ";
    print(assertion, text);
    text += '\n';
  }
  return text;
}

void showValue(const GenScript& script, std::ostream& out) { out << '\n' << to_text(script); }

std::vector<GenScript> simpler(const GenScript& script) {
  std::vector<GenScript> found;
  for (std::size_t i = 0; script.assertions.size() > 1 && i < script.assertions.size(); ++i) {
    found.push_back(script);
    found.back().assertions.erase(found.back().assertions.begin() + static_cast<std::ptrdiff_t>(i));
  }
  for (std::size_t i = 0; i < script.assertions.size(); ++i) {
    for (std::size_t j = 0; j < script.assertions[i].operands.size(); ++j) {
      for (GenTerm& smaller : simpler(script.assertions[i].operands[j], true)) {
        found.push_back(script);
        found.back().assertions[i].operands[j] = std::move(smaller);
      }
    }
  }
  for (std::size_t i = 0; i < script.definitions.size(); ++i) {
    for (GenTerm& smaller : simpler(script.definitions[i], false)) {
      found.push_back(script);
      found.back().definitions[i] = std::move(smaller);
    }
  }
  return found;
}

rc::Gen<GenScript> gen_script() {
  return [](const rc::Random& random, int) {
    rc::Random source = random;
    return rc::shrinkable::shrinkRecur(Maker(source.next()).script(), [](const GenScript& script) {
      return rc::seq::fromContainer(simpler(script));
    });
  };
}

}  // namespace perentie::test
