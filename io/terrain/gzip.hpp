// Bytes packed as gzip (RFC 1952) and back, by zlib.
#pragma once

#include <string>
#include <string_view>

namespace scree::io {

bool is_gzip(std::string_view bytes);  // begins as such a file does
std::string gunzip(std::string_view packed,
                   const std::string& path);  // IoError `path: ...` if it is damaged or cut off
std::string gzip(std::string_view bytes);     // the same bytes give the same file

}  // namespace scree::io
