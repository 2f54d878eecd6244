// The declaration loop. Modules and timed sections are opened and closed here, so that an error
// inside costs one declaration and not the block; everything else is one call into the grammar.
#pragma once

#include <cstdint>
#include <vector>

#include "builder/builder.hpp"

namespace perentie::parser {

class ScriptParser {
 public:
  explicit ScriptParser(Builder& builder);

  /// The declarations of the whole stream.
  DeclList parse();

 private:
  /// An open module or timed section.
  struct Block {
    enum class Kind : std::uint8_t { hidden_part, exported_part, timed };
    Kind kind;
    const Token* keyword;
    Place outer_place;
    DeclarationBuilder::Mark mark;
    Identifier name;         // modules
    PatternList parameters;  // modules
    DeclList hidden;         // modules, once `exports` is passed
    ExprId duration;         // timed sections
    bool broken;             // its head could not be read: it counts for nesting only
  };

  void parse_item();
  void read_item();
  void read_print();
  void require_end() const;
  const Token* after_broken_head(const Token* failure) const;
  bool in_timed_section() const;

  Block& push_block(Block::Kind kind);
  void pop_block();
  void open_module();
  void export_module();
  void close_module();
  void open_timed();
  void close_timed();
  void report_open_blocks();
  Span span_of(const Token* first, const Token* last) const;
  bool same_file(const Token* first, const Token* last) const;

  Builder& builder_;
  BuildContext& context_;
  const Token* at_;
  const Token* end_;
  std::vector<Block> blocks_;
  Place place_ = Place::script;
};

}  // namespace perentie::parser
