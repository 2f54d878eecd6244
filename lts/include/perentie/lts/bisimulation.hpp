// strong_bisimulation: the quotient of an Lts by its coarsest strong bisimulation.
//
// Input: an Lts and, if wanted, an initial partition that the result must respect, such as the
// labels of a generalised Lts (CSPM reference 4.7.4). Output: the quotient and the block of each
// state. Time O(m log n) expected for n states and m edges, memory about 50 bytes an edge. After
// Paige & Tarjan, *Three Partition Refinement Algorithms*, SIAM J. Comput. 16 (1987), and Valmari,
// *Bisimilarity Minimization in O(m log n) Time*, Petri Nets 2009; blocks are split by signatures
// as in Jacobs & Wißmann, *Fast Coalgebraic Bisimilarity Minimization*, POPL 2023.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// A smaller Lts, and what became of the states of the original.
struct Quotient {
  Lts lts;  ///< numbered breadth first from the initial state; the label table is shared
  /// By state of the original: its block, a state of `lts`. None: the initial state does not lead
  /// to the block.
  std::vector<State> block_of;
};

/// States of different classes are never merged. `classes` is by state, any numbers; empty: all
/// states are of one class.
Quotient strong_bisimulation(const Lts& lts, std::span<const std::uint32_t> classes = {});

}  // namespace perentie::lts
