// Discovery: numbers classes of states in the order in which a search finds them.
//
// Classes (blocks, components) are known by numbers of their own. The steps that make a quotient
// walk the classes that the initial one leads to, and give them new numbers as they are met.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "perentie/lts/bisimulation.hpp"

namespace perentie::lts {

class Discovery {
 public:
  explicit Discovery(std::size_t class_count) : number_(class_count) {}

  /// The new number of a class. If it is met the first time, `member` is what it was found through.
  State find(std::uint32_t class_of_member, State member) {
    State& number = number_[class_of_member];
    if (number.is_none()) {
      number = State{static_cast<std::uint32_t>(found_.size())};
      found_.push_back(member);
    }
    return number;
  }

  std::size_t size() const { return found_.size(); }
  /// By new number, the state through which the class was found.
  State operator[](std::size_t number) const { return found_[number]; }
  /// The new number of a class; `none` if it was not found.
  State number(std::uint32_t class_number) const { return number_[class_number]; }

 private:
  std::vector<State> number_;
  std::vector<State> found_;
};

/// The quotient of a graph by classes. `class_of(state)` is below `class_count`; `edges_of(state,
/// add)` calls `add(label, target)`, targets being states of `lts`, with the edges of the class of
/// a state.
template <class ClassOf, class EdgesOf>
Quotient quotient_by(const Lts& lts, std::size_t class_count, ClassOf class_of, EdgesOf edges_of) {
  Discovery classes(class_count);
  LtsRowBuilder rows;
  classes.find(class_of(lts.initial()), lts.initial());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    edges_of(classes[i], [&](Label label, State target) {
      rows.add_edge(label, classes.find(class_of(target), target));
    });
    rows.end_row();
  }
  std::vector<State> block_of(lts.state_count());
  for (std::uint32_t s = 0; s < block_of.size(); ++s) {
    block_of[s] = classes.number(class_of(State{s}));
  }
  return {std::move(rows).finish(State{0}, classes.size(), lts.shared_label_names()),
          std::move(block_of)};
}

}  // namespace perentie::lts
