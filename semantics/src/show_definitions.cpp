#include "show_definitions.hpp"

#include <unordered_set>
#include <vector>

#include <fmt/format.h>

namespace perentie::semantics {
namespace {

constexpr std::size_t unlimited = std::string::npos / 4;
constexpr std::size_t line_width = 80;

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
  const auto show = [&](ProcId term) { return show_process(context, term, unlimited); };
  std::vector<std::string> definitions;  // in the order in which they are met
  const auto define = [&](const std::string& name, const std::string& body) {
    const bool fits = name.size() + 3 + body.size() <= line_width;
    definitions.push_back(fits ? fmt::format("{} = {}", name, body)
                               : fmt::format("{} =\n    {}", name, body));
  };
  std::vector<ProcId> stack{process};
  std::unordered_set<std::uint32_t> seen;
  while (!stack.empty()) {
    const ProcId term = stack.back();
    stack.pop_back();
    if (!seen.insert(term.value).second) continue;
    const ProcKind kind = context.processes.kind(term);
    if (kind == ProcKind::call || kind == ProcKind::opaque) {
      const std::string name = show(term);
      if (is_buffer(name)) {
        define(name, name);
        continue;
      }
      if (kind == ProcKind::opaque) continue;
      const std::optional<ProcId> body = unfold(term);
      if (!body) return std::nullopt;
      if (!name.starts_with("STOP(")) define(name, show(*body));  // FDR does not define it either
      stack.push_back(*body);
    } else if (kind == ProcKind::skip) {
      define("SKIP", "✓ -> STOP");
    } else if (kind == ProcKind::run || kind == ProcKind::chaos || kind == ProcKind::div) {
      define(show(term), show(term));
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
  return text + show(process);
}

}  // namespace perentie::semantics
