#include "perentie/base/source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>

#include "perentie/base/check.hpp"

namespace perentie::base {
namespace {

std::vector<Offset> find_line_starts(std::string_view text) {
  std::vector<Offset> starts{0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') starts.push_back(static_cast<Offset>(i + 1));
  }
  return starts;
}

bool is_utf8_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

std::optional<FileId> SourceMap::add(std::string path, std::string text) {
  return add_excerpt({path, 1, 1}, std::move(text));
}

std::optional<FileId> SourceMap::add_excerpt(Position first, std::string text) {
  // Each file owns one position past its end, so that "at the end of the file" is a place in it.
  Offset base = 0;
  if (!files_.empty()) {
    const File& last = files_[FileId{static_cast<std::uint32_t>(files_.size() - 1)}];
    base = last.base + static_cast<Offset>(last.text.size()) + 1;
  }
  if (text.size() >= std::numeric_limits<Offset>::max() - base) return std::nullopt;
  std::vector<Offset> line_starts = find_line_starts(text);
  return files_.add(File{std::string(first.path), std::move(text), base, std::move(line_starts),
                         first.line, first.column});
}

Span SourceMap::span(FileId file) const {
  const File& f = files_[file];
  return {f.base, f.base + static_cast<Offset>(f.text.size())};
}

FileId SourceMap::file_of(Offset offset) const {
  PERENTIE_CHECK(!files_.empty(), "a position without any source file");
  const auto after = std::upper_bound(files_.begin(), files_.end(), offset,
                                      [](Offset o, const File& f) { return o < f.base; });
  return FileId{static_cast<std::uint32_t>(after - files_.begin() - 1)};
}

std::size_t SourceMap::line_index(const File& file, Offset local) const {
  const auto after = std::upper_bound(file.line_starts.begin(), file.line_starts.end(), local);
  return static_cast<std::size_t>(after - file.line_starts.begin() - 1);
}

Position SourceMap::position(Offset offset) const {
  const File& file = files_[file_of(offset)];
  const Offset local = std::min(offset - file.base, static_cast<Offset>(file.text.size()));
  const std::size_t line = line_index(file, local);
  const Offset start = file.line_starts[line];
  std::uint32_t column = line == 0 ? file.first_column : 1;
  for (Offset i = start; i < local; ++i) {
    if (!is_utf8_continuation(file.text[i])) ++column;
  }
  return {file.path, static_cast<std::uint32_t>(file.first_line + line), column};
}

std::string_view SourceMap::text(Span span) const {
  const File& file = files_[file_of(span.begin)];
  return std::string_view(file.text).substr(span.begin - file.base, span.end - span.begin);
}

std::string_view SourceMap::line_at(Offset offset) const {
  const File& file = files_[file_of(offset)];
  const std::size_t line = line_index(file, offset - file.base);
  std::string_view rest = std::string_view(file.text).substr(file.line_starts[line]);
  rest = rest.substr(0, rest.find('\n'));
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  return rest;
}

FileText read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return {std::nullopt, "it is a directory"};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr) return {std::nullopt, std::strerror(errno)};
  std::string text;
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) {
    text.append(buffer, n);
  }
  if (std::ferror(file.get()) != 0) return {std::nullopt, std::strerror(errno)};
  return {std::move(text), {}};
}

AddedFile add_file(const std::string& path, SourceMap& sources) {
  FileText file = read_file(path);
  if (!file.text) return {std::nullopt, std::move(file.error)};
  const std::optional<FileId> id = sources.add(path, std::move(*file.text));
  return {id, id ? "" : "it is too large"};
}

}  // namespace perentie::base
