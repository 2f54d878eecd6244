#include "code.hpp"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "brief.hpp"

namespace perentie::semantics {
namespace {

struct OpInfo {
  std::string_view name;
  std::string_view operands;
};

constexpr auto op_table = std::to_array<OpInfo>({
#define PERENTIE_INSTRUCTION(id, operands) {#id, operands},
#include "instructions.def"
#undef PERENTIE_INSTRUCTION
});

}  // namespace

std::string list_code(const Program& program, const Resolution& resolution,
                      const ValueStore& values) {
  std::unordered_map<Address, std::string> entries;
  for (const FunctionInfo& function : program.functions) {
    entries[function.entry] =
        function.symbol ? resolution.symbols[function.symbol].qualified : "lambda";
  }
  for (const auto& [symbol, entry] : program.field_types) {
    entries[entry] = "fields of " + resolution.symbols[SymbolId{symbol}].qualified;
  }
  std::string text;
  for (Address at = program.prelude_end; at < program.code.size(); ++at) {
    const Instruction in = program.code[at];
    if (const auto entry = entries.find(at); entry != entries.end()) {
      text += entry->second + ":\n";
    }
    const OpInfo& op = op_table[static_cast<std::size_t>(in.op)];
    text += fmt::format("{:6} {}", at - program.prelude_end, op.name);
    if (in.op == Op::push_value) {
      text += ' ' + brief(values, resolution, ValueId{in.b});
    } else if (!op.operands.empty()) {
      const bool is_address = op.operands.find("target") != std::string_view::npos ||
                              op.operands.find("code") != std::string_view::npos;
      if (op.operands.find(' ') != std::string_view::npos) text += fmt::format(" {}", +in.a);
      text += fmt::format(" {}", is_address ? in.b - program.prelude_end : in.b);
    }
    text += '\n';
  }
  return text;
}

}  // namespace perentie::semantics
