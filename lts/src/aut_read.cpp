// The .aut reader. A line is taken apart from both ends: the source from the left, the target from
// the right, and what is between the commas is the label, whatever characters it has. Each spelling
// of a label is interpreted once.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "aut_words.hpp"
#include "perentie/base/text.hpp"
#include "perentie/base/unique_index.hpp"
#include "perentie/lts/aut.hpp"
#include "perentie/lts/diagnostic_codes.hpp"

namespace perentie::lts {

namespace {

constexpr std::size_t max_errors = 20;
/// States that no transition mentions are allowed, but a header that has more of them than this
/// must be wrong, and believing it would cost memory for each.
constexpr std::uint64_t max_unmentioned_states = 1'000'000;
/// How much of a long line is kept on each side of an error.
constexpr std::size_t excerpt_reach = 200;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }  // UTF-8

struct Line {
  const char* begin = nullptr;
  const char* end = nullptr;
  std::uint32_t number = 0;  ///< from 1
};

/// The labels of the file: their spellings, and the names that these stand for.
class LabelTable {
 public:
  explicit LabelTable(const AutOptions& options) : tau_word_(options.tau) {
    add(std::string(tau_name));
    add(std::string(tick_name));
  }

  /// `spelling` must stay where it is.
  Label find_or_add(std::string_view spelling) {
    const auto [number, is_new] = index_.find_or_insert(
        std::hash<std::string_view>{}(spelling), static_cast<std::uint32_t>(spellings_.size()),
        [&](std::uint32_t i) { return spellings_[i].text == spelling; });
    if (is_new) spellings_.push_back({spelling, interpret(spelling)});
    return spellings_[number].label;
  }

  /// Grows with the table.
  std::shared_ptr<const LabelNames> names() const { return names_; }

 private:
  struct Spelling {
    std::string_view text;
    Label label;
  };

  Label interpret(std::string_view text) {
    const bool is_quoted = text.starts_with('"');
    if (is_quoted) text = text.substr(1, text.size() - 2);
    if (text == tau_word_) return tau;
    if (text == aut_tick) return tick;
    return add(is_quoted ? unescape_aut(text) : std::string(text));
  }

  Label add(const std::string& name) {
    const Label next{static_cast<std::uint32_t>(names_->size())};
    const auto [found, is_new] = by_name_.emplace(name, next);
    if (is_new) names_->push_back(name);
    return found->second;
  }

  std::string tau_word_;
  std::vector<Spelling> spellings_;
  base::UniqueIndex index_;  // into spellings_
  std::shared_ptr<LabelNames> names_ = std::make_shared<LabelNames>();
  std::unordered_map<std::string, Label> by_name_;
};

class AutReader {
 public:
  AutReader(std::string_view path, std::string_view text, base::SourceMap& sources,
            base::Diagnostics& diagnostics, const AutOptions& options)
      : path_(path),
        next_(text.data()),
        end_(text.data() + text.size()),
        sources_(sources),
        diagnostics_(diagnostics),
        labels_(options),
        builder_(labels_.names()) {
    if (text.starts_with("\xEF\xBB\xBF")) next_ += 3;  // a byte order mark
    line_.begin = line_.end = at_ = next_;
  }

  std::optional<Lts> read();

 private:
  struct HeaderNumber {
    std::uint64_t value = 0;
    const char* at = nullptr;
  };

  bool next_line();
  bool read_header();
  bool read_edge();
  bool check_counts();

  void skip_blanks() {
    while (at_ != line_.end && is_blank(*at_)) ++at_;
  }
  bool expect(std::string_view token, const base::DiagnosticCode& code);
  bool read_number(std::uint64_t& number, const base::DiagnosticCode& code);
  bool check_state(std::uint64_t state, const char* at);
  bool error(const base::DiagnosticCode& code, const Line& line, const char* at,
             std::string message);

  std::string_view path_;
  const char* next_;  // where the line after line_ begins
  const char* end_;
  base::SourceMap& sources_;
  base::Diagnostics& diagnostics_;
  std::size_t errors_ = 0;

  Line line_;                 // without the blanks at its end
  const char* at_ = nullptr;  // how far line_ has been read
  Line header_;
  HeaderNumber initial_;
  HeaderNumber transitions_;
  HeaderNumber states_;
  std::uint64_t edges_read_ = 0;
  LabelTable labels_;
  LtsBuilder builder_;
};

/// Reports at a place of a line. Always false.
bool AutReader::error(const base::DiagnosticCode& code, const Line& line, const char* at,
                      std::string message) {
  ++errors_;
  const char* begin =
      std::max(line.begin, at - std::min<std::ptrdiff_t>(at - line.begin, excerpt_reach));
  while (begin < at && is_continuation(*begin)) ++begin;
  const char* end = at + std::min<std::ptrdiff_t>(line.end - at, excerpt_reach);
  const auto columns_before =
      std::count_if(line.begin, begin, [](char c) { return !is_continuation(c); });
  const base::Position first{path_, line.number, static_cast<std::uint32_t>(columns_before) + 1};
  const auto file = sources_.add_excerpt(first, std::string(begin, end));
  if (!file) {
    diagnostics_.report(code, std::move(message));
    return false;
  }
  const auto place = sources_.span(*file).begin + static_cast<base::Offset>(at - begin);
  diagnostics_.report(code, {place, place + 1}, std::move(message));
  return false;
}

/// Moves to the next line that is not blank.
bool AutReader::next_line() {
  while (next_ != end_) {
    ++line_.number;
    line_.begin = next_;
    const void* newline = std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_));
    line_.end = newline == nullptr ? end_ : static_cast<const char*>(newline);
    next_ = newline == nullptr ? end_ : line_.end + 1;
    while (line_.end != line_.begin && is_blank(line_.end[-1])) --line_.end;
    at_ = line_.begin;
    skip_blanks();
    if (at_ != line_.end) return true;
  }
  return false;
}

bool AutReader::expect(std::string_view token, const base::DiagnosticCode& code) {
  skip_blanks();
  const std::string_view rest(at_, static_cast<std::size_t>(line_.end - at_));
  if (!rest.starts_with(token)) return error(code, line_, at_, fmt::format("expected `{}`", token));
  at_ += token.size();
  return true;
}

bool AutReader::read_number(std::uint64_t& number, const base::DiagnosticCode& code) {
  skip_blanks();
  const char* begin = at_;
  number = 0;
  while (at_ != line_.end && is_digit(*at_)) {
    number = number * 10 + static_cast<std::uint64_t>(*at_ - '0');
    ++at_;
  }
  if (at_ == begin) return error(code, line_, at_, "expected a number");
  constexpr int safe_digits = 19;  // any number of so many digits fits
  if (at_ - begin > safe_digits) {
    return error(codes::aut_number_too_large, line_, begin, "this number is too large");
  }
  return true;
}

bool AutReader::read_header() {
  const base::DiagnosticCode& code = codes::aut_bad_header;
  const auto read = [&](HeaderNumber& number) {
    skip_blanks();
    number.at = at_;
    return read_number(number.value, code);
  };
  if (!next_line()) line_.number = std::max(line_.number, 1U);  // the error below is at the end
  header_ = line_;
  const std::string_view rest(at_, static_cast<std::size_t>(line_.end - at_));
  if (!rest.starts_with("des")) {
    return error(code, line_, at_, "expected `des (initial, transitions, states)`");
  }
  at_ += 3;
  if (!(expect("(", code) && read(initial_) && expect(",", code) && read(transitions_) &&
        expect(",", code) && read(states_) && expect(")", code))) {
    return false;
  }
  skip_blanks();
  if (at_ != line_.end) return error(code, line_, at_, "nothing may follow on this line");

  if (states_.value == 0) return error(code, line_, states_.at, "an LTS has at least one state");
  if (states_.value > State::none_value) {
    return error(
        codes::aut_number_too_large, line_, states_.at,
        fmt::format("more than {} states cannot be read", base::with_thousands(State::none_value)));
  }
  return check_state(initial_.value, initial_.at);
}

bool AutReader::check_state(std::uint64_t state, const char* at) {
  if (state < states_.value) return true;
  return error(codes::aut_no_such_state, line_, at,
               fmt::format("there is no state `{}`: states are numbered from 0 and the header says "
                           "that there are {}",
                           state, base::with_thousands(states_.value)));
}

bool AutReader::read_edge() {
  const base::DiagnosticCode& code = codes::aut_bad_edge;
  std::uint64_t source = 0;
  std::uint64_t target = 0;
  if (!expect("(", code)) return false;
  skip_blanks();
  const char* const source_at = at_;
  if (!read_number(source, code) || !expect(",", code)) return false;
  skip_blanks();
  const char* const label_at = at_;

  const char* comma = line_.end;
  while (comma != label_at && comma[-1] != ',') --comma;
  if (comma == label_at) {
    return error(code, line_, label_at, "expected a label, a comma and the target state");
  }
  at_ = comma;
  skip_blanks();
  const char* const target_at = at_;
  if (!read_number(target, code) || !expect(")", code)) return false;
  skip_blanks();
  if (at_ != line_.end) return error(code, line_, at_, "nothing may follow on this line");

  const char* label_end = comma - 1;
  while (label_end != label_at && is_blank(label_end[-1])) --label_end;
  const std::string_view label(label_at, static_cast<std::size_t>(label_end - label_at));
  if (label.empty()) return error(code, line_, label_at, "the label is missing");
  if (label.front() == '"' && (label.size() == 1 || label.back() != '"')) {
    return error(code, line_, label_at, "the quotes of this label are not closed");
  }
  if (!check_state(source, source_at) || !check_state(target, target_at)) return false;
  builder_.add_edge(State{static_cast<std::uint32_t>(source)}, labels_.find_or_add(label),
                    State{static_cast<std::uint32_t>(target)});
  return true;
}

/// Whether the header's numbers are those of the transitions that followed.
bool AutReader::check_counts() {
  const std::uint64_t mentionable = 2 * edges_read_ + 1;
  if (edges_read_ != transitions_.value) {
    return error(
        codes::aut_wrong_count, header_, transitions_.at,
        fmt::format("the header says {} transitions, but {} follow",
                    base::with_thousands(transitions_.value), base::with_thousands(edges_read_)));
  }
  if (states_.value > mentionable + max_unmentioned_states) {
    return error(
        codes::aut_wrong_count, header_, states_.at,
        fmt::format("the header says {} states, but the transitions can mention only {}",
                    base::with_thousands(states_.value), base::with_thousands(mentionable)));
  }
  return true;
}

std::optional<Lts> AutReader::read() {
  if (!read_header()) return std::nullopt;
  constexpr std::uint64_t shortest_line = 8;  // such as (0,a,0) and its line end
  const auto bytes_left = static_cast<std::uint64_t>(end_ - next_);
  builder_.reserve_edges(std::min(transitions_.value, bytes_left / shortest_line));
  for (; errors_ < max_errors && next_line(); ++edges_read_) read_edge();
  if (errors_ > 0 || !check_counts()) return std::nullopt;
  builder_.add_states(static_cast<std::uint32_t>(states_.value));
  return std::move(builder_).finish(State{static_cast<std::uint32_t>(initial_.value)});
}

}  // namespace

std::optional<Lts> read_aut(std::string_view path, std::string_view text, base::SourceMap& sources,
                            base::Diagnostics& diagnostics, const AutOptions& options) {
  return AutReader(path, text, sources, diagnostics, options).read();
}

}  // namespace perentie::lts
