#include "perentie/lts/json.hpp"

#include <nlohmann/json.hpp>

#include "text_sink.hpp"

namespace perentie::lts {

namespace {

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The labels that the file names: τ, ✓, and those that occur.
std::vector<Label> listed_labels(const Lts& lts) {
  std::vector<Label> labels{tau, tick};
  for (const Label label : lts.alphabet()) labels.push_back(label);
  return labels;
}

}  // namespace

void write_json(std::ostream& out, const Lts& lts, const JsonOptions& options) {
  const std::vector<Label> labels = listed_labels(lts);
  std::vector<std::uint64_t> number(lts.label_names().size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i) number[labels[i].value] = i;

  TextSink text(out);
  text << "{\n\"schema\": \"perentie.lts/1\",\n\"initial\": " << std::uint64_t{lts.initial().value}
       << ",\n\"states\": " << lts.state_count() << ",\n\"labels\": [";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    text << (i == 0 ? "" : ", ") << json_string(lts.name(labels[i]));
  }
  text << "],\n\"transitions\": [";
  std::string_view separator = "\n";
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      text << separator << '[' << std::uint64_t{s} << ',' << number[edge.label.value] << ','
           << std::uint64_t{edge.target.value} << ']';
      separator = ",\n";
    }
  }
  text << "\n]";
  if (options.state_name) {
    text << ",\n\"state_names\": [";
    for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
      text << (s == 0 ? "\n" : ",\n") << json_string(options.state_name(State{s}));
    }
    text << "\n]";
  }
  text << "\n}\n";
}

}  // namespace perentie::lts
