#include "witness_text.hpp"

#include <fmt/format.h>

namespace perentie::cli {

using semantics::Witness;

std::string set_of(const std::vector<std::string>& events) {
  return fmt::format("{{{}}}", fmt::join(events, ", "));
}

std::string trace_of(const std::vector<std::string>& events) {
  return fmt::format("<{}>", fmt::join(events, ", "));
}

std::string behaviour_of(const Witness& w) {
  switch (w.kind) {
    case Witness::Kind::event:
      return fmt::format("it performs {}", w.event);
    case Witness::Kind::acceptance:
      return fmt::format("it offers only {}", set_of(w.offered));
    case Witness::Kind::divergence:
      return "it diverges: it performs τ for ever";
    case Witness::Kind::deadlock:
      return !w.trace.empty() && w.trace.back() == lts::tick_name
                 ? "it has terminated, which counts as a deadlock"
                 : "it is deadlocked";
    case Witness::Kind::nondeterminism:
      return fmt::format("it may perform {} and may refuse it, offering only {}", w.event,
                         set_of(w.offered));
    case Witness::Kind::missing_event:
      return w.is_refused
                 ? fmt::format("it may refuse {}, offering only {}", w.event, set_of(w.offered))
                 : fmt::format("it cannot perform {}", w.event);
  }
  return {};
}

std::vector<std::string> observations_of(const Witness& w) {
  std::vector<std::string> lines;
  for (const Witness::Observation& o : w.observed) {
    const std::vector<std::string> before(w.trace.begin(),
                                          w.trace.begin() + static_cast<std::ptrdiff_t>(o.place));
    lines.push_back(fmt::format("offering only {} after {}", set_of(o.offered), trace_of(before)));
  }
  return lines;
}

std::string expectation_of(const Witness& w) {
  if (w.kind == Witness::Kind::event && !w.allowed.empty()) {
    return fmt::format("the specification allows {}", set_of(w.allowed.front()));
  }
  if (w.kind != Witness::Kind::acceptance) return {};
  std::vector<std::string> sets;
  for (const auto& acceptance : w.allowed) sets.push_back(set_of(acceptance));
  return sets.empty() ? "the specification is never stable here"
         : w.is_exact
             ? fmt::format("the specification offers {}", fmt::join(sets, " or "))
             : fmt::format("the specification offers at least {}", fmt::join(sets, " or "));
}

}  // namespace perentie::cli
