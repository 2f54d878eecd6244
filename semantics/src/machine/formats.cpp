#include "machine/formats.hpp"

#include <algorithm>

namespace perentie::semantics {
namespace {

// Operators in operators: a bound on recursion; what lies deeper is a leaf.
constexpr std::uint32_t max_depth = 300;

// The operators whose running operands settle with the whole (`StepRules::state`).
bool settles_operands(ProcKind kind) {
  switch (kind) {
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::rename:
    case ProcKind::compression:
    case ProcKind::prioritise_partial:
      return true;
    default:
      return is_parallel(kind);
  }
}

// Where the operands of an operator stand that run from the start, as words [first, end) with a
// stride; none of a term that is always a leaf (CSPM reference 4.1.5).
struct Running {
  std::size_t first = 0;
  std::size_t end = 0;
  std::size_t stride = 1;
};

Running running_operands(ProcKind kind, std::size_t words) {
  switch (kind) {
    case ProcKind::interleave:
    case ProcKind::external_choice:
    case ProcKind::interrupt:
      return {0, words};
    case ProcKind::sequential:
    case ProcKind::sliding_choice:
    case ProcKind::prioritise:
      return {0, 1};
    case ProcKind::parallel:
    case ProcKind::link_parallel:
    case ProcKind::sync_choice:
    case ProcKind::sync_interrupt:
      return {1, words};
    case ProcKind::alphabet_parallel:
      return {1, words, 2};
    case ProcKind::exception:
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::rename:
    case ProcKind::compression:
      return {1, 2};
    case ProcKind::prioritise_partial:
      return {2, 3};
    default:
      return {};
  }
}

// In keys: what stands for a leaf, and for a word that is an operand.
constexpr std::uint32_t leaf_mark = ~std::uint32_t{0};

}  // namespace

EventBits::EventBits(const EventTable& events, EventSetId set) {
  const auto members = events.events(set);
  if (!members.empty()) bits_.resize(members.back().value + 1);
  for (const EventId event : members) bits_[event.value] = true;
}

const EventBits* FormatTable::bits(EventSetId set) {
  const auto known = bits_.find(set);
  if (known != bits_.end()) return &known->second;
  return &bits_.emplace(set, EventBits(events_, set)).first->second;
}

bool FormatTable::is_composite(ProcId term) {
  enum : std::uint8_t { unknown, no, yes };
  if (term.value < known_.size() && known_[term.value] != unknown) return known_[term.value] == yes;
  bool found = false;
  std::vector<ProcId> stack{term};
  while (!stack.empty() && !found) {
    const ProcId next = stack.back();
    stack.pop_back();
    const ProcKind kind = processes_.kind(next);
    found = is_parallel(kind);
    const auto words = processes_.words(next);
    const Running running = running_operands(kind, words.size());
    for (std::size_t i = running.first; i < running.end; i += running.stride) {
      stack.push_back(ProcId{words[i]});
    }
  }
  if (term.value >= known_.size()) known_.resize(processes_.size());
  known_[term.value] = found ? yes : no;
  return found;
}

// The key has the operators in preorder.
void FormatTable::write_key(ProcId term, std::uint32_t depth, std::vector<ProcId>& leaves) {
  if (depth >= max_depth || !is_composite(term)) {
    key_.push_back(leaf_mark);
    leaves.push_back(term);
    return;
  }
  const ProcKind kind = processes_.kind(term);
  const auto words = processes_.words(term);
  const Running running = running_operands(kind, words.size());
  key_.push_back(static_cast<std::uint32_t>(kind));
  key_.push_back(static_cast<std::uint32_t>(words.size()));
  const std::size_t first = key_.size();
  key_.insert(key_.end(), words.begin(), words.end());
  for (std::size_t i = running.first; i < running.end; i += running.stride) {
    key_[first + i] = leaf_mark;
    write_key(ProcId{words[i]}, depth + 1, leaves);
  }
}

FormatId FormatTable::split(ProcId term, std::vector<ProcId>& leaves) {
  key_.clear();
  write_key(term, 0, leaves);
  const FormatId id{keys_.intern(0, key_)};
  if (id.value == formats_.size()) add_node(formats_.emplace_back(), term, 0, true);
  return id;
}

std::uint32_t FormatTable::add_node(Format& format, ProcId term, std::uint32_t depth,
                                    bool is_settled) {
  const auto number = static_cast<std::uint32_t>(format.nodes.size());
  format.nodes.emplace_back();
  if (depth >= max_depth || !is_composite(term)) {
    FormatNode& node = format.nodes[number];
    node.is_leaf = true;
    node.is_settled = is_settled;
    node.first_leaf = format.leaf_count++;
    node.end_leaf = format.leaf_count;
    return number;
  }
  FormatNode node;
  node.first_leaf = format.leaf_count;
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
  const Running running = running_operands(node.kind, node.words.size());
  const bool settles = is_settled && settles_operands(node.kind);
  for (std::size_t i = running.first; i < running.end; i += running.stride) {
    const EventBits* alphabet = alphabetised ? bits(EventSetId{node.words[i - 1]}) : nullptr;
    node.operands.push_back({add_node(format, ProcId{node.words[i]}, depth + 1, settles),
                             static_cast<std::uint32_t>(i), alphabet});
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
