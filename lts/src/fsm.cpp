#include "perentie/lts/fsm.hpp"

#include "text_sink.hpp"

namespace perentie::lts {

namespace {

std::string fsm_label(const Lts& lts, Label label) {
  if (label == tau) return "tau";
  if (label == tick) return "tick";
  std::string name(lts.name(label));
  for (char& c : name) {
    if (c == '"') c = '\'';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return name;
}

}  // namespace

void write_fsm(std::ostream& out, const Lts& lts) {
  const auto number = [&](std::uint32_t state) -> std::uint64_t {
    if (state == lts.initial().value) return 1;
    return (state == 0 ? lts.initial().value : state) + std::uint64_t{1};
  };
  std::vector<std::string> labels;
  for (std::uint32_t l = 0; l < lts.label_names().size(); ++l) {
    labels.push_back(fsm_label(lts, Label{l}));
  }
  // Without parameters the line of a state is empty.
  TextSink text(out);
  text << "---\n";
  for (std::size_t s = 0; s < lts.state_count(); ++s) text << '\n';
  text << "---\n";
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      text << number(s) << ' ' << number(edge.target.value) << " \"" << labels[edge.label.value]
           << "\"\n";
    }
  }
}

}  // namespace perentie::lts
