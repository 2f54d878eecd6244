#include "machine/formats.hpp"

#include <algorithm>
#include <utility>

namespace perentie::semantics {
namespace {

// Operators in operators: a bound on recursion; what lies deeper is a leaf.
constexpr std::uint32_t max_depth = 300;

// In keys: what stands for a leaf, and for a word that is an operand.
constexpr std::uint32_t leaf_mark = ~std::uint32_t{0};

}  // namespace

const EventBits* FormatTable::bits(EventSetId set) {
  const auto known = bits_.find(set);
  if (known != bits_.end()) return &known->second;
  return &bits_.emplace(set, EventBits(events_, set)).first->second;
}

FormatTable::Place FormatTable::Place::below(ProcKind kind) const {
  return {depth + 1, is_settled && stays_in_place(kind), is_below_priority || is_priority(kind)};
}

bool FormatTable::is_composite(ProcId term, bool is_below_priority) {
  enum : std::uint8_t { unknown, no, yes };
  auto& known = known_[is_below_priority ? 1 : 0];
  if (term.value < known.size() && known[term.value] != unknown) return known[term.value] == yes;
  bool found = false;
  std::vector<std::pair<ProcId, bool>> stack{{term, is_below_priority}};
  while (!stack.empty() && !found) {
    const auto [next, below] = stack.back();
    stack.pop_back();
    const ProcKind kind = processes_.kind(next);
    found = is_parallel(kind);
    if (kind == ProcKind::compression && rules_.is_applied(next, below)) continue;
    const auto words = processes_.words(next);
    const RunningOperands running = running_operands(kind, words.size());
    for (std::size_t i = 0; i < running.count; ++i) {
      stack.emplace_back(ProcId{words[running.first + i * running.stride]},
                         below || is_priority(kind));
    }
  }
  if (term.value >= known.size()) known.resize(processes_.size());
  known[term.value] = found ? yes : no;
  return found;
}

bool FormatTable::is_leaf(ProcId term, const Place& place) {
  return place.depth >= max_depth || !is_composite(term, place.is_below_priority);
}

// The key has the operators in preorder.
void FormatTable::write_key(ProcId term, const Place& place, std::vector<ProcId>& leaves) {
  if (is_leaf(term, place)) {
    key_.push_back(leaf_mark);
    leaves.push_back(term);
    return;
  }
  const ProcKind kind = processes_.kind(term);
  const auto stored = processes_.words(term);
  const std::vector<std::uint32_t> words(stored.begin(), stored.end());  // compressions make terms
  const RunningOperands running = running_operands(kind, words.size());
  key_.push_back(static_cast<std::uint32_t>(kind));
  key_.push_back(static_cast<std::uint32_t>(words.size()));
  const std::size_t first = key_.size();
  key_.insert(key_.end(), words.begin(), words.end());
  for (std::size_t i = 0; i < running.count; ++i) {
    const std::size_t word = running.first + i * running.stride;
    key_[first + word] = leaf_mark;
    write_key(ProcId{words[word]}, place.below(kind), leaves);
  }
}

FormatId FormatTable::split(ProcId term, std::vector<ProcId>& leaves) {
  key_.clear();
  write_key(term, {}, leaves);
  const FormatId id{keys_.intern(0, key_)};
  if (id.value == formats_.size()) add_node(formats_.emplace_back(), term, {});
  return id;
}

std::uint32_t FormatTable::add_node(Format& format, ProcId term, const Place& place) {
  const auto number = static_cast<std::uint32_t>(format.nodes.size());
  format.nodes.emplace_back();
  if (is_leaf(term, place)) {
    FormatNode& node = format.nodes[number];
    node.is_leaf = true;
    node.is_settled = place.is_settled;
    node.is_below_priority = place.is_below_priority;
    node.first_leaf = format.leaf_count++;
    node.end_leaf = format.leaf_count;
    return number;
  }
  FormatNode node;
  node.first_leaf = format.leaf_count;
  node.is_below_priority = place.is_below_priority;
  node.kind = processes_.kind(term);
  const auto stored = processes_.words(term);
  node.words.assign(stored.begin(), stored.end());
  const bool alphabetised = node.kind == ProcKind::alphabet_parallel;
  switch (node.kind) {
    case ProcKind::parallel:
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::exception:
    case ProcKind::sync_choice:
    case ProcKind::sync_interrupt:
      node.events = bits(EventSetId{node.words[0]});
      break;
    default:
      break;
  }
  node.ends_with_leaves = is_parallel(node.kind) || node.kind == ProcKind::hide ||
                          node.kind == ProcKind::project || node.kind == ProcKind::rename;
  const RunningOperands running = running_operands(node.kind, node.words.size());
  const Place below = place.below(node.kind);
  for (std::size_t i = 0; i < running.count; ++i) {
    const std::size_t word = running.first + i * running.stride;
    const EventBits* alphabet = alphabetised ? bits(EventSetId{node.words[word - 1]}) : nullptr;
    node.operands.push_back({add_node(format, ProcId{node.words[word]}, below),
                             static_cast<std::uint32_t>(word), alphabet});
    const FormatNode& operand = format.nodes[node.operands.back().node];
    node.ends_with_leaves = node.ends_with_leaves && (operand.is_leaf || operand.ends_with_leaves);
  }
  node.end_leaf = format.leaf_count;
  format.nodes[number] = std::move(node);
  return number;
}

ProcId FormatTable::join(const Format& format, std::uint32_t number,
                         std::span<const ProcId> leaves) {
  const FormatNode& node = format.nodes[number];
  if (node.is_leaf) return leaves[node.first_leaf];
  std::vector<std::uint32_t> words = node.words;
  for (const FormatNode::Operand& operand : node.operands) {
    words[operand.word] = join(format, operand.node, leaves).value;
  }
  return processes_.make(node.kind, words);
}

}  // namespace perentie::semantics
