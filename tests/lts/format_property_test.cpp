// Whatever is written is read back: .aut by our reader, JSON by nlohmann-json.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "perentie/lts/aut.hpp"
#include "perentie/lts/dot.hpp"
#include "perentie/lts/json.hpp"
#include "perentie/test/gen_lts.hpp"

namespace perentie::lts {
namespace {

using NamedEdge = std::tuple<std::uint32_t, std::string, std::uint32_t>;

std::set<NamedEdge> named_edges(const Lts& lts) {
  std::set<NamedEdge> edges;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      edges.insert({s, std::string(lts.name(edge.label)), edge.target.value});
    }
  }
  return edges;
}

/// An event name of any characters that the formats must cope with.
rc::Gen<std::string> arbitrary_name() {
  return rc::gen::map(
      rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(std::vector<std::string>{
          "tau", "tick", "i",  "τ",  "✓",   "a",     ".", ",",    "(",    ")", " ", "\t",
          "\n",  "\r",   "\"", "\\", "\\n", "\\x41", "x", "\x01", "\x7F", "ö", "0"})),
      [](const std::vector<std::string>& parts) {
        std::string name;
        for (const std::string& part : parts) name += part;
        return name;
      });
}

Lts arbitrary_named_lts() {
  const Lts shape = *test::arbitrary_lts({.max_states = 6, .events = {"a", "b", "c"}});
  LabelNames names(shape.label_names().begin(), shape.label_names().begin() + 2);
  std::set<std::string> used(names.begin(), names.end());
  while (names.size() < shape.label_names().size()) {
    std::string name = *arbitrary_name();
    while (!used.insert(name).second) name += "'";
    names.push_back(name);
  }
  LtsBuilder builder(std::make_shared<const LabelNames>(std::move(names)));
  builder.add_states(static_cast<std::uint32_t>(shape.state_count()));
  for (std::uint32_t s = 0; s < shape.state_count(); ++s) {
    for (const Edge& edge : shape.edges(State{s})) {
      builder.add_edge(State{s}, edge.label, edge.target);
    }
  }
  return std::move(builder).finish(
      State{*rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(shape.state_count()))});
}

RC_GTEST_PROP(FormatPropertyTest, AutRoundTrip, ()) {
  const Lts lts = arbitrary_named_lts();
  const AutOptions options{.tau = *rc::gen::element<std::string>("tau", "i")};
  std::ostringstream out;
  write_aut(out, lts, options);
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto read = read_aut("x.aut", out.str(), sources, diagnostics, options);
  RC_ASSERT(base::render_all(diagnostics, sources) == "");
  RC_ASSERT(read.has_value());
  RC_ASSERT(read->state_count() == lts.state_count());
  RC_ASSERT(read->initial() == lts.initial());
  RC_ASSERT(named_edges(*read) == named_edges(lts));
  // The second copy is the same to the byte, save that labels are numbered as they appear.
  std::ostringstream again;
  write_aut(again, *read, options);
  RC_ASSERT(again.str().size() == out.str().size());
}

RC_GTEST_PROP(FormatPropertyTest, JsonRoundTrip, ()) {
  const Lts lts = arbitrary_named_lts();
  std::ostringstream out;
  write_json(out, lts);
  const auto json = nlohmann::json::parse(out.str());
  RC_ASSERT(json.at("schema") == "perentie.lts/1");
  RC_ASSERT(json.at("states") == lts.state_count());
  RC_ASSERT(json.at("initial") == lts.initial().value);
  std::set<NamedEdge> edges;
  for (const auto& edge : json.at("transitions")) {
    const auto& label = json.at("labels").at(edge.at(1).get<std::size_t>());
    edges.emplace(edge.at(0).get<std::uint32_t>(), label.get<std::string>(),
                  edge.at(2).get<std::uint32_t>());
  }
  RC_ASSERT(edges == named_edges(lts));
}

RC_GTEST_PROP(FormatPropertyTest, DotLinesHaveBalancedQuotes, ()) {
  const Lts lts = arbitrary_named_lts();
  std::ostringstream out;
  write_dot(out, lts);
  std::istringstream lines(out.str());
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::size_t quotes = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\\') {
        ++i;
      } else if (line[i] == '"') {
        ++quotes;
      }
    }
    RC_ASSERT(quotes % 2 == 0);
  }
  RC_ASSERT(count == 6 + lts.state_count() + lts.edge_count());
}

/// Damaging a file anywhere gives a graph or a diagnostic, never anything else.
RC_GTEST_PROP(FormatPropertyTest, DamagedAutFilesAreRefusedOrRead, ()) {
  std::ostringstream out;
  write_aut(out, arbitrary_named_lts());
  std::string text = out.str();
  const auto changes = *rc::gen::inRange(1, 4);
  for (int i = 0; i < changes; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        text.erase(at, 1);
        break;
      case 1:
        text.insert(at, 1, *rc::gen::element(',', '(', ')', '"', '\n', '9', '\\', '\xFF'));
        break;
      default:
        text.resize(at + 1);
        break;
    }
  }
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto read = read_aut("x.aut", text, sources, diagnostics);
  RC_ASSERT(read.has_value() != diagnostics.has_errors());
  for (const base::Diagnostic& diagnostic : diagnostics.all())
    RC_ASSERT(diagnostic.span.has_value());
  base::render_all(diagnostics, sources);
}

}  // namespace
}  // namespace perentie::lts
