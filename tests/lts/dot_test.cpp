// DOT output: quoting that Graphviz understands, and the initial state marked.
#include <gtest/gtest.h>

#include <sstream>

#include "perentie/lts/dot.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

std::string write(const Lts& lts, const DotOptions& options = {}) {
  std::ostringstream out;
  write_dot(out, lts, options);
  return out.str();
}

TEST(DotTest, WritesEveryStateAndEdge) {
  EXPECT_EQ(write(test::lts_from("-> 1; 1 a.1 0; 1 tau 1; 0 tick 2")),
            "digraph lts {\n"
            "  rankdir=LR;\n"
            "  node [shape=circle];\n"
            "  initial [shape=point, label=\"\"];\n"
            "  s0 [label=\"0\"];\n"
            "  s1 [label=\"1\"];\n"
            "  s2 [label=\"2\"];\n"
            "  initial -> s1;\n"
            "  s0 -> s2 [label=\"✓\"];\n"
            "  s1 -> s1 [label=\"τ\"];\n"
            "  s1 -> s0 [label=\"a.1\"];\n"
            "}\n");
}

TEST(DotTest, EscapesNames) {
  const std::string text =
      write(test::lts_from("0 say.\"\\n\" 0"),
            {.state_name = [](State) { return std::string("P(\"x\",\\)\n\x01"); }});
  EXPECT_NE(text.find("s0 [label=\"P(\\\"x\\\",\\\\)\\n\\\\x01\"];"), std::string::npos) << text;
  EXPECT_NE(text.find("s0 -> s0 [label=\"say.\\\"\\\\n\\\"\"];"), std::string::npos) << text;
}

}  // namespace
}  // namespace perentie::lts
