// Source texts and positions in them.
//
// All texts of a run lie end to end in one 32-bit address space, so a place is one `Offset` and a
// stretch is one `Span`, whichever file it is in. Lines and columns, both from 1, are computed only
// when something is printed; a tab is one column, and so is a multi-byte UTF-8 character
// (CSPM reference 1.1.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/id.hpp"

namespace perentie::base {

using FileId = Id<struct FileTag>;
using Offset = std::uint32_t;

/// The half-open stretch [begin, end); never crosses a file boundary.
struct Span {
  Offset begin = 0;
  Offset end = 0;

  friend constexpr bool operator==(Span, Span) = default;
};

/// The smallest span that covers both.
constexpr Span cover(Span a, Span b) {
  return {a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

struct Position {
  std::string_view path;
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

class SourceMap {
 public:
  /// Adds a text under the path that messages name. Nothing if 4 GiB of source would be exceeded.
  std::optional<FileId> add(std::string path, std::string text);
  /// Adds a part of a text that is too large to keep whole, such as one line of a trace. `first`
  /// says where in the file the part begins: positions in it are reported as positions in the file.
  std::optional<FileId> add_excerpt(Position first, std::string text);

  std::string_view path(FileId file) const { return files_[file].path; }
  std::string_view text(FileId file) const { return files_[file].text; }
  /// The whole file as a span.
  Span span(FileId file) const;
  std::size_t file_count() const { return files_.size(); }

  FileId file_of(Offset offset) const;
  Position position(Offset offset) const;
  /// The text of a span.
  std::string_view text(Span span) const;
  /// The line that holds `offset`, without its line end.
  std::string_view line_at(Offset offset) const;

 private:
  struct File {
    std::string path;
    std::string text;
    Offset base;
    std::vector<Offset> line_starts;  // relative to base
    std::uint32_t first_line = 1;
    std::uint32_t first_column = 1;
  };

  std::size_t line_index(const File& file, Offset local) const;

  Store<FileId, File> files_;
};

/// The bytes of a file, or why they could not be read (the system's reason, one line).
struct FileText {
  std::optional<std::string> text;
  std::string error;
};
FileText read_file(const std::string& path);

/// Reads a file into the sources; without `file`, `error` says why it could not be done.
struct AddedFile {
  std::optional<FileId> file;
  std::string error;
};
AddedFile add_file(const std::string& path, SourceMap& sources);

}  // namespace perentie::base
