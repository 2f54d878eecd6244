// The table answers as the LTS does, whatever its layout.
#include "perentie/monitor/monitor_table.hpp"

#include <gtest/gtest.h>

#include "perentie/test/lts_text.hpp"

namespace perentie::monitor {
namespace {

constexpr TableLayout all_layouts[] = {TableLayout::dense_2_byte, TableLayout::dense_4_byte,
                                       TableLayout::sorted_rows};

class MonitorTableTest : public testing::TestWithParam<TableLayout> {};

INSTANTIATE_TEST_SUITE_P(Layouts, MonitorTableTest, testing::ValuesIn(all_layouts));

std::vector<std::string> names(const MonitorTable& table, const std::vector<Event>& events) {
  std::vector<std::string> texts;
  for (const Event event : events) texts.emplace_back(table.name(event));
  return texts;
}

TEST_P(MonitorTableTest, NextIsTheEdgeOrNothing) {
  const MonitorTable table =
      MonitorTable::compile(test::lts_from("0 a 1; 0 c 0; 1 b 2; 2"), GetParam());
  ASSERT_EQ(table.event_count(), 3U);
  EXPECT_EQ(table.layout(), GetParam());
  EXPECT_EQ(table.state_count(), 3U);
  const Event a{0};
  const Event b{1};
  const Event c{2};
  EXPECT_EQ(table.name(b), "b");
  EXPECT_EQ(table.next(State{0}, a), State{1});
  EXPECT_EQ(table.next(State{0}, b), State{});
  EXPECT_EQ(table.next(State{0}, c), State{0});
  EXPECT_EQ(table.next(State{1}, b), State{2});
  EXPECT_EQ(table.next(State{2}, a), State{});
  EXPECT_EQ(table.next(State{2}, c), State{});
}

TEST_P(MonitorTableTest, EnabledIsTheRow) {
  const MonitorTable table =
      MonitorTable::compile(test::lts_from("0 c 1; 0 a 1; 1 tick 2"), GetParam());
  EXPECT_EQ(names(table, table.enabled(State{0})), (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(names(table, table.enabled(State{1})), (std::vector<std::string>{"✓"}));
  EXPECT_TRUE(table.enabled(State{2}).empty());
}

TEST_P(MonitorTableTest, TheAlphabetIsWhatOccurs) {
  // `b` is known to the model but never happens.
  const MonitorTable table =
      MonitorTable::compile(test::lts_from("0 a 0; 0 c 0", {"a", "b", "c"}), GetParam());
  EXPECT_EQ(table.event_count(), 2U);
  EXPECT_EQ(table.name(Event{1}), "c");
}

TEST_P(MonitorTableTest, AProcessWithoutEventsHasATable) {
  const MonitorTable table = MonitorTable::compile(test::lts_from("0"), GetParam());
  EXPECT_EQ(table.event_count(), 0U);
  EXPECT_TRUE(table.enabled(table.initial()).empty());
}

TEST(MonitorTableLayoutTest, SmallTablesAreDenseAndLargeOnesAreRows) {
  const lts::Lts lts = test::lts_from("0 a 1; 1 b 0");
  EXPECT_EQ(MonitorTable::compile(lts).layout(), TableLayout::dense_2_byte);
  EXPECT_EQ(MonitorTable::compile(lts).memory_bytes(), 8U);
  EXPECT_EQ(MonitorTable::compile(lts, TableOptions{.max_dense_bytes = 8}).layout(),
            TableLayout::dense_2_byte);
  EXPECT_EQ(MonitorTable::compile(lts, TableOptions{.max_dense_bytes = 7}).layout(),
            TableLayout::sorted_rows);
}

TEST(MonitorTableLayoutTest, EntriesOfTwoBytesEndAt65534States) {
  // A cycle of n states with one event: the last state number must not look like "no state".
  for (const std::uint32_t n : {65534U, 65535U, 65536U}) {
    lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(
        lts::LabelNames{std::string(lts::tau_name), std::string(lts::tick_name), "a"}));
    builder.add_states(n);
    for (std::uint32_t s = 0; s < n; ++s) {
      builder.add_edge(State{s}, lts::Label{2}, State{(s + 1) % n});
    }
    const MonitorTable table = MonitorTable::compile(std::move(builder).finish(State{0}));
    EXPECT_EQ(table.layout(), n == 65534 ? TableLayout::dense_2_byte : TableLayout::dense_4_byte);
    EXPECT_EQ(table.next(State{n - 2}, Event{0}), State{n - 1});
    EXPECT_EQ(table.next(State{n - 1}, Event{0}), State{0});
  }
}

TEST(MonitorTableDeathTest, RefusesWhatIsNotDeterministic) {
  EXPECT_DEATH(MonitorTable::compile(test::lts_from("0 a 0; 0 a 1")), "nondeterministic");
  EXPECT_DEATH(MonitorTable::compile(test::lts_from("0 tau 1")), "τ");
}

}  // namespace
}  // namespace perentie::monitor
