// What a file is, in words: snapshot, checkpoint, history, summary, or a run folder.
#pragma once

#include <string>

namespace scree::io {

// Throws IoError if it cannot be read or is none of these.
std::string info(const std::string& path);

}  // namespace scree::io
