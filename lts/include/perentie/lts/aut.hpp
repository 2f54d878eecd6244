// Aldebaran files (.aut), the format that CADP and mCRL2 share: `des (initial, transitions,
// states)`, then one `(source, "label", target)` a line.
//
// τ is `tau` (mCRL2) or another word such as `i` (CADP); ✓ is `tick`. The format has no escapes of
// its own; we write `\"`, `\\`, `\n`, `\r`, `\t` and `\xHH` inside quotes where a label needs it,
// and an event whose name is one of the two words as `\xHH` and the rest, so whatever we write we
// read back. Format: manual page "aut" of CADP.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/source.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct AutOptions {
  /// The word for τ. Reading, the character τ itself is understood as well, and ✓ for `tick`.
  std::string tau = "tau";
};

/// Writes the transitions in order of source, label, target. Errors are those of the stream.
void write_aut(std::ostream& out, const Lts& lts, const AutOptions& options = {});

/// Reads a whole file, given its text. Labels may stand in quotes or not; blanks between tokens,
/// blank lines and CRLF are accepted; labels are numbered in order of appearance and duplicate
/// transitions merge. Nothing if the text is malformed: each error is reported with its place, the
/// line being added to `sources` under `path`, and after 20 errors reading stops.
std::optional<Lts> read_aut(std::string_view path, std::string_view text, base::SourceMap& sources,
                            base::Diagnostics& diagnostics, const AutOptions& options = {});

}  // namespace perentie::lts
