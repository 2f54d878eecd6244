// The monitor against the definition: the set of states that a random process may be in.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "perentie/test/gen_lts.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

using test::StateSet;
using test::Word;

test::LtsShape shape() { return {.max_states = 7, .events = {"a", "b", "c.1"}}; }

// A label of the process, or (for one that no process of `shape` has) nothing.
using MaybeLabel = std::optional<lts::Label>;

std::string text_of(const lts::Lts& lts, const MaybeLabel& label) {
  return label ? std::string(lts.name(*label)) : "outside";
}

Event event_of(const MonitorModel& model, const lts::Lts& lts, const MaybeLabel& label) {
  return model.index.find(text_of(lts, label));
}

// Alpha(M) by definition: the labels, ✓ included, that follow some trace.
test::LabelSet alphabet_of(const lts::Lts& lts) {
  StateSet reached = test::tau_closure(lts, StateSet{1} << lts.initial().value);
  for (std::size_t i = 0; i < lts.state_count(); ++i) {
    for (std::uint32_t l = 0; l < lts.label_names().size(); ++l) {
      reached |= test::tau_closure(lts, test::step(lts, reached, lts::Label{l}));
    }
  }
  test::LabelSet labels;
  for (std::uint32_t l = lts::tick.value; l < lts.label_names().size(); ++l) {
    if (test::step(lts, reached, lts::Label{l}) != 0) labels.insert(lts::Label{l});
  }
  return labels;
}

// The definitions on sets of states.
class NaiveMonitor {
 public:
  NaiveMonitor(const lts::Lts& lts, Mode mode)
      : lts_(&lts),
        mode_(mode),
        alphabet_(alphabet_of(lts)),
        states_(test::tau_closure(lts, StateSet{1} << lts.initial().value)) {}

  Verdict step(const MaybeLabel& label) {
    if (violated_) return Verdict::violation;
    if (!label || !alphabet_.contains(*label)) {
      violated_ = mode_ == Mode::strict;
      return violated_ ? Verdict::violation : Verdict::ignored;
    }
    const StateSet next = test::tau_closure(*lts_, test::step(*lts_, states_, *label));
    violated_ = next == 0;
    if (violated_) return Verdict::violation;
    states_ = next;
    return Verdict::ok;
  }

  std::vector<std::string> expected() const {
    std::vector<std::string> names;
    for (std::uint32_t l = lts::tick.value; l < lts_->label_names().size(); ++l) {
      if (test::step(*lts_, states_, lts::Label{l}) != 0)
        names.emplace_back(lts_->name(lts::Label{l}));
    }
    return names;
  }

  StateSet states() const { return states_; }

 private:
  const lts::Lts* lts_;
  Mode mode_;
  test::LabelSet alphabet_;
  StateSet states_;
  bool violated_ = false;
};

MonitorModel model_of(const lts::Lts& lts) {
  return make_monitor_model(lts::normalise(lts).normal);
}

std::vector<std::string> names(const MonitorTable& table, const std::vector<Event>& events) {
  std::vector<std::string> texts;
  for (const Event event : events) texts.emplace_back(table.name(event));
  return texts;
}

rc::Gen<std::vector<MaybeLabel>> arbitrary_labels(const lts::Lts& lts) {
  const auto count = static_cast<std::uint32_t>(lts.label_names().size());
  return rc::gen::container<std::vector<MaybeLabel>>(rc::gen::map(
      rc::gen::inRange<std::uint32_t>(lts::tick.value, count + 1),
      [count](std::uint32_t l) { return l == count ? MaybeLabel{} : MaybeLabel{lts::Label{l}}; }));
}

// A trace that the process can perform, by a random walk.
Word sampled_trace(const lts::Lts& lts) {
  Word trace;
  lts::State state = lts.initial();
  const auto length = *rc::gen::inRange(0, 30);
  for (int i = 0; i < length && !lts.edges(state).empty(); ++i) {
    const auto edges = lts.edges(state);
    const lts::Edge edge = edges[*rc::gen::inRange<std::size_t>(0, edges.size())];
    if (edge.label != lts::tau) trace.push_back(edge.label);
    state = edge.target;
  }
  return trace;
}

RC_GTEST_PROP(MonitorPropertyTest, EveryTraceOfTheProcessIsAccepted, ()) {
  const lts::Lts lts = *test::arbitrary_lts(shape());
  const MonitorModel model = model_of(lts);
  const Word trace = sampled_trace(lts);
  for (const Mode mode : {Mode::strict, Mode::permissive}) {
    Monitor monitor(model.table, mode);
    for (const lts::Label label : trace) {
      RC_ASSERT(monitor.step(event_of(model, lts, label)) == Verdict::ok);
    }
  }
}

RC_GTEST_PROP(MonitorPropertyTest, EveryTraceIsJudgedAsTheDefinitionsSay, ()) {
  const lts::Lts lts = *test::arbitrary_lts(shape());
  const auto labels = *arbitrary_labels(lts);
  const MonitorModel model = model_of(lts);
  for (const Mode mode : {Mode::strict, Mode::permissive}) {
    Monitor monitor(model.table, mode);
    NaiveMonitor naive(lts, mode);
    for (const MaybeLabel& label : labels) {
      RC_ASSERT(names(model.table, monitor.expected()) == naive.expected());
      RC_ASSERT(monitor.step(event_of(model, lts, label)) == naive.step(label));
    }
  }
}

RC_GTEST_PROP(MonitorPropertyTest, AMutatedTraceIsJudgedAsTheDefinitionsSay, ()) {
  const lts::Lts lts = *test::arbitrary_lts(shape());
  Word trace = sampled_trace(lts);
  RC_PRE(!trace.empty());
  const auto count = static_cast<std::uint32_t>(lts.label_names().size());
  trace[*rc::gen::inRange<std::size_t>(0, trace.size())] =
      lts::Label{*rc::gen::inRange(lts::tick.value, count)};
  const MonitorModel model = model_of(lts);
  for (const Mode mode : {Mode::strict, Mode::permissive}) {
    Monitor monitor(model.table, mode);
    NaiveMonitor naive(lts, mode);
    for (const lts::Label label : trace) {
      RC_ASSERT(monitor.step(event_of(model, lts, label)) == naive.step(label));
    }
  }
}

RC_GTEST_PROP(MonitorPropertyTest, AfterAViolationTheVerdictStays, ()) {
  const lts::Lts lts = *test::arbitrary_lts(shape());
  const auto labels = *arbitrary_labels(lts);
  const MonitorModel model = model_of(lts);
  Monitor monitor(model.table, *rc::gen::element(Mode::strict, Mode::permissive));
  bool violated = false;
  for (const MaybeLabel& label : labels) {
    const Verdict verdict = monitor.step(event_of(model, lts, label));
    RC_ASSERT(!violated || verdict == Verdict::violation);
    violated = violated || verdict == Verdict::violation;
    RC_ASSERT(monitor.violated() == violated);
  }
}

RC_GTEST_PROP(MonitorPropertyTest, ABatchIsItsSteps, ()) {
  const lts::Lts lts = *test::arbitrary_lts(shape());
  const auto labels = *arbitrary_labels(lts);
  const Mode mode = *rc::gen::element(Mode::strict, Mode::permissive);
  const MonitorModel model = model_of(lts);

  std::string text;
  for (const MaybeLabel& label : labels) text += text_of(lts, label) + "\n";
  TestTrace trace(text, {.format = TraceFormat::text});
  const RunResult run = run_trace(trace.stream(), model, mode);

  NaiveMonitor naive(lts, mode);
  std::uint64_t checked = 0;
  std::uint64_t ignored = 0;
  bool violated = false;
  for (const MaybeLabel& label : labels) {
    if (violated) break;
    const Verdict verdict = naive.step(label);
    ++checked;
    ignored += verdict == Verdict::ignored ? 1U : 0U;
    violated = verdict == Verdict::violation;
  }
  RC_ASSERT((run.verdict == RunVerdict::violation) == violated);
  RC_ASSERT(run.events_checked == checked);
  RC_ASSERT(run.events_ignored == ignored);
  RC_ASSERT(run.events_total == labels.size());
  auto expected = naive.expected();
  std::sort(expected.begin(), expected.end());
  RC_ASSERT(run.permitted == expected);
  StateSet members = 0;
  for (const lts::State state : run.model_states) members |= StateSet{1} << state.value;
  RC_ASSERT(members == naive.states());
}

RC_GTEST_PROP(MonitorPropertyTest, AllLayoutsAreTheSameTable, ()) {
  const lts::Lts lts = lts::normalise(*test::arbitrary_lts(shape())).normal.lts;
  const MonitorTable rows = MonitorTable::compile(lts, TableLayout::sorted_rows);
  for (const TableLayout layout : {TableLayout::dense_2_byte, TableLayout::dense_4_byte}) {
    const MonitorTable dense = MonitorTable::compile(lts, layout);
    RC_ASSERT(dense.event_count() == rows.event_count());
    for (std::uint32_t s = 0; s < rows.state_count(); ++s) {
      RC_ASSERT(dense.enabled(State{s}) == rows.enabled(State{s}));
      for (std::uint32_t e = 0; e < rows.event_count(); ++e) {
        RC_ASSERT(dense.next(State{s}, Event{e}) == rows.next(State{s}, Event{e}));
      }
    }
  }
}

}  // namespace
}  // namespace perentie::monitor
