#include "perentie/semantics/check.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "perentie/base/check.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/lts/deterministic_extraction.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/lts_system.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/refusal_testing.hpp"
#include "perentie/lts/revivals.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/lts/trace.hpp"
#include "perentie/lts/weak_bisimulation.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/process_system.hpp"
#include "preserved_in_script.hpp"

namespace perentie::semantics {
namespace {

using base::overload;
using lts::Label;
using lts::SemanticModel;
using parser::ExprId;
using Outcome = CheckResult::Outcome;

class Checker {
 public:
  Checker(Script& script, const ScriptAssertion& assertion, const lts::ExploreOptions& options,
          base::Diagnostics& diagnostics)
      : script_(script), assertion_(assertion), options_(options), diagnostics_(diagnostics) {}

  CheckResult run() {
    const auto start = std::chrono::steady_clock::now();
    script_.set_limits(options_.limits);
    std::visit([&](const auto& claim) { check(claim); }, assertion_.assertion.claim);
    const bool is_decided = result_.outcome == Outcome::holds || result_.outcome == Outcome::fails;
    if (is_decided && assertion_.assertion.negated) {
      result_.outcome = result_.outcome == Outcome::holds ? Outcome::fails : Outcome::holds;
    }
    result_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }

 private:
  using Found = lts::Counterexample<ProcId>;

  // Ends

  void stop(const std::optional<base::LimitReached>& limit) {
    result_.outcome = limit ? Outcome::inconclusive : Outcome::error;
    result_.limit = limit;
  }

  void refuse(std::string_view what) {
    diagnostics_.report(codes::not_supported, assertion_.span,
                        fmt::format("{} is not supported", what));
    result_.outcome = Outcome::error;
  }

  void refute(Witness witness) {
    result_.outcome = Outcome::fails;
    result_.witness = std::move(witness);
  }

  // Processes

  std::optional<ProcId> process(ExprId expr) {
    const auto found = script_.process(expr, assertion_, diagnostics_);
    if (!found) stop(script_.limit());
    return found;
  }

  std::optional<ProcessExploration> explored(ProcId process) {
    auto exploration = explore_process(script_, process, options_, diagnostics_);
    if (exploration.complete) return exploration;
    stop(exploration.limit);
    return std::nullopt;
  }

  std::optional<lts::NormalLts> normal_form(ProcId process, bool with_acceptances) {
    const auto exploration = explored(process);
    return exploration ? normal_form_of_reduced(exploration->lts, with_acceptances) : std::nullopt;
  }

  // In the models up to failures-divergences.
  std::optional<lts::NormalLts> normal_form_of_reduced(const lts::Lts& lts, bool with_acceptances) {
    // The subset construction takes very long on large graphs with many τ, and meets few sets in
    // their quotients. Small graphs keep the nodes, and with them the counts, that FDR has.
    constexpr std::size_t large = 10'000;
    if (lts.state_count() < large || !lts::has_tau(lts)) return normal_form(lts, with_acceptances);
    const auto small = lts::delay_bisimulation(lts, options_.limits);
    if (const auto* limit = std::get_if<base::LimitReached>(&small)) {
      stop(*limit);
      return std::nullopt;
    }
    return normal_form(std::get<lts::Quotient>(small).lts, with_acceptances);
  }

  std::optional<lts::NormalLts> normal_form(const lts::Lts& lts, bool with_acceptances) {
    auto normalisation =
        lts::normalise(lts, {.limits = options_.limits, .acceptances = with_acceptances});
    if (!normalisation.complete()) {
      stop(normalisation.limit);
      return std::nullopt;
    }
    return std::move(normalisation.normal);
  }

  std::vector<std::string> words(std::span<const Label> labels) const {
    std::vector<std::string> found;
    for (const Label label : labels) found.push_back((*names_)[label.value]);
    return found;
  }

  // Compares a process with a specification. `explain` makes a witness of a counterexample.
  template <class Specification, class Explain>
  void refine(const Specification& specification, ProcId process, SemanticModel model,
              Explain explain) {
    const auto found =
        refine_process(script_, process, specification, model, options_, diagnostics_);
    result_.counts = found.counts;
    if (!found.counterexample && !found.complete()) {
      stop(found.limit);
      return;
    }
    result_.outcome = Outcome::holds;
    if (!found.counterexample) return;
    const Found& counterexample = *found.counterexample;
    names_ = script_.label_names();
    Witness witness{.kind = Witness::Kind::event,
                    .trace = words(counterexample.trace),
                    .state = script_.show(counterexample.states.back())};
    switch (counterexample.kind) {
      case Found::Kind::event:
        witness.event = (*names_)[counterexample.event.value];
        break;
      case Found::Kind::acceptance:
        witness.kind = Witness::Kind::acceptance;
        witness.offered = words(counterexample.offered);
        break;
      case Found::Kind::divergence:
        witness.kind = Witness::Kind::divergence;
        break;
    }
    explain(counterexample, witness);
    refute(std::move(witness));
  }

  // Claims

  static std::string_view name_of(parser::Model model) {
    constexpr std::string_view names[] = {"T", "F", "FD", "V", "VD", "R", "RD"};
    return names[static_cast<std::size_t>(model)];
  }

  static std::optional<SemanticModel> semantic_model(parser::Model model) {
    switch (model) {
      case parser::Model::traces:
        return SemanticModel::traces;
      case parser::Model::failures:
        return SemanticModel::failures;
      case parser::Model::failures_divergences:
        return SemanticModel::failures_divergences;
      default:
        return std::nullopt;
    }
  }

  // The model in which a property is to be checked: failures-divergences unless it is said (2.6).
  static std::optional<SemanticModel> model_of(const std::optional<parser::Model>& said) {
    return said ? semantic_model(*said) : SemanticModel::failures_divergences;
  }

  void check(const parser::RefinementAssertion& claim) {
    const auto model = semantic_model(claim.model);
    if (!model) return check_beyond_failures(claim);
    const auto specification = process(claim.specification);
    if (!specification) return;
    const auto implementation = process(claim.implementation);
    if (!implementation) return;
    const auto normal = normal_form(*specification, *model != SemanticModel::traces);
    if (!normal) return;
    refine(lts::NormalSpecification(*normal), *implementation, *model,
           [&](const Found& found, Witness& witness) {
             if (found.kind == Found::Kind::acceptance) {
               for (const lts::AcceptanceId id : normal->acceptances->of(found.node)) {
                 witness.allowed.push_back(words(normal->acceptances->labels(id)));
               }
             } else if (found.kind == Found::Kind::event) {
               std::vector<Label> labels;
               for (const lts::Edge& edge : normal->lts.edges(found.node)) {
                 labels.push_back(edge.label);
               }
               witness.allowed.push_back(words(labels));
             }
           });
  }

  // The models that FDR had until 2.94: V and R, and VD and RD with strict divergence.
  void check_beyond_failures(const parser::RefinementAssertion& claim) {
    const PreservedInScript scope(script_, Preserved::bisimilarity);
    const auto specification = process(claim.specification);
    if (!specification) return;
    const auto implementation = process(claim.implementation);
    if (!implementation) return;
    const auto graph = explored(*specification);
    if (!graph) return;
    const bool strict = claim.model == parser::Model::revivals_divergences ||
                        claim.model == parser::Model::refusal_testing_divergences;
    const bool is_revivals = claim.model == parser::Model::revivals ||
                             claim.model == parser::Model::revivals_divergences;
    if (is_revivals) {
      check_revivals(graph->lts, *implementation, strict);
    } else {
      check_refusal_testing(graph->lts, *implementation, strict);
    }
  }

  void check_revivals(const lts::Lts& specification, ProcId implementation, bool strict) {
    const auto normal = normal_form(specification, false);
    if (!normal) return;
    const lts::StableOffers offers(*normal, specification);
    refine(lts::RevivalSpecification(*normal, offers), implementation,
           strict ? SemanticModel::failures_divergences : SemanticModel::failures,
           [&](const Found& found, Witness& witness) {
             if (found.kind != Found::Kind::acceptance) return;
             witness.is_exact = true;
             for (const lts::AcceptanceId id : offers.of(found.node)) {
               witness.allowed.push_back(words(offers.labels(id)));
             }
           });
  }

  // What a trace refinement needs of a specification, where acceptances are events.
  struct AcceptsAll : lts::NormalSpecification {
    using NormalSpecification::NormalSpecification;
    static bool accepts(lts::State, std::span<const Label>) { return true; }
  };

  void check_refusal_testing(const lts::Lts& specification, ProcId process, bool strict) {
    const auto graph = explored(process);
    if (!graph) return;
    const lts::RefusalTest test = lts::test_refusals(specification, graph->lts);
    const auto normal = normal_form(test.specification.lts, false);
    if (!normal) return;
    lts::LtsSystem system(test.implementation.lts);
    const auto found =
        lts::refine(AcceptsAll(*normal), system,
                    strict ? SemanticModel::failures_divergences : SemanticModel::traces, options_);
    result_.counts = found.counts;
    if (!found.counterexample && !found.complete()) return stop(found.limit);
    result_.outcome = Outcome::holds;
    if (!found.counterexample) return;
    names_ = script_.label_names();
    const auto& counterexample = *found.counterexample;
    const lts::State last = test.implementation.origins[counterexample.states.back().value];
    Witness witness{
        .kind = Witness::Kind::event, .trace = {}, .state = script_.show(graph->term(last))};
    for (const Label label : counterexample.trace) {
      if (test.is_observation(label)) {
        witness.observed.push_back({witness.trace.size(), words(test.observation(label))});
      } else {
        witness.trace.push_back((*names_)[label.value]);
      }
    }
    if (counterexample.kind == lts::Counterexample<lts::State>::Kind::divergence) {
      witness.kind = Witness::Kind::divergence;
    } else if (test.is_observation(counterexample.event)) {
      witness.kind = Witness::Kind::acceptance;
      witness.offered = words(test.observation(counterexample.event));
      witness.is_exact = true;
      const lts::StableOffers offers(*normal, test.specification.lts);
      for (const lts::AcceptanceId id : offers.of(counterexample.node)) {
        const auto labels = offers.labels(id);
        const auto events = std::ranges::lower_bound(labels, test.first_observation);
        witness.allowed.push_back(words({labels.begin(), events}));
      }
      std::ranges::sort(witness.allowed);
      witness.allowed.erase(std::unique(witness.allowed.begin(), witness.allowed.end()),
                            witness.allowed.end());
    } else {
      witness.event = (*names_)[counterexample.event.value];
    }
    refute(std::move(witness));
  }

  void check(const parser::PropertyAssertion& claim) {
    const auto model = model_of(claim.model);
    const bool is_divergence = claim.property == parser::Property::divergence_free;
    if (!model || *model == SemanticModel::traces ||
        (is_divergence && *model != SemanticModel::failures_divergences)) {
      return refuse(fmt::format("this property in the model {}", name_of(*claim.model)));
    }
    const auto implementation = process(claim.process);
    if (!implementation) return;
    switch (claim.property) {
      case parser::Property::deadlock_free:
        return refine(lts::DeadlockFreedom{}, *implementation, *model,
                      [](const Found& found, Witness& witness) {
                        if (found.kind == Found::Kind::acceptance) {
                          witness.kind = Witness::Kind::deadlock;
                        }
                      });
      case parser::Property::divergence_free:
        return refine(lts::DivergenceFreedom{}, *implementation, *model,
                      [](const Found&, Witness&) {});
      case parser::Property::deterministic:
        return check_determinism(*implementation, *model);
    }
  }

  // As FDR does: against what a deterministic process that is extracted from it can do (5.3.4). In
  // the failures model that is right where nothing diverges; otherwise everything is looked at that
  // the process can do after a trace, which may take exponentially longer.
  void check_determinism(ProcId implementation, SemanticModel model) {
    const auto graph = explored(implementation);
    if (!graph) return;
    const bool is_extracted =
        model == SemanticModel::failures_divergences ||
        std::ranges::none_of(lts::divergent_states(graph->lts), std::identity());
    const auto normal =
        is_extracted
            ? normal_form(lts::strong_bisimulation(lts::deterministic_extraction(graph->lts)).lts,
                          false)
            : normal_form_of_reduced(graph->lts, false);
    if (!normal) return;
    refine(lts::DeterministicSpecification(*normal), implementation, model,
           [&](const Found& found, Witness& witness) {
             if (found.kind == Found::Kind::event) {
               return show_refusal(*graph, found, witness);
             }
             if (found.kind != Found::Kind::acceptance) return;
             witness.kind = Witness::Kind::nondeterminism;
             for (const lts::Edge& edge : normal->lts.edges(found.node)) {
               if (std::ranges::binary_search(found.offered, edge.label)) continue;
               witness.event = (*names_)[edge.label.value];
               break;
             }
           });
  }

  // The event of a counterexample is one that another state after the same trace refuses.
  void show_refusal(const ProcessExploration& graph, const Found& found, Witness& witness) const {
    std::vector<Label> trace;
    std::ranges::copy_if(found.trace, std::back_inserter(trace),
                         [](Label label) { return label != lts::tau; });
    const auto path = lts::shortest_path(
        graph.lts,
        [&](lts::State s) {
          return graph.lts.is_stable(s) && graph.lts.edges(s, found.event).empty();
        },
        trace);
    PERENTIE_CHECK(path.has_value(), "an event that no state refuses");
    const lts::State last = lts::end_of(graph.lts, *path);
    witness.kind = Witness::Kind::nondeterminism;
    witness.trace = words(lts::labels_of(*path));
    witness.state = script_.show(graph.term(last));
    witness.offered = words(lts::labels_on(graph.lts.edges(last)));
  }

  // CSPM reference 5.3.8, on the normal form.
  void check(const parser::HasTraceAssertion& claim) {
    const auto model = model_of(claim.model);
    if (!model) {
      return refuse(fmt::format("`has trace` in the model {}", name_of(*claim.model)));
    }
    std::vector<std::string> trace;
    for (const ExprId event : script_.tree().list(claim.trace)) {
      const auto name = script_.evaluate(event, diagnostics_);
      if (!name) return stop(script_.limit());
      trace.push_back(*name);
    }
    const auto implementation = process(claim.process);
    if (!implementation) return;
    const auto normal = normal_form(*implementation, *model != SemanticModel::traces);
    if (!normal) return;
    names_ = normal->lts.shared_label_names();
    lts::State node{0};
    result_.outcome = Outcome::holds;
    result_.counts = {1, 1, 1};
    for (std::size_t i = 0; i < trace.size(); ++i) {
      const std::vector<std::string> performed(trace.begin(),
                                               trace.begin() + static_cast<std::ptrdiff_t>(i));
      if (*model == SemanticModel::failures_divergences && normal->divergent[node.value]) {
        return refute({.kind = Witness::Kind::divergence, .trace = performed});
      }
      Witness missing{.kind = Witness::Kind::missing_event, .trace = performed, .event = trace[i]};
      const auto label = normal->lts.find_label(trace[i]);
      const auto edges = label ? normal->lts.edges(node, *label) : std::span<const lts::Edge>{};
      if (edges.empty()) return refute(std::move(missing));
      if (*model != SemanticModel::traces) {
        for (const lts::AcceptanceId id : normal->acceptances->of(node)) {
          const auto offered = normal->acceptances->labels(id);
          if (std::ranges::binary_search(offered, *label)) continue;
          missing.is_refused = true;
          missing.offered = words(offered);
          return refute(std::move(missing));
        }
      }
      node = edges.front().target;
      ++result_.counts.states;
      ++result_.counts.transitions;
      ++result_.counts.plys;
    }
  }

  Script& script_;
  const ScriptAssertion& assertion_;
  const lts::ExploreOptions& options_;
  base::Diagnostics& diagnostics_;
  std::shared_ptr<const lts::LabelNames> names_;
  CheckResult result_{.outcome = Outcome::error};
};

}  // namespace

std::string_view name_of(CheckResult::Outcome outcome) {
  switch (outcome) {
    case Outcome::holds:
      return "holds";
    case Outcome::fails:
      return "fails";
    case Outcome::inconclusive:
      return "inconclusive";
    case Outcome::error:
      return "error";
  }
  return {};
}

std::string_view name_of(Witness::Kind kind) {
  switch (kind) {
    case Witness::Kind::event:
      return "event";
    case Witness::Kind::acceptance:
      return "acceptance";
    case Witness::Kind::divergence:
      return "divergence";
    case Witness::Kind::deadlock:
      return "deadlock";
    case Witness::Kind::nondeterminism:
      return "nondeterminism";
    case Witness::Kind::missing_event:
      return "missing event";
  }
  return {};
}

CheckResult check(Script& script, const ScriptAssertion& assertion,
                  const lts::ExploreOptions& options, base::Diagnostics& diagnostics) {
  return Checker(script, assertion, options, diagnostics).run();
}

}  // namespace perentie::semantics
