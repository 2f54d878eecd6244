// FSM and GraphML files.
#include <gtest/gtest.h>

#include <sstream>

#include "perentie/lts/fsm.hpp"
#include "perentie/lts/graphml.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;

TEST(FsmTest, StatesCountFromOneAndTheInitialOneIsFirst) {
  std::ostringstream out;
  write_fsm(out, lts_from("-> 2; 0 tick 1; 1; 2 tau 0; 2 a.1 2"));
  EXPECT_EQ(out.str(), "---\n\n\n\n---\n3 2 \"tick\"\n1 3 \"tau\"\n1 1 \"a.1\"\n");
}

TEST(FsmTest, AQuoteInANameDoesNotEndIt) {
  std::ostringstream out;
  write_fsm(out, lts_from("0 c.\"x\" 0"));
  EXPECT_EQ(out.str(), "---\n\n---\n1 1 \"c.'x'\"\n");
}

TEST(GraphmlTest, NamesAreEscaped) {
  std::ostringstream out;
  write_graphml(out, lts_from("0 c.<1>&\"x\" 1; 1 tau 0"),
                {.state_name = [](State s) { return s.value == 0 ? "P<Q\x01" : "STOP"; }});
  const std::string text = out.str();
  EXPECT_NE(text.find("<node id=\"s0\"><data key=\"initial\">true</data><data key=\"name\">"
                      "P&lt;Q\xEF\xBF\xBD</data></node>\n<node id=\"s1\"><data key=\"name\">STOP"
                      "</data></node>\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<edge source=\"s0\" target=\"s1\"><data key=\"label\">c.&lt;1&gt;&amp;&quot;"
                      "x&quot;</data></edge>\n<edge source=\"s1\" target=\"s0\"><data "
                      "key=\"label\">τ</data></edge>\n</graph>\n</graphml>\n"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace perentie::lts
