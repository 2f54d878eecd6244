// What a list of channels shows and hides.
#include "perentie/monitor/visible_channels.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace perentie::monitor {
namespace {

const lts::LabelNames labels = {"τ",   "✓", "move.0", "move.1", "mover.1", "radiation_level.Red",
                                "stop"};
const std::vector<std::string> channels = {"move", "mover", "radiation_level", "stop"};

std::vector<std::string> names_of(const std::vector<lts::Label>& selected) {
  std::vector<std::string> names;
  for (const lts::Label label : selected) names.push_back(labels[label.value]);
  return names;
}

std::vector<Placed<std::string>> unplaced(const std::vector<std::string>& names) {
  std::vector<Placed<std::string>> placed;
  for (const std::string& name : names) placed.push_back({name, std::nullopt});
  return placed;
}

using Names = std::vector<std::string>;

TEST(VisibleChannelsTest, HidesAllOtherEventsAndNeverTauOrTick) {
  EXPECT_EQ(names_of(labels_not_of_channels(labels, Names{"move", "stop"})),
            (Names{"mover.1", "radiation_level.Red"}));
  EXPECT_EQ(names_of(labels_of_channels(labels, Names{"move", "stop"})),
            (Names{"move.0", "move.1", "stop"}));
  EXPECT_EQ(names_of(labels_not_of_channels(labels, Names{})),
            (Names{"move.0", "move.1", "mover.1", "radiation_level.Red", "stop"}));
}

TEST(VisibleChannelsTest, EventsMayBeNamedInFull) {
  EXPECT_EQ(names_of(labels_of_channels(labels, Names{"move.1"})), (Names{"move.1"}));
}

TEST(VisibleChannelsTest, NamesGoThroughTheEventMap) {
  EventMap map;
  map.add("velocity", "move");
  map.add("halt", "stop");
  Sink sink;
  const auto names = resolve_channels(unplaced({"velocity", "halt", "velocity . 1", "mover"}), &map,
                                      channels, sink.diagnostics);
  ASSERT_TRUE(names) << sink.text();
  EXPECT_EQ(*names, (Names{"move", "stop", "move.1", "mover"}));
}

TEST(VisibleChannelsTest, AnUnknownChannelIsNamedWithWhatWasMeant) {
  Sink sink;
  const auto file = sink.sources.add("config.yaml", "common_alphabet: [move, radiation_levl]\n");
  ASSERT_TRUE(file);
  const std::vector<Placed<std::string>> names = {
      {"move", std::nullopt}, {"radiation_levl", base::Span{24, 38}}, {"teleport", std::nullopt}};
  EXPECT_FALSE(resolve_channels(names, nullptr, channels, sink.diagnostics));
  EXPECT_EQ(sink.text(),
            "config.yaml:1:25: error: the model has no channel `radiation_levl` [M011]\n"
            "common_alphabet: [move, radiation_levl]\n"
            "                        ^~~~~~~~~~~~~~\n"
            "perentie: note: did you mean `radiation_level`?\n"
            "perentie: error: the model has no channel `teleport` [M011]\n");
}

TEST(VisibleChannelsTest, AnUnknownChannelSaysHowTheEventMapRenamedIt) {
  EventMap map;
  map.add("velocity", "sped");
  Sink sink;
  EXPECT_FALSE(resolve_channels(unplaced({"velocity"}), &map, Names{"speed"}, sink.diagnostics));
  EXPECT_EQ(
      sink.text(),
      "perentie: error: the model has no channel `sped`, which `velocity` is in the event map "
      "[M011]\nperentie: note: did you mean `speed`?\n");
}

}  // namespace
}  // namespace perentie::monitor
