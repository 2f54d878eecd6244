// How the words of assertions are written: models, properties, reductions, replicated operators.
// Lexer, printer and messages share these tables.
#pragma once

#include <optional>
#include <string_view>

#include "perentie/parser/ast.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

/// "FD" for failures-divergences, and so on (2.6.1).
std::string_view spelling(Model model);
/// "deadlock free", "divergence free", "deterministic" (2.6.2 - 2.6.4).
std::string_view spelling(Property property);
std::string_view spelling(PropertyWord word);
std::string_view spelling(PartialOrderMode mode);

std::optional<Model> model_of(std::string_view text);
std::optional<PropertyWord> property_word_of(std::string_view text);
std::optional<PartialOrderMode> reduction_of(std::string_view text);

}  // namespace perentie::parser
