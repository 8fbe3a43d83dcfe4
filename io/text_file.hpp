// A text file from disk, refused with a clear message if it is no text.
#pragma once

#include <optional>
#include <string>

#include "io/scenario/diagnostics.hpp"

namespace scree::io {

// The text, without a byte order mark, known to `diagnostics` under the name `path`. `named_at`: the place that named
// the file (line 0: the command line); faults of opening go there.
std::optional<std::string> read_text_file(const std::string& path, const Mark& named_at, Diagnostics& diagnostics);

// Valid UTF-8, no control characters, no tabs in the indentation. Faults go to `diagnostics` under the name `file`.
bool check_text(const std::string& text, const std::string& file, Diagnostics& diagnostics);

}  // namespace scree::io
