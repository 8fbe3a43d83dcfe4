// Characters of UTF-8 text.
#pragma once

#include <cstddef>
#include <string_view>

namespace scree::io {

// Bytes of the valid character at `i`, 0 if there is none (Unicode, table 3-7: no overlong forms, no surrogates).
std::size_t utf8_length(std::string_view text, std::size_t i);
// Is this byte the first of a character?
inline bool begins_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

}  // namespace scree::io
