#include "perentie/semantics/explain.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "perentie/base/overload.hpp"
#include "preserved_in_script.hpp"
#include "replay.hpp"

namespace perentie::semantics {
namespace {

constexpr std::size_t max_nesting = 500;  // of components in components
constexpr std::size_t max_term_length = 200;
constexpr std::size_t max_name_length = 60;  // of components in sentences

parser::ExprId implementation_of(const parser::Assertion& assertion) {
  return std::visit(
      base::overload{[](const parser::RefinementAssertion& claim) { return claim.implementation; },
                     [](const auto& claim) { return claim.process; }},
      assertion.claim);
}

bool is_about_traces(const parser::Assertion& assertion) {
  return std::holds_alternative<parser::HasTraceAssertion>(assertion.claim);
}

// A run with what comes after it.
struct Ending {
  Behaviour::Kind kind = Behaviour::Kind::trace;
  std::optional<Step> event;  // of kind trace
  std::size_t loop_start = 0;
};

class Explainer {
 public:
  Explainer(Script& script, const ScriptAssertion& assertion, const Witness& witness,
            const ExplainOptions& options)
      : script_(script), assertion_(assertion), witness_(witness), options_(options) {}

  std::optional<Explanation> run() {
    script_.set_limits(options_.limits);
    const auto process =
        script_.process(implementation_of(assertion_.assertion), assertion_, sink_);
    if (!process) return std::nullopt;
    // Components are those of the processes themselves, not of what compressions make of them.
    const PreservedInScript scope(script_, Preserved::identity);
    system_.emplace(script_.terms(*process, sink_));
    Run run;
    Ending ending;
    if (!find(run, ending)) return std::nullopt;
    Explanation found;
    found.implementation = behaviour(run, ending, 0);
    name_process(found.implementation, script_.name(*process));
    found.revealed_trace = revealed(run);
    if (ending.kind == Behaviour::Kind::acceptance) {
      const ProcId last =
          run.labels.empty() ? system_->terms().body(run.states[0]) : run.states.back();
      add_blocked(last, found.implementation, found.blocked);
    }
    add_specification(found);
    return found;
  }

 private:
  // The run that the witness speaks of.
  bool find(Run& run, Ending& ending) {
    using Kind = Witness::Kind;
    RunSearch search{.trace = witness_.trace,
                     .skips_tau = is_about_traces(assertion_.assertion),
                     .ends_well = {},
                     .limits = options_.limits};
    std::optional<TauLoop> loop;
    std::vector<std::string> offered = witness_.offered;
    std::ranges::sort(offered);
    const bool needs_acceptance = witness_.kind != Kind::missing_event || witness_.is_refused;
    search.ends_well = [&](ProcId state) {
      switch (witness_.kind) {
        case Kind::event:
          return step_by_name(state, witness_.event).has_value();
        case Kind::divergence:
          loop = find_tau_loop(*system_, state, options_.limits);
          return loop.has_value();
        default: {
          if (!needs_acceptance) return true;
          const auto labels = system_->offers(state);
          if (!labels) return false;
          std::vector<std::string> names = names_of(*labels);
          std::ranges::sort(names);
          return witness_.kind == Kind::deadlock ? names.empty() : names == offered;
        }
      }
    };
    auto found = find_run(*system_, search);
    if (!found) {  // a compressed process may have other τ
      std::erase(search.trace, lts::tau_name);
      search.skips_tau = true;
      found = find_run(*system_, search);
    }
    if (!found) return false;
    run = std::move(*found);
    if (witness_.kind == Kind::event) {
      ending.event = step_by_name(run.states.back(), witness_.event);
    } else if (witness_.kind == Kind::divergence) {
      ending = {Behaviour::Kind::loop, {}, run.labels.size() + loop->loop_start};
      run.labels.insert(run.labels.end(), loop->run.labels.begin(), loop->run.labels.end());
      run.states.insert(run.states.end(), loop->run.states.begin() + 1, loop->run.states.end());
    } else if (needs_acceptance) {
      ending.kind = Behaviour::Kind::acceptance;
    }
    return true;
  }

  std::optional<Step> step_by_name(ProcId state, const std::string& event) {
    for (const Step& step : system_->steps(state)) {
      if (system_->name(step.label) == event) return step;
    }
    return std::nullopt;
  }

  std::vector<std::string> names_of(const std::vector<lts::Label>& labels) {
    std::vector<std::string> names;
    for (const lts::Label label : labels) names.push_back(system_->name(label));
    return names;
  }

  // The process of an assertion keeps its name where its first state has none or another one.
  static void name_process(Behaviour& b, const std::string& name) {
    b.name = name;
    if (!name.empty()) b.states[0] = {name, true};
  }

  // --- Division ---

  Behaviour behaviour(const Run& run, const Ending& ending, std::size_t nesting) {
    Behaviour b{.kind = ending.kind, .name = {}, .loop_start = ending.loop_start};
    for (const lts::Label label : run.labels) {
      b.trace.push_back(label ? system_->name(label) : std::string());
    }
    for (const ProcId state : run.states) {
      const auto definition = system_->terms().definition(state);
      if (definition) b.definition = definition;
      b.states.push_back({script_.show(state, max_term_length), definition.has_value()});
    }
    if (ending.event) b.event = system_->name(ending.event->label);
    if (ending.kind == Behaviour::Kind::acceptance) {
      if (const auto labels = system_->offers(run.states.back())) {
        b.acceptance = names_of(*labels);
        std::ranges::sort(b.acceptance);
      }
    }
    if (options_.with_components && nesting < max_nesting) divide(run, ending, nesting, b);
    return b;
  }

  // Adds the behaviours of the components, if the operator stays in place during the whole run.
  void divide(const Run& run, const Ending& ending, std::size_t nesting, Behaviour& whole) {
    TermSystem& terms = system_->terms();
    const ProcId first = nesting == 0 ? terms.body(run.states[0]) : run.states[0];
    const std::vector<ProcId> components = terms.components(first);
    if (components.empty()) return;
    std::vector<Run> runs;
    for (const ProcId component : components) runs.push_back({{component}, {}});
    for (std::size_t i = 0; i < run.labels.size(); ++i) {
      const lts::Label label = run.labels[i];
      for (Run& r : runs) {
        r.labels.emplace_back();
        r.states.push_back(r.states.back());
      }
      if (!label) continue;
      const auto shares = terms.shares(i == 0 ? first : run.states[i], label, run.states[i + 1]);
      if (!shares) return;
      for (const TransitionShare& share : *shares) {
        runs[share.component].labels.back() = share.label;
        runs[share.component].states.back() = share.target;
      }
    }
    std::vector<Ending> endings(components.size(), {ending.kind, {}, ending.loop_start});
    if (ending.event) {
      const ProcId last = run.labels.empty() ? first : run.states.back();
      const auto shares = terms.shares(last, ending.event->label, ending.event->target);
      if (!shares) return;
      for (const TransitionShare& share : *shares) {
        endings[share.component].event = Step{share.label, share.target};
      }
    }
    for (std::size_t i = 0; i < components.size(); ++i) {
      Behaviour part = behaviour(runs[i], endings[i], nesting + 1);
      part.name = part.states[0].term;
      whole.components.push_back(std::move(part));
    }
  }

  std::vector<std::string> revealed(const Run& run) {
    std::vector<std::string> trace;
    for (std::size_t i = 0; i < run.labels.size(); ++i) {
      lts::Label label = run.labels[i];
      ProcId from = run.states[i];
      ProcId to = run.states[i + 1];
      for (std::size_t depth = 0; label == lts::tau && depth < max_nesting; ++depth) {
        from = system_->terms().body(from);
        const auto shares = system_->terms().shares(from, label, to);
        if (!shares) break;
        const TransitionShare& share = shares->front();
        const auto components = system_->terms().components(from);
        from = components[share.component];
        label = share.label;
        to = share.target;
      }
      trace.push_back(system_->name(label));
    }
    return trace;
  }

  // --- Who prevents what ---

  void add_blocked(ProcId state, const Behaviour& whole, std::vector<Blocked>& found) {
    TermSystem& terms = system_->terms();
    const std::vector<ProcId> components = terms.components(state);
    if (components.size() != whole.components.size()) return;
    std::vector<std::vector<lts::Label>> offers;
    for (const ProcId component : components) {
      offers.push_back(system_->offers(component).value_or(std::vector<lts::Label>{}));
    }
    for (std::size_t i = 0; i < components.size(); ++i) {
      for (const lts::Label label : offers[i]) {
        const auto partners = terms.partners(state, i, label);
        const bool is_outside = !std::ranges::binary_search(partners, i);
        Blocked blocked{
            system_->name(label), leaf_that_offers(components[i], label, whole.components[i]), {}};
        for (const std::size_t p : partners) {
          if (is_outside || std::ranges::binary_search(offers[p], label)) continue;
          add_leaves_that_know(components[p], label, whole.components[p], blocked.refusing);
        }
        if (is_outside || !blocked.refusing.empty()) found.push_back(std::move(blocked));
      }
      add_blocked(components[i], whole.components[i], found);
    }
  }

  // The component of `whole`, or of one of its components, that performs the event of a state.
  std::string leaf_that_offers(ProcId state, lts::Label label, const Behaviour& whole) {
    const Behaviour* leaf = &whole;
    for (std::size_t depth = 0; depth < max_nesting; ++depth) {
      const auto components = system_->terms().components(state);
      const auto steps = system_->steps(state);
      const auto step =
          std::ranges::find_if(steps, [&](const Step& s) { return s.label == label; });
      if (components.size() != leaf->components.size() || step == steps.end()) break;
      const auto shares = system_->terms().shares(state, label, step->target);
      if (!shares || shares->size() != 1) break;
      const TransitionShare& share = shares->front();
      leaf = &leaf->components[share.component];
      state = components[share.component];
      label = share.label;
    }
    return short_name(leaf->name);
  }

  // The components that can perform an event sooner or later; if none is known to, the whole.
  void add_leaves_that_know(ProcId state, lts::Label label, const Behaviour& whole,
                            std::vector<std::string>& names) {
    std::vector<std::string> found;
    std::vector<std::pair<ProcId, const Behaviour*>> stack{{state, &whole}};
    while (!stack.empty()) {
      const auto [part, behaviour] = stack.back();
      stack.pop_back();
      const auto components = system_->terms().components(part);
      // Only where the components' names of events are those of the whole.
      const bool is_divided =
          components.size() > 1 && components.size() == behaviour->components.size();
      if (!is_divided) {
        if (knows(part, label)) found.push_back(short_name(behaviour->name));
        continue;
      }
      for (std::size_t i = components.size(); i-- > 0;) {
        stack.emplace_back(components[i], &behaviour->components[i]);
      }
    }
    if (found.empty()) found.push_back(short_name(whole.name));
    names.insert(names.end(), found.begin(), found.end());
  }

  // Whether a process performs an event in one of its first states.
  bool knows(ProcId start, lts::Label label) {
    constexpr std::size_t max_states = 2'000;
    std::vector<ProcId> states{start};
    std::unordered_set<std::uint32_t> seen{start.value};
    for (std::size_t i = 0; i < states.size() && states.size() < max_states; ++i) {
      for (const Step& step : system_->steps(states[i])) {
        if (step.label == label) return true;
        if (seen.insert(step.target.value).second) states.push_back(step.target);
      }
    }
    return false;
  }

  static std::string short_name(const std::string& term) {
    std::size_t end = std::min(term.size(), max_name_length);
    while (end > 0 && end < term.size() &&
           (static_cast<unsigned char>(term[end]) & 0xC0U) == 0x80U) {
      --end;  // not inside a character
    }
    return end == term.size() ? term : term.substr(0, end) + "...";
  }

  // --- The other behaviour ---

  void add_specification(Explanation& found) {
    const Behaviour& own = found.implementation;
    if (const auto* claim = std::get_if<parser::RefinementAssertion>(&assertion_.assertion.claim)) {
      Behaviour specification;
      for (const std::string& event : own.trace) {
        specification.trace.push_back(event == lts::tau_name ? std::string() : event);
      }
      const auto process = script_.process(claim->specification, assertion_, sink_);
      specification.states.resize(specification.trace.size() + 1);
      const std::string name = process ? script_.name(*process) : std::string();
      name_process(specification, name.empty() ? "normal(…)" : name);
      found.specification = std::move(specification);
    } else if (witness_.kind == Witness::Kind::missing_event) {
      Behaviour specification{.trace = own.trace, .event = witness_.event};
      std::ranges::replace(specification.trace, std::string(lts::tau_name), std::string());
      found.specification = std::move(specification);
    } else if (const auto* property =
                   std::get_if<parser::PropertyAssertion>(&assertion_.assertion.claim);
               property != nullptr && property->property == parser::Property::deterministic) {
      add_second_run(found);
    }
  }

  // Of determinism: a run with the same events that ends with the event that the first refuses.
  void add_second_run(Explanation& found) {
    Behaviour& own = found.implementation;
    if (witness_.kind != Witness::Kind::nondeterminism) {
      found.specification = Behaviour{.kind = Behaviour::Kind::irrelevant,
                                      .trace = std::vector<std::string>(own.trace.size())};
      return;
    }
    RunSearch search{
        .trace = {},
        .skips_tau = true,
        .ends_well = [&](ProcId state) { return step_by_name(state, witness_.event).has_value(); },
        .limits = options_.limits};
    for (const std::string& event : own.trace) {
      if (event != lts::tau_name) search.trace.push_back(event);
    }
    const auto run = find_run(*system_, search);
    if (!run) return;
    Behaviour other =
        behaviour(*run, {.event = step_by_name(run->states.back(), witness_.event)}, 0);
    name_process(other, own.name);
    align(own, other);
    found.specification = std::move(other);
  }

  // Gaps are put into both, so that events stand at the same place; each τ stands alone.
  static void align(Behaviour& a, Behaviour& b) {
    const std::vector<std::string> trace_a = a.trace;
    const std::vector<std::string> trace_b = b.trace;
    std::size_t i = 0;
    std::size_t j = 0;
    for (std::size_t place = 0; i < trace_a.size() || j < trace_b.size(); ++place) {
      if (i < trace_a.size() && trace_a[i] == lts::tau_name) {
        insert_gap(b, place);
        ++i;
      } else if (j < trace_b.size() && trace_b[j] == lts::tau_name) {
        insert_gap(a, place);
        ++j;
      } else {
        ++i;
        ++j;
      }
    }
  }

  static void insert_gap(Behaviour& b, std::size_t place) {
    const auto at = static_cast<std::ptrdiff_t>(place);
    b.trace.insert(b.trace.begin() + at, std::string());
    if (!b.states.empty()) {
      const Behaviour::State same = b.states[place];
      b.states.insert(b.states.begin() + at, same);
    }
    for (Behaviour& component : b.components) insert_gap(component, place);
  }

  Script& script_;
  const ScriptAssertion& assertion_;
  const Witness& witness_;
  const ExplainOptions& options_;
  base::Diagnostics sink_;
  std::optional<NamedTerms> system_;
};

}  // namespace

std::optional<Explanation> explain(Script& script, const ScriptAssertion& assertion,
                                   const Witness& witness, const ExplainOptions& options) {
  return Explainer(script, assertion, witness, options).run();
}

}  // namespace perentie::semantics
