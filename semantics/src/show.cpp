// Printing works through a stack of pieces still to print, since data and terms can be deep.
#include "perentie/semantics/show.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "evaluate/brief.hpp"
#include "layout.hpp"
#include "maps.hpp"
#include "perentie/parser/operators.hpp"

namespace perentie::semantics {
namespace {

constexpr std::size_t unlimited = std::string::npos / 4;

// A process that is put in parentheses if its operator binds no tighter than `level`.
struct Operand {
  ProcId process;
  std::uint8_t level;
};
using Piece = std::variant<std::string, Mark, ValueId, Operand, EventId, EventSetId>;
using Pieces = std::vector<Piece>;

class Printer {
 public:
  Printer(const ValueStore& values, const Resolution& resolution, const ShowContext* context,
          std::size_t max_length)
      : values_(values), resolution_(resolution), context_(context), max_length_(max_length) {}

  /// The pieces on one line.
  std::string print(Pieces pieces) {
    then(std::move(pieces));
    while (!stack_.empty()) {
      if (text_.size() > max_length_) {
        text_.resize(max_length_);
        return text_ + "...";
      }
      const Piece piece = std::move(stack_.back());
      stack_.pop_back();
      if (const auto* text = std::get_if<std::string>(&piece)) text_ += *text;
      if (const auto* mark = std::get_if<Mark>(&piece)) print_mark(*mark);
      if (const auto* value = std::get_if<ValueId>(&piece)) print_value(*value);
      if (const auto* operand = std::get_if<Operand>(&piece)) print_process(*operand);
      if (const auto* event = std::get_if<EventId>(&piece)) print_event(*event);
      if (const auto* set = std::get_if<EventSetId>(&piece)) print_event_set(*set);
    }
    return text_;
  }

  /// The pieces broken into lines.
  std::string lay_out(Pieces pieces) {
    Layout layout;
    layout_ = &layout;
    print(std::move(pieces));
    flush_to_layout();
    layout_ = nullptr;
    return layout.finish();
  }

 private:
  void print_mark(Mark mark) {
    if (layout_ != nullptr) {
      flush_to_layout();
      layout_->mark(mark);
    } else if (mark == Mark::space || mark == Mark::hang) {
      text_ += ' ';
    }
  }

  void flush_to_layout() {
    layout_->text(text_);
    text_.clear();
  }

  void then(Pieces pieces) {
    for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
      stack_.push_back(std::move(*piece));
    }
  }

  // A group of items, each of which but the first follows `separator`.
  template <class Items>
  void then_group(Mark kind, std::string open, const Items& items, const Pieces& separator,
                  std::string close) {
    Pieces pieces{std::move(open), kind};
    for (const auto& item : items) {
      if (pieces.size() > 2) pieces.insert(pieces.end(), separator.begin(), separator.end());
      pieces.emplace_back(item);
      if (2 * pieces.size() > max_length_) break;  // the rest would be cut anyway
    }
    pieces.emplace_back(Mark::close);
    pieces.emplace_back(std::move(close));
    then(std::move(pieces));
  }

  template <class Items>
  void then_list(std::string open, const Items& items, std::string close) {
    then_group(Mark::open_fill, std::move(open), items, {",", Mark::space}, std::move(close));
  }

  // --- Values -----------------------------------------------------------------------------------

  void print_value(ValueId value) {
    switch (values_.kind(value)) {
      case ValueKind::integer:
        text_ += std::to_string(values_.as_int(value));
        break;
      case ValueKind::boolean:
        text_ += values_.as_bool(value) ? "true" : "false";
        break;
      case ValueKind::character:
        text_ += fmt::format("'{}'", static_cast<char>(values_.as_char(value)));
        break;
      case ValueKind::atom:
        text_ += resolution_.symbols[values_.as_symbol(value)].qualified;
        break;
      case ValueKind::dot:
        then_group(Mark::open_fill, "", values_.items(value), {".", Mark::cut}, "");
        break;
      case ValueKind::tuple:
        then_list("(", values_.items(value), ")");
        break;
      case ValueKind::empty_seq:
        text_ += "<>";
        break;
      case ValueKind::cons:
        print_sequence(value);
        break;
      case ValueKind::set:
        then_list("{", values_.items(value), "}");
        break;
      case ValueKind::int_set:
        text_ += "Integers";
        break;
      case ValueKind::proc_set:
        text_ += "Proc";
        break;
      case ValueKind::from_set:
        then({"{", inner(value), "...}"});
        break;
      case ValueKind::seq_set:
        then({"Seq(", inner(value), ")"});
        break;
      case ValueKind::tuple_set:
        then_list("(", values_.items(value), ")");
        break;
      case ValueKind::dot_set:
        then_group(Mark::open_fill, "", values_.items(value), {".", Mark::cut}, "");
        break;
      case ValueKind::power_set:
        then({"Set(", inner(value), ")"});
        break;
      case ValueKind::map_set:
        then_list("Map(", values_.items(value), ")");
        break;
      case ValueKind::data_set:
        text_ += resolution_.symbols[values_.as_symbol(value)].qualified;
        break;
      case ValueKind::map:
        print_map(value);
        break;
      case ValueKind::process:
        if (context_ == nullptr) {
          text_ += "a process";
        } else {
          then({Operand{values_.as_process(value), 0xFF}});
        }
        break;
      case ValueKind::function:
        text_ += context_ == nullptr ? "a function" : context_->names.function_name(value);
        break;
      case ValueKind::builtin:
        text_ += info(values_.as_builtin(value)).name;
        break;
      case ValueKind::ignored:
        text_ += "_";
        break;
    }
  }

  ValueId inner(ValueId value) const { return {values_.word(value, 0)}; }

  void print_sequence(ValueId value) {
    if (const std::optional<std::string> text = values_.as_string(value)) {
      text_ += '"' + *text + '"';
      return;
    }
    std::vector<ValueId> items;
    for (; values_.kind(value) == ValueKind::cons && items.size() <= max_length_;
         value = values_.tail(value)) {
      items.push_back(values_.head(value));
    }
    then_list("<", items, ">");
  }

  void print_map(ValueId value) {
    Pieces pieces{std::string("(|")};
    for (const auto& [key, result] : map_entries(values_, value)) {
      pieces.emplace_back(std::string(pieces.size() == 1 ? " " : ", "));
      pieces.emplace_back(key);
      pieces.emplace_back(std::string(" => "));
      pieces.emplace_back(result);
    }
    pieces.emplace_back(std::string(" |)"));
    then(std::move(pieces));
  }

  // --- Processes --------------------------------------------------------------------------------

  const ProcStore& processes() const { return context_->processes; }

  void print_event(EventId event) {
    if (event == lts::tau || event == lts::tick) {
      text_ += event == lts::tau ? lts::tau_name : lts::tick_name;
    } else {
      print_value(context_->events.value(event));
    }
  }

  static std::uint8_t level_of(ProcKind kind) {
    using parser::InfixOp;
    using parser::info;
    switch (kind) {
      case ProcKind::prefix:
      case ProcKind::event_set_prefix:
        return info(InfixOp::prefix).level;
      case ProcKind::sequential:
        return info(InfixOp::sequential).level;
      case ProcKind::sliding_choice:
        return info(InfixOp::sliding_choice).level;
      case ProcKind::interrupt:
      case ProcKind::sync_interrupt:
        return info(InfixOp::interrupt).level;
      case ProcKind::external_choice:
      case ProcKind::sync_choice:
        return info(InfixOp::external_choice).level;
      case ProcKind::internal_choice:
        return info(InfixOp::internal_choice).level;
      case ProcKind::parallel:
      case ProcKind::alphabet_parallel:
      case ProcKind::exception:
      case ProcKind::link_parallel:
        return info(InfixOp::parallel).level;
      case ProcKind::interleave:
        return info(InfixOp::interleave).level;
      default:
        return 0;  // atoms, calls, and what is always printed in parentheses
    }
  }

  void print_process(const Operand& operand) {
    const ProcKind kind = processes().kind(operand.process);
    const std::uint8_t level = level_of(kind);
    const bool parentheses = level >= operand.level;
    if (parentheses) {
      text_ += "(";
      stack_.emplace_back(std::string(")"));
    }
    print_term(operand.process, kind, level);
  }

  void print_term(ProcId term, ProcKind kind, std::uint8_t level) {
    const auto words = processes().words(term);
    const auto process = [&](std::size_t i) { return Operand{ProcId{words[i]}, level}; };
    const auto set = [&](std::size_t i) { return EventSetId{words[i]}; };
    switch (kind) {
      case ProcKind::stop:
        then({"STOP"});
        break;
      case ProcKind::skip:
        then({"SKIP"});
        break;
      case ProcKind::div:
        then({"DIV"});
        break;
      case ProcKind::prefix:
        then({EventId{words[0]}, " -> ", looser(words[1], level)});
        break;
      case ProcKind::event_set_prefix:
        then({set(0), " -> ", looser(words[1], level)});
        break;
      case ProcKind::external_choice:
        n_ary(words, {"[] "}, level);
        break;
      case ProcKind::internal_choice:
        n_ary(words, {"|~| "}, level);
        break;
      case ProcKind::interleave:
        n_ary(words, {"||| "}, level);
        break;
      case ProcKind::sequential:
        binary(process(0), {"; "}, process(1));
        break;
      case ProcKind::interrupt:
        binary(process(0), {"/\\ "}, process(1));
        break;
      case ProcKind::sliding_choice:
        binary(process(0), {"[> "}, process(1));
        break;
      case ProcKind::parallel:
        n_ary(words.subspan(1), {"[| ", set(0), " |] "}, level);
        break;
      case ProcKind::sync_choice:
        n_ary(words.subspan(1), {"[+", set(0), "+] "}, level);
        break;
      case ProcKind::exception:
        binary(process(1), {"[| ", set(0), " |> "}, process(2));
        break;
      case ProcKind::sync_interrupt:
        binary(process(1), {"/+ ", set(0), " +\\ "}, process(2));
        break;
      case ProcKind::link_parallel:
        binary(process(1), {"[" + relation(EventRelationId{words[0]}, " <-> ") + "] "}, process(2));
        break;
      case ProcKind::alphabet_parallel:
        print_alphabet_parallel(words, level);
        break;
      case ProcKind::hide:
        then({"(", atom(words[1]), " \\ ", set(0), ")"});
        break;
      case ProcKind::project:
        then({"(", atom(words[1]), " |\\ ", set(0), ")"});
        break;
      case ProcKind::rename:
        then({atom(words[1]), "[[" + relation(EventRelationId{words[0]}, " <- ") + "]]"});
        break;
      case ProcKind::chaos:
        then({"CHAOS(", set(0), ")"});
        break;
      case ProcKind::run:
        then({"RUN(", set(0), ")"});
        break;
      case ProcKind::prioritise: {
        Pieces pieces{"prioritise(", whole(words[0]), ", <"};
        for (std::size_t i = 1; i < words.size(); ++i) {
          if (i > 1) pieces.emplace_back(", ");
          pieces.emplace_back(set(i));
        }
        pieces.emplace_back(">)");
        then(std::move(pieces));
        break;
      }
      case ProcKind::prioritise_partial:
        then({"prioritisepo(", whole(words[2]), ", ", set(0),
              ", " + relation(EventRelationId{words[1]}, " < ") + ")"});
        break;
      case ProcKind::compression:
        then({std::string(info(static_cast<Builtin>(words[0])).name) + "(", whole(words[1]), ")"});
        break;
      case ProcKind::graph_operator: {
        Pieces pieces{std::string(info(static_cast<Builtin>(words[0])).name) + "(",
                      whole(words[1])};
        if (words.size() > 2) {
          const Piece more[] = {", ", set(2), ", ", EventId{words[3]}};
          pieces.insert(pieces.end(), std::begin(more), std::end(more));
        }
        pieces.emplace_back(")");
        then(std::move(pieces));
        break;
      }
      case ProcKind::compressed_state:
        then({whole(words[0]), fmt::format("#{}", words[2])});
        break;
      case ProcKind::chase:
        then({"chase(", whole(words[0]), ")"});
        break;
      case ProcKind::opaque:
        print_opaque(words);
        break;
      case ProcKind::call:
        print_call(words);
        break;
    }
  }

  static Operand whole(std::uint32_t word) { return {ProcId{word}, 0xFF}; }
  static Operand atom(std::uint32_t word) { return {ProcId{word}, 1}; }
  // The body of a prefix: another prefix needs no parentheses.
  static Operand looser(std::uint32_t word, std::uint8_t level) {
    return {ProcId{word}, static_cast<std::uint8_t>(level + 1)};
  }

  // Operands with an operator, which begins a line where a line must end.
  void n_ary(std::span<const std::uint32_t> words, Pieces op, std::uint8_t level) {
    std::vector<Operand> operands;
    for (const std::uint32_t word : words) operands.push_back({ProcId{word}, level});
    op.insert(op.begin(), Mark::space);
    then_group(Mark::open, "", operands, op, "");
  }

  void binary(Operand left, Pieces op, Operand right) {
    op.insert(op.begin(), Mark::space);
    then_group(Mark::open, "", std::vector<Operand>{left, right}, op, "");
  }

  // In the order of values: that of first use depends on what was evaluated before.
  void print_event_set(EventSetId set) {
    const auto members = context_->events.events(set);
    std::vector<EventId> events(members.begin(), members.end());
    std::sort(events.begin(), events.end(), [&](EventId a, EventId b) {
      return values_.compare(context_->events.value(a), context_->events.value(b)) < 0;
    });
    then_list("{", events, "}");
  }

  std::string relation(EventRelationId id, const std::string& arrow) const {
    Printer printer(values_, resolution_, context_, max_length_);
    Pieces pieces;
    for (const EventPair& pair : context_->events.pairs(id)) {
      if (!pieces.empty()) pieces.emplace_back(std::string(", "));
      pieces.emplace_back(pair.from);
      pieces.emplace_back(arrow);
      pieces.emplace_back(pair.to);
    }
    return printer.print(std::move(pieces));
  }

  void print_alphabet_parallel(std::span<const std::uint32_t> words, std::uint8_t level) {
    const auto set = [&](std::size_t i) { return EventSetId{words[i]}; };
    if (words.size() == 2) {
      then({Operand{ProcId{words[1]}, level}, " [", set(0), " || {}] SKIP"});
    } else if (words.size() == 4) {
      binary({ProcId{words[1]}, level}, {"[", set(0), " || ", set(2), "] "},
             {ProcId{words[3]}, level});
    } else {
      Pieces pieces{std::string("|| (a, p) : {")};
      for (std::size_t i = 0; i < words.size(); i += 2) {
        pieces.emplace_back(std::string(i > 0 ? ", (" : "("));
        pieces.emplace_back(set(i));
        pieces.emplace_back(std::string(", "));
        pieces.emplace_back(whole(words[i + 1]));
        pieces.emplace_back(std::string(")"));
      }
      pieces.emplace_back(std::string("} @ [a] p"));
      then(std::move(pieces));
    }
  }

  void print_opaque(std::span<const std::uint32_t> words) {
    then_list(std::string(info(static_cast<Builtin>(words[0])).name) + "(",
              values_of(words.subspan(1)), ")");
  }

  void print_call(std::span<const std::uint32_t> words) {
    text_ += context_->names.function_name(ValueId{words[0]});
    if (words.size() > 1) {
      then_list("(", values_of(words.subspan(1)), ")");
    } else if (context_->names.takes_arguments(ValueId{words[0]})) {
      text_ += "()";
    }
  }

  static std::vector<ValueId> values_of(std::span<const std::uint32_t> words) {
    std::vector<ValueId> values;
    for (const std::uint32_t word : words) values.push_back(ValueId{word});
    return values;
  }

  const ValueStore& values_;
  const Resolution& resolution_;
  const ShowContext* context_;
  std::size_t max_length_;
  Pieces stack_;
  std::string text_;
  Layout* layout_ = nullptr;  // where lines are broken
};

}  // namespace

std::string show_value(const ShowContext& context, ValueId value) {
  return Printer(context.values, context.resolution, &context, unlimited).print({value});
}

std::string show_process(const ShowContext& context, ProcId process, std::size_t max_length) {
  return Printer(context.values, context.resolution, &context, max_length)
      .print({Operand{process, 0xFF}});
}

std::string lay_out_process(const ShowContext& context, ProcId process) {
  return Printer(context.values, context.resolution, &context, unlimited)
      .lay_out({Operand{process, 0xFF}});
}

std::string lay_out_definition(const ShowContext& context, ProcId name, ProcId body) {
  return Printer(context.values, context.resolution, &context, unlimited)
      .lay_out(
          {Mark::open, Operand{name, 0xFF}, " =", Mark::hang, Operand{body, 0xFF}, Mark::close});
}

std::string brief(const ValueStore& values, const Resolution& resolution, ValueId value) {
  return Printer(values, resolution, nullptr, 120).print({value});
}

}  // namespace perentie::semantics
