#include "includes.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lexer_state.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

// More is a mistake, or an attack.
constexpr std::size_t max_nesting = 200;
constexpr std::size_t max_files = 10'000;

struct OpenFile {
  std::string path;      // normalised, to recognise cycles
  base::Span directive;  // where it was included
  Lexer lexer;
};

struct Found {
  std::string path;
  base::FileText text;
};

std::string normalised(const std::filesystem::path& path) {
  return path.lexically_normal().generic_string();
}

// Relative to the folder of the script, then to the including file. The error is that of the
// latter.
Found find_file(std::string_view name, std::string_view including, std::string_view root,
                const Load& load) {
  const auto beside = [&](std::string_view file) {
    return normalised(std::filesystem::path(file).parent_path() / std::filesystem::path(name));
  };
  const std::string first = beside(root);
  const std::string second = beside(including);
  base::FileText text = load(first);
  if (text.text || second == first) return {first, std::move(text)};
  return {second, load(second)};
}

class Expander {
 public:
  Expander(base::SourceMap& sources, base::Interner& names, base::Diagnostics& diagnostics,
           const Load& load)
      : sources_(sources), names_(names), diagnostics_(diagnostics), load_(load) {}

  TokenStream expand(base::FileId root) {
    root_ = std::string(sources_.path(root));
    open(root, normalised(root_), {});
    while (!files_.empty()) {
      if (files_.back().lexer.run() == Lexer::Stop::after_include) {
        include();
      } else {
        close();
      }
    }
    const base::Offset end = sources_.span(root).end;
    stream_.tokens.push_back({TokenKind::end_of_file, 0, {end, end}});
    return std::move(stream_);
  }

 private:
  void open(base::FileId file, std::string path, base::Span directive) {
    files_.push_back({std::move(path), directive,
                      Lexer(sources_.span(file), sources_, names_, diagnostics_, stream_)});
    ++count_;
  }

  void close() {
    boundary();
    files_.pop_back();
  }

  // The last token is an include: put the tokens of its file there instead.
  void include() {
    const Token directive = stream_.tokens.back();
    stream_.tokens.pop_back();
    boundary();
    const std::string_view name = names_[directive.name()];
    Found found = find_file(name, files_.back().path, root_, load_);
    if (!may_open(found.path, directive.span)) return;
    if (!found.text.text) {
      diagnostics_.report(codes::include_failed, directive.span,
                          fmt::format("cannot read `{}`: {}", name, found.text.error));
      return;
    }
    const std::optional<base::FileId> file = sources_.add(found.path, std::move(*found.text.text));
    if (!file) {
      diagnostics_.report(codes::include_failed, directive.span,
                          fmt::format("cannot read `{}`: the script exceeds 4 GiB", name));
      return;
    }
    open(*file, std::move(found.path), directive.span);
  }

  bool may_open(const std::string& path, base::Span directive) {
    const auto same = std::find_if(files_.begin(), files_.end(),
                                   [&](const OpenFile& file) { return file.path == path; });
    if (same != files_.end()) {
      base::Diagnostic& diagnostic = diagnostics_.report(codes::include_cycle, directive,
                                                         fmt::format("`{}` includes itself", path));
      for (auto between = same + 1; between != files_.end(); ++between) {
        diagnostic.notes.push_back({between->directive, "through this include"});
      }
      return false;
    }
    if (files_.size() < max_nesting && count_ < max_files) return true;
    diagnostics_.report(
        codes::include_cycle, directive,
        fmt::format("a script may nest {} includes and read {} files", max_nesting, max_files));
    return false;
  }

  // Where a file begins or ends, a newline token that nothing soaks up.
  void boundary() {
    if (stream_.tokens.empty() || stream_.tokens.back().kind == TokenKind::newline) return;
    const base::Offset end = stream_.tokens.back().span.end;
    stream_.tokens.push_back({TokenKind::newline, 0, {end, end}});
  }

  base::SourceMap& sources_;
  base::Interner& names_;
  base::Diagnostics& diagnostics_;
  const Load& load_;
  TokenStream stream_;
  std::vector<OpenFile> files_;
  std::string root_;
  std::size_t count_ = 0;
};

}  // namespace

TokenStream lex_with_includes(base::FileId root, base::SourceMap& sources, base::Interner& names,
                              base::Diagnostics& diagnostics, const Load& load) {
  return Expander(sources, names, diagnostics, load).expand(root);
}

}  // namespace perentie::parser
