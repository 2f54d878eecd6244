#include "perentie/lts/graphml.hpp"

#include "text_sink.hpp"

namespace perentie::lts {

namespace {

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\n':
      case '\t':
        result += c;
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          result += "\xEF\xBF\xBD";
        } else {
          result += c;
        }
    }
  }
  return result;
}

}  // namespace

void write_graphml(std::ostream& out, const Lts& lts, const GraphmlOptions& options) {
  TextSink text(out);
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n"
          "<key id=\"label\" for=\"edge\" attr.name=\"label\" attr.type=\"string\"/>\n"
          "<key id=\"initial\" for=\"node\" attr.name=\"initial\" attr.type=\"boolean\">"
          "<default>false</default></key>\n"
          "<key id=\"name\" for=\"node\" attr.name=\"name\" attr.type=\"string\"/>\n"
          "<graph id=\"lts\" edgedefault=\"directed\">\n";
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    text << "<node id=\"s" << std::uint64_t{s} << "\">";
    if (State{s} == lts.initial()) text << "<data key=\"initial\">true</data>";
    if (options.state_name) {
      text << "<data key=\"name\">" << xml_text(options.state_name(State{s})) << "</data>";
    }
    text << "</node>\n";
  }
  std::vector<std::string> labels;
  for (const std::string& name : lts.label_names()) labels.push_back(xml_text(name));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      text << "<edge source=\"s" << std::uint64_t{s} << "\" target=\"s"
           << std::uint64_t{edge.target.value} << "\"><data key=\"label\">"
           << labels[edge.label.value] << "</data></edge>\n";
    }
  }
  text << "</graph>\n</graphml>\n";
}

}  // namespace perentie::lts
