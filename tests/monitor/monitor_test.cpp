// Definitions 1 and 2 of the Varanus paper, case by case, and what follows a violation.
#include "perentie/monitor/monitor.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace perentie::monitor {
namespace {

// One row of the paper's next-state table: is the event in Alpha(M), is it in Events(s).
struct NextStateCase {
  const char* name;
  const char* event;
  Mode mode;
  Verdict verdict;
  bool moves;
};

class NextStateTest : public testing::TestWithParam<NextStateCase> {};

// The model is a -> b -> STOP, so in the initial state `a` is enabled, `b` is not, `x` is no event
// of it.
INSTANTIATE_TEST_SUITE_P(
    Paper, NextStateTest,
    testing::Values(
        NextStateCase{"strict_enabled", "a", Mode::strict, Verdict::ok, true},
        NextStateCase{"strict_not_enabled", "b", Mode::strict, Verdict::violation, false},
        NextStateCase{"strict_not_in_alphabet", "x", Mode::strict, Verdict::violation, false},
        NextStateCase{"permissive_enabled", "a", Mode::permissive, Verdict::ok, true},
        NextStateCase{"permissive_not_enabled", "b", Mode::permissive, Verdict::violation, false},
        NextStateCase{"permissive_not_in_alphabet", "x", Mode::permissive, Verdict::ignored,
                      false}),
    [](const auto& instance) { return instance.param.name; });

TEST_P(NextStateTest, IsAsDefined) {
  const MonitorModel model = model_from("0 a 1; 1 b 2");
  Monitor monitor(model.table, GetParam().mode);
  const State before = monitor.state();
  EXPECT_EQ(monitor.step(model.index.find(GetParam().event)), GetParam().verdict);
  EXPECT_EQ(monitor.state() != before, GetParam().moves);
  EXPECT_EQ(monitor.violated(), GetParam().verdict == Verdict::violation);
}

std::vector<Verdict> verdicts(Monitor& monitor, const MonitorModel& model,
                              const std::vector<std::string>& events) {
  std::vector<Verdict> result;
  for (const std::string& event : events) {
    result.push_back(monitor.step(model.index.find(event)));
  }
  return result;
}

TEST(MonitorTest, AlphabetIsOfEventsNotOfChannels) {
  // move.2 is never possible, so it is outside Alpha(M) although the channel `move` is not.
  const MonitorModel model = model_from("0 move.1 0");
  Monitor permissive(model.table, Mode::permissive);
  EXPECT_EQ(permissive.step(model.index.find("move.2")), Verdict::ignored);
  Monitor strict(model.table, Mode::strict);
  EXPECT_EQ(strict.step(model.index.find("move.2")), Verdict::violation);
}

TEST(MonitorTest, AViolationIsLatchedUntilReset) {
  const MonitorModel model = model_from("0 a 1; 1 b 0");
  Monitor monitor(model.table, Mode::permissive);
  EXPECT_EQ(verdicts(monitor, model, {"a", "a", "b", "x"}),
            (std::vector<Verdict>{Verdict::ok, Verdict::violation, Verdict::violation,
                                  Verdict::violation}));
  EXPECT_EQ(model.table.name(monitor.expected().at(0)), "b");
  monitor.reset();
  EXPECT_FALSE(monitor.violated());
  EXPECT_EQ(verdicts(monitor, model, {"a", "b"}), (std::vector<Verdict>{Verdict::ok, Verdict::ok}));
}

TEST(MonitorTest, StayGoesOnFromBeforeTheViolation) {
  const MonitorModel model = model_from("0 a 1; 1 b 0");
  Monitor monitor(model.table, Mode::strict, AfterViolation::stay);
  EXPECT_EQ(verdicts(monitor, model, {"a", "a", "b"}),
            (std::vector<Verdict>{Verdict::ok, Verdict::violation, Verdict::ok}));
  EXPECT_FALSE(monitor.violated());
}

TEST(MonitorTest, ResetGoesOnFromTheInitialState) {
  const MonitorModel model = model_from("0 a 1; 1 b 0");
  Monitor monitor(model.table, Mode::strict, AfterViolation::reset);
  EXPECT_EQ(verdicts(monitor, model, {"a", "a", "a"}),
            (std::vector<Verdict>{Verdict::ok, Verdict::violation, Verdict::ok}));
}

TEST(MonitorTest, NothingFollowsTermination) {
  // a -> SKIP
  const MonitorModel model = model_from("0 a 1; 1 tick 2");
  Monitor monitor(model.table, Mode::permissive);
  EXPECT_EQ(verdicts(monitor, model, {"a", "✓"}), (std::vector<Verdict>{Verdict::ok, Verdict::ok}));
  EXPECT_TRUE(monitor.expected().empty());
  Monitor copy = monitor;
  EXPECT_EQ(copy.step(model.index.find("a")), Verdict::violation);
  copy = monitor;
  EXPECT_EQ(copy.step(model.index.find("✓")), Verdict::violation);
  copy = monitor;
  EXPECT_EQ(copy.step(model.index.find("x")), Verdict::ignored);
  EXPECT_FALSE(monitor.violated());
}

TEST(MonitorTest, HiddenStepsAndNondeterminismAreFollowed) {
  // After `a` the process is in 1, 2 or (by τ) 3: both b and c are possible, and after b only d.
  const MonitorModel model = model_from("0 a 1; 0 a 2; 2 tau 3; 1 b 4; 3 c 5; 4 d 0");
  for (const char* second : {"b", "c"}) {
    Monitor monitor(model.table, Mode::strict);
    EXPECT_EQ(verdicts(monitor, model, {"a", second}),
              (std::vector<Verdict>{Verdict::ok, Verdict::ok}));
  }
  Monitor monitor(model.table, Mode::strict);
  EXPECT_EQ(verdicts(monitor, model, {"a", "c", "d"}),
            (std::vector<Verdict>{Verdict::ok, Verdict::ok, Verdict::violation}));
}

}  // namespace
}  // namespace perentie::monitor
