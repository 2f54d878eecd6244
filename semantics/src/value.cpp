#include "perentie/semantics/value.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "maps.hpp"

namespace perentie::semantics {
namespace {

// Small integers are those of 31 bits, biased so that their order is that of the bits.
constexpr std::int64_t small_min = -(std::int64_t{1} << 30);
constexpr std::int64_t small_max = (std::int64_t{1} << 30) - 1;

int sign(auto a, auto b) { return a < b ? -1 : (b < a ? 1 : 0); }

}  // namespace

ValueStore::ValueStore() {
  const auto unit = [this](ValueKind kind, std::uint32_t word) { return intern(kind, {word}); };
  false_ = unit(ValueKind::boolean, 0);
  true_ = unit(ValueKind::boolean, 1);
  empty_seq_ = unit(ValueKind::empty_seq, 0);
  empty_set_ = intern(ValueKind::set, std::span<const std::uint32_t>{});
  empty_map_ = intern(ValueKind::map, std::span<const std::uint32_t>{});
  int_set_ = unit(ValueKind::int_set, 0);
  proc_set_ = unit(ValueKind::proc_set, 0);
  ignored_ = unit(ValueKind::ignored, 0);
}

ValueId ValueStore::intern(ValueKind kind, std::span<const ValueId> items) {
  // ValueId is one 32-bit word: the same storage seen as words.
  static_assert(sizeof(ValueId) == sizeof(std::uint32_t));
  const auto* words = reinterpret_cast<const std::uint32_t*>(items.data());
  return intern(kind, std::span<const std::uint32_t>(words, items.size()));
}

ValueId ValueStore::make_int(std::int64_t value) {
  if (value >= small_min && value <= small_max) {
    return {ValueId::small_bit | static_cast<std::uint32_t>(value - small_min)};
  }
  const auto bits = static_cast<std::uint64_t>(value);
  return intern(ValueKind::integer, {static_cast<std::uint32_t>(bits >> 32U),
                                     static_cast<std::uint32_t>(bits & 0xFFFF'FFFFU)});
}

std::int64_t ValueStore::as_int(ValueId value) const {
  if (value.is_small_int()) {
    return static_cast<std::int64_t>(value.bits & ~ValueId::small_bit) + small_min;
  }
  return static_cast<std::int64_t>((std::uint64_t{word(value, 0)} << 32U) | word(value, 1));
}

ValueId ValueStore::make_char(unsigned char value) { return intern(ValueKind::character, {value}); }

unsigned char ValueStore::as_char(ValueId value) const {
  return static_cast<unsigned char>(word(value, 0));
}

ValueId ValueStore::make_atom(SymbolId symbol) { return intern(ValueKind::atom, {symbol.value}); }

ValueId ValueStore::make_dot(std::span<const ValueId> components) {
  PERENTIE_CHECK(components.size() >= 2, "a dot needs two components");
  return intern(ValueKind::dot, components);
}

ValueId ValueStore::make_tuple(std::span<const ValueId> items) {
  return intern(ValueKind::tuple, items);
}

ValueId ValueStore::make_cons(ValueId head, ValueId tail) {
  return intern(ValueKind::cons, {head.bits, tail.bits, length(tail) + 1});
}

ValueId ValueStore::make_seq(std::span<const ValueId> items) {
  ValueId seq = empty_seq_;
  const std::vector<ValueId> copy(items.begin(), items.end());
  for (auto item = copy.rbegin(); item != copy.rend(); ++item) seq = make_cons(*item, seq);
  return seq;
}

ValueId ValueStore::make_string(std::string_view text) {
  ValueId seq = empty_seq_;
  for (auto c = text.rbegin(); c != text.rend(); ++c) {
    seq = make_cons(make_char(static_cast<unsigned char>(*c)), seq);
  }
  return seq;
}

std::optional<std::string> ValueStore::as_string(ValueId seq) const {
  std::string text;
  for (; kind(seq) == ValueKind::cons; seq = tail(seq)) {
    if (kind(head(seq)) != ValueKind::character) return std::nullopt;
    text += static_cast<char>(as_char(head(seq)));
  }
  return text;
}

std::uint32_t ValueStore::length(ValueId seq) const {
  return kind(seq) == ValueKind::cons ? word(seq, 2) : 0;
}

ValueId ValueStore::make_set(std::vector<ValueId> elements) {
  const auto less = [this](ValueId a, ValueId b) { return compare(a, b) < 0; };
  if (!std::is_sorted(elements.begin(), elements.end(), less)) {
    std::sort(elements.begin(), elements.end(), less);
  }
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return make_sorted_set(elements);
}

ValueId ValueStore::make_sorted_set(std::span<const ValueId> elements) {
  return elements.empty() ? empty_set_ : intern(ValueKind::set, elements);
}

ValueId ValueStore::make_from_set(std::int64_t first) {
  return intern(ValueKind::from_set, {make_int(first).bits});
}

ValueId ValueStore::make_seq_set(ValueId elements) {
  return intern(ValueKind::seq_set, {elements.bits});
}

ValueId ValueStore::make_set_over(ValueKind kind, std::span<const ValueId> sets) {
  return intern(kind, sets);
}

ValueId ValueStore::make_data_set(SymbolId datatype) {
  return intern(ValueKind::data_set, {datatype.value});
}

ValueId ValueStore::make_map_node(ValueId key, ValueId value, ValueId smaller, ValueId greater) {
  return intern(ValueKind::map, {key.bits, value.bits, smaller.bits, greater.bits});
}

ValueId ValueStore::make_process(ProcId process) {
  return intern(ValueKind::process, {process.value});
}

ValueId ValueStore::make_function(std::uint32_t function, std::uint32_t group,
                                  std::uint32_t scope) {
  return intern(ValueKind::function, {function, group, scope});
}

ValueId ValueStore::make_builtin(Builtin builtin) {
  return intern(ValueKind::builtin, {static_cast<std::uint32_t>(builtin)});
}

std::span<const ValueId> ValueStore::items(ValueId value) const {
  const std::span<const std::uint32_t> words = terms_.words(value.bits);
  return {reinterpret_cast<const ValueId*>(words.data()), words.size()};
}

namespace {

// The first two keys or values in which two maps differ; if there are none, how their sizes differ.
std::pair<std::optional<MapEntry>, int> first_difference(const ValueStore& values, ValueId a,
                                                         ValueId b) {
  const std::vector<MapEntry> as = map_entries(values, a);
  const std::vector<MapEntry> bs = map_entries(values, b);
  for (std::size_t i = 0; i < std::min(as.size(), bs.size()); ++i) {
    if (as[i].first != bs[i].first) return {MapEntry{as[i].first, bs[i].first}, 0};
    if (as[i].second != bs[i].second) return {MapEntry{as[i].second, bs[i].second}, 0};
  }
  return {std::nullopt, sign(as.size(), bs.size())};
}

}  // namespace

int ValueStore::compare(ValueId a, ValueId b) const {
  // Nested values are compared with an explicit stack: data can be deep. The stack holds pairs
  // still to compare, the first difference decides.
  std::vector<std::pair<ValueId, ValueId>> stack{{a, b}};
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    if (x == y) continue;
    const ValueKind kx = kind(x);
    const ValueKind ky = kind(y);
    if (kx == ValueKind::integer && ky == ValueKind::integer) return sign(as_int(x), as_int(y));
    if (kx == ValueKind::empty_seq || ky == ValueKind::empty_seq) {
      if (is_seq(x) && is_seq(y)) return kx == ValueKind::empty_seq ? -1 : 1;
    }
    // An atom alone sorts with its applications: by the symbol first.
    if (kx != ky && (kx == ValueKind::atom || kx == ValueKind::dot) &&
        (ky == ValueKind::atom || ky == ValueKind::dot)) {
      const ValueId hx = kx == ValueKind::dot ? items(x)[0] : x;
      const ValueId hy = ky == ValueKind::dot ? items(y)[0] : y;
      if (hx == hy) return kx == ValueKind::atom ? -1 : 1;
      stack.emplace_back(hx, hy);
      continue;
    }
    if (kx != ky) return sign(kx, ky);
    if (kx == ValueKind::cons) {
      stack.emplace_back(tail(x), tail(y));
      stack.emplace_back(head(x), head(y));
      continue;
    }
    if (kx == ValueKind::map) {
      const auto difference = first_difference(*this, x, y);
      if (!difference.first) return difference.second;
      stack.push_back(*difference.first);
      continue;
    }
    if (kx == ValueKind::dot || kx == ValueKind::tuple || kx == ValueKind::set) {
      const auto xs = items(x);
      const auto ys = items(y);
      const std::size_t common = std::min(xs.size(), ys.size());
      const auto [px, py] =
          std::mismatch(xs.begin(), xs.begin() + static_cast<std::ptrdiff_t>(common), ys.begin());
      if (px == xs.begin() + static_cast<std::ptrdiff_t>(common)) {
        return sign(xs.size(), ys.size());
      }
      stack.emplace_back(*px, *py);  // they differ, so this pair decides
      continue;
    }
    // The rest are leaves whose words order them: booleans, characters, atoms in order of
    // declaration, and kinds whose order nobody sees but must be total.
    const auto wx = terms_.words(x.bits);
    const auto wy = terms_.words(y.bits);
    return std::lexicographical_compare(wx.begin(), wx.end(), wy.begin(), wy.end()) ? -1 : 1;
  }
  return 0;
}

namespace {

Ordering to_ordering(int c) {
  return c < 0 ? Ordering::less : (c > 0 ? Ordering::greater : Ordering::equal);
}

Ordering compare_prefix(const ValueStore& values, ValueId a, ValueId b) {
  while (values.kind(a) == ValueKind::cons && values.kind(b) == ValueKind::cons) {
    if (a == b) return Ordering::equal;
    if (values.head(a) != values.head(b)) return Ordering::incomparable;
    a = values.tail(a);
    b = values.tail(b);
  }
  if (a == b) return Ordering::equal;
  return values.kind(a) == ValueKind::empty_seq ? Ordering::less : Ordering::greater;
}

// Whether the sorted `a` is contained in the sorted `b`.
bool includes(const ValueStore& values, std::span<const ValueId> b, std::span<const ValueId> a) {
  return std::includes(b.begin(), b.end(), a.begin(), a.end(),
                       [&](ValueId x, ValueId y) { return values.compare(x, y) < 0; });
}

Ordering compare_inclusion(const ValueStore& values, ValueId a, ValueId b) {
  if (a == b) return Ordering::equal;
  if (includes(values, values.items(b), values.items(a))) return Ordering::less;
  if (includes(values, values.items(a), values.items(b))) return Ordering::greater;
  return Ordering::incomparable;
}

// `a <= b` as maps: every key of `a` is in `b` with a value that is at least as great.
bool is_submap(const ValueStore& values, ValueId a, ValueId b) {
  const std::vector<MapEntry> entries = map_entries(values, a);
  return std::all_of(entries.begin(), entries.end(), [&](const MapEntry& entry) {
    const std::optional<ValueId> other = map_find(values, b, entry.first);
    return other && (entry.second == *other ||
                     compare_partially(values, entry.second, *other) == Ordering::less);
  });
}

}  // namespace

std::optional<Ordering> compare_partially(const ValueStore& values, ValueId a, ValueId b) {
  const ValueKind ka = values.kind(a);
  const ValueKind kb = values.kind(b);
  if (values.is_seq(a) && values.is_seq(b)) return compare_prefix(values, a, b);
  if (ka != kb) return std::nullopt;
  switch (ka) {
    case ValueKind::integer:
    case ValueKind::character:
    case ValueKind::tuple:
      return to_ordering(values.compare(a, b));
    case ValueKind::set:
      return compare_inclusion(values, a, b);
    case ValueKind::map:
      if (a == b) return Ordering::equal;
      if (is_submap(values, a, b)) return Ordering::less;
      if (is_submap(values, b, a)) return Ordering::greater;
      return Ordering::incomparable;
    default:
      return std::nullopt;
  }
}

}  // namespace perentie::semantics
