#include <ostream>
#include <vector>

#include "aut_words.hpp"
#include "perentie/lts/aut.hpp"
#include "text_sink.hpp"

namespace perentie::lts {

void write_aut(std::ostream& out, const Lts& lts, const AutOptions& options) {
  std::vector<std::string> labels;
  for (std::uint32_t i = 0; i < lts.label_names().size(); ++i) {
    const Label label{i};
    const std::string text = label == tau    ? options.tau
                             : label == tick ? std::string(aut_tick)
                                             : escape_aut_event(lts.name(label), options.tau);
    labels.push_back(",\"" + text + "\",");
  }
  TextSink text(out);
  text << "des (" << std::uint64_t{lts.initial().value} << ',' << lts.edge_count() << ','
       << lts.state_count() << ")\n";
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      text << '(' << std::uint64_t{s} << labels[edge.label.value]
           << std::uint64_t{edge.target.value} << ")\n";
    }
  }
}

}  // namespace perentie::lts
