#include "perentie/lts/hide.hpp"

#include <vector>

namespace perentie::lts {

namespace {

std::vector<bool> membership(const Lts& lts, std::span<const Label> labels) {
  std::vector<bool> is_member(lts.label_names().size(), false);
  for (const Label label : labels) is_member[label.value] = true;
  return is_member;
}

}  // namespace

Lts hide_if(const Lts& lts, const std::function<bool(Label)>& hidden) {
  std::vector<Label> image;
  for (std::uint32_t i = 0; i < lts.label_names().size(); ++i) {
    const Label label{i};
    image.push_back(label > tick && hidden(label) ? tau : label);
  }
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s}))
      rows.add_edge(image[edge.label.value], edge.target);
    rows.end_row();
  }
  return std::move(rows).finish(lts.initial(), lts.state_count(), lts.shared_label_names());
}

Lts hide(const Lts& lts, std::span<const Label> hidden) {
  const std::vector<bool> is_hidden = membership(lts, hidden);
  return hide_if(lts, [&](Label label) { return bool{is_hidden[label.value]}; });
}

Lts project(const Lts& lts, std::span<const Label> kept) {
  const std::vector<bool> is_kept = membership(lts, kept);
  return hide_if(lts, [&](Label label) { return !is_kept[label.value]; });
}

}  // namespace perentie::lts
