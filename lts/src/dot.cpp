#include "perentie/lts/dot.hpp"

#include <fmt/format.h>

#include "text_sink.hpp"

namespace perentie::lts {

namespace {

/// A quoted DOT string that shows `text`. Only `"` ends such a string, but Graphviz gives
/// backslashes a meaning of its own when it draws.
std::string dot_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace

void write_dot(std::ostream& out, const Lts& lts, const DotOptions& options) {
  TextSink text(out);
  text << "digraph lts {\n"
          "  rankdir=LR;\n"
          "  node [shape=circle];\n"
          "  initial [shape=point, label=\"\"];\n";
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    const std::string name = options.state_name ? options.state_name(State{s}) : std::to_string(s);
    text << "  s" << std::uint64_t{s} << " [label=" << dot_string(name) << "];\n";
  }
  text << "  initial -> s" << std::uint64_t{lts.initial().value} << ";\n";
  std::vector<std::string> labels;
  for (const std::string& name : lts.label_names()) labels.push_back(dot_string(name));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      text << "  s" << std::uint64_t{s} << " -> s" << std::uint64_t{edge.target.value}
           << " [label=" << labels[edge.label.value] << "];\n";
    }
  }
  text << "}\n";
}

}  // namespace perentie::lts
