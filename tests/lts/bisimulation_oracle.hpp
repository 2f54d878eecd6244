// Bisimilarity by definition, for graphs of at most 64 states: the greatest fixed point, found by
// splitting classes until nothing changes.
#pragma once

#include <cstdint>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::test {

/// Delay bisimulation matches a visible step by τ* a and τ by τ*; weak bisimulation by τ* a τ* and
/// τ*. Both keep apart what diverges and what does not (CSPM reference 4.7.5).
enum class Bisimilarity : std::uint8_t { strong, delay, weak };

/// By state: its class, in order of first appearance. States of different `classes` are never
/// together; empty: all may be.
std::vector<std::uint32_t> bisimilarity_classes(const lts::Lts& lts, Bisimilarity kind,
                                                std::vector<std::uint32_t> classes = {});
/// Both graphs side by side, the states of `b` after those of `a`; the initial state is that of
/// `a`. The labels must be the same.
lts::Lts side_by_side(const lts::Lts& a, const lts::Lts& b);
/// Whether the initial states are bisimilar.
bool are_bisimilar(const lts::Lts& a, const lts::Lts& b, Bisimilarity kind);

}  // namespace perentie::test
