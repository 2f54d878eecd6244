#include "show_definitions.hpp"

#include <unordered_set>
#include <vector>

namespace perentie::semantics {
namespace {

// Long enough for the names that are looked for.
constexpr std::size_t longest_known_name = 20;

// FDR knows these by name alone, and prints them as defined by themselves.
bool is_buffer(const std::string& name) {
  for (const char* buffer : {"BUFFER(", "WEAK_BUFFER(", "SIGNAL_BUFFER("}) {
    if (name.starts_with(buffer)) return true;
  }
  return false;
}

}  // namespace

std::optional<std::string> show_definitions(
    const ShowContext& context, ProcId process,
    const std::function<std::optional<ProcId>(ProcId call)>& unfold) {
  std::vector<std::string> definitions;  // in the order in which they are met
  const auto define = [&](ProcId name, ProcId body) {
    definitions.push_back(lay_out_definition(context, name, body));
  };
  std::vector<ProcId> stack{process};
  std::unordered_set<std::uint32_t> seen;
  while (!stack.empty()) {
    const ProcId term = stack.back();
    stack.pop_back();
    if (!seen.insert(term.value).second) continue;
    const ProcKind kind = context.processes.kind(term);
    if (kind == ProcKind::call || kind == ProcKind::opaque) {
      const std::string name = show_process(context, term, longest_known_name);
      if (kind == ProcKind::opaque) {
        if (is_buffer(name)) define(term, term);
        continue;
      }
      const std::optional<ProcId> body = unfold(term);  // which may refuse the arguments
      if (!body) return std::nullopt;
      if (is_buffer(name)) {
        define(term, term);
        continue;
      }
      if (!name.starts_with("STOP(")) define(term, *body);  // FDR does not define it either
      stack.push_back(*body);
    } else if (kind == ProcKind::skip) {
      definitions.emplace_back("SKIP = ✓ -> STOP");
    } else if (kind == ProcKind::run || kind == ProcKind::chaos || kind == ProcKind::div) {
      define(term, term);
    }
    const auto places = process_operands(kind);
    if (!places) continue;
    std::vector<ProcId> operands;
    const auto words = context.processes.words(term);
    for (std::size_t i = places->first; i < words.size(); i += places->stride) {
      operands.push_back(ProcId{words[i]});
    }
    stack.insert(stack.end(), operands.rbegin(), operands.rend());
  }
  std::string text;
  for (auto definition = definitions.rbegin(); definition != definitions.rend(); ++definition) {
    text += *definition + "\n\n";
  }
  return text + lay_out_process(context, process);
}

}  // namespace perentie::semantics
