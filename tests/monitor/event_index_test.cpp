// How events may be written in a trace.
#include "perentie/monitor/event_index.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace perentie::monitor {
namespace {

// The name of the event that `text` is taken for; empty: none.
std::string found(const MonitorModel& model, std::string_view text) {
  const Event event = model.index.find(text);
  return event.is_none() ? "" : std::string(model.table.name(event));
}

TEST(EventIndexTest, FindsEventsAsPrinted) {
  const MonitorModel model = model_from("0 move.1 0; 0 stop 0");
  EXPECT_EQ(found(model, "move.1"), "move.1");
  EXPECT_EQ(found(model, "stop"), "stop");
  EXPECT_EQ(found(model, "move"), "");
  EXPECT_EQ(found(model, "move.1.1"), "");
  EXPECT_EQ(found(model, ""), "");
  EXPECT_EQ(found(model, "τ"), "");
}

TEST(EventIndexTest, BlanksAroundDotsMeanNothing) {
  const MonitorModel model = model_from("0 pedal.true 0; 0 c.(1,2) 0; 0 movestop 0");
  EXPECT_EQ(found(model, "pedal. true"), "pedal.true");
  EXPECT_EQ(found(model, " pedal .\ttrue "), "pedal.true");
  EXPECT_EQ(found(model, "c.(1, 2)"), "c.(1,2)");
  EXPECT_EQ(found(model, "move stop"), "");
}

TEST(EventIndexTest, PythonBooleansAreFieldsOfTheirOwn) {
  const MonitorModel model =
      model_from("0 pedal.true.false 0; 0 c.True 0; 0 c.true 0; 0 Truenorth.1 0");
  EXPECT_EQ(found(model, "pedal.True.False"), "pedal.true.false");
  EXPECT_EQ(found(model, "c.True"), "c.True");
  EXPECT_EQ(found(model, "c. True"), "c.true");
  EXPECT_EQ(found(model, "truenorth.1"), "");
  EXPECT_EQ(normalise_event_text("a.Truex.xTrue.True_"), "a.Truex.xTrue.True_");
}

TEST(EventIndexTest, NumbersAreNotTouched) {
  const MonitorModel model = model_from("0 speed.38 0");
  EXPECT_EQ(found(model, "speed.38.0"), "");
  EXPECT_EQ(found(model, "speed.038"), "");
}

TEST(EventIndexTest, TerminationHasThreeSpellings) {
  const MonitorModel model = model_from("0 a 1; 1 tick 2");
  for (const char* text : {"✓", "tick", "_tick", " tick "})
    EXPECT_EQ(found(model, text), "✓") << text;
}

TEST(EventIndexTest, AnEventCalledTickIsNotTermination) {
  const MonitorModel model = model_from("0 tick 1", {"tick"});
  ASSERT_EQ(found(model, "✓"), "✓");
  // `lts_from` writes ✓ as tick, so the channel has to be made by hand: label 2 is the event
  // `tick`.
  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(
      lts::LabelNames{std::string(lts::tau_name), std::string(lts::tick_name), "tick", "_tick"}));
  builder.add_states(3);
  builder.add_edge(State{0}, lts::Label{2}, State{1});
  builder.add_edge(State{1}, lts::tick, State{2});
  const MonitorModel clock =
      make_monitor_model(lts::normalise(std::move(builder).finish(State{0})).normal);
  EXPECT_EQ(found(clock, "tick"), "tick");
  EXPECT_EQ(found(clock, "✓"), "✓");
  // `_tick` is declared but never happens: it is outside the alphabet, not another way to write ✓.
  EXPECT_EQ(found(clock, "_tick"), "");
}

TEST(EventIndexTest, AModelThatNeverTerminatesHasNoTick) {
  const MonitorModel model = model_from("0 a 0");
  EXPECT_EQ(found(model, "✓"), "");
}

}  // namespace
}  // namespace perentie::monitor
