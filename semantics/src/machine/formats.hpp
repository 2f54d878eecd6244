// Formats: the operators of a process term without the leaves between which they stand.
//
// A term is composite if parallel operators run in it; its state is then its format and one term
// for each leaf, in order (CSPM reference 6.1.3). Both are functions of the term, so that equal
// terms are equal states. Everything else is a leaf by itself: a name, a prefix, a choice among
// such, whatever it may become later.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "machine/event_bits.hpp"
#include "perentie/base/term_table.hpp"
#include "perentie/semantics/event.hpp"
#include "perentie/semantics/process.hpp"
#include "perentie/semantics/step.hpp"

namespace perentie::semantics {

using FormatId = base::Id<struct FormatTag>;

/// The nodes of a format in preorder; the root is 0.
struct FormatNode {
  struct Operand {
    std::uint32_t node;
    std::uint32_t word;                   ///< of the term: where the operand stands
    const EventBits* alphabet = nullptr;  ///< of an alphabetised parallel
  };

  ProcKind kind = ProcKind::stop;  ///< of an operator
  bool is_leaf = false;
  /// Of a leaf: all operators around it stay in place, so the names that it becomes are followed.
  bool is_settled = false;
  bool is_below_priority = false;  ///< some operator around it is a `prioritise`
  /// The leaves below: [first_leaf, end_leaf).
  std::uint32_t first_leaf = 0;
  std::uint32_t end_leaf = 0;
  /// Of an operator: it terminates when all its leaves do, and only then.
  bool ends_with_leaves = false;
  std::vector<std::uint32_t> words;   ///< of an operator's term; those of operands do not matter
  std::vector<Operand> operands;      ///< those that run
  const EventBits* events = nullptr;  ///< of an operator with one set
};

struct Format {
  std::vector<FormatNode> nodes;
  std::uint32_t leaf_count = 0;
};

class FormatTable {
 public:
  FormatTable(const EventTable& events, ProcStore& processes, StepRules& rules)
      : events_(events), processes_(processes), rules_(rules) {}

  bool is_composite(ProcId term, bool is_below_priority);
  /// The format of a composite term; its leaves are appended to `leaves`.
  FormatId split(ProcId term, std::vector<ProcId>& leaves);
  const Format& operator[](FormatId id) const { return formats_[id.value]; }
  std::size_t size() const { return formats_.size(); }

  /// The term of a node with the leaves of its format.
  ProcId join(const Format& format, std::uint32_t node, std::span<const ProcId> leaves);

 private:
  // Where a term stands in a format.
  struct Place {
    std::uint32_t depth = 0;
    bool is_settled = true;
    bool is_below_priority = false;

    Place below(ProcKind kind) const;
  };

  bool is_leaf(ProcId term, const Place& place);
  void write_key(ProcId term, const Place& place, std::vector<ProcId>& leaves);
  std::uint32_t add_node(Format& format, ProcId term, const Place& place);
  const EventBits* bits(EventSetId set);

  const EventTable& events_;
  ProcStore& processes_;
  StepRules& rules_;
  std::deque<Format> formats_;
  base::TermTable keys_;                // of formats, by id
  std::vector<std::uint32_t> key_;      // scratch
  std::vector<std::uint8_t> known_[2];  // by term: whether it is composite, below priority or not
  std::map<EventSetId, EventBits> bits_;
};

}  // namespace perentie::semantics
