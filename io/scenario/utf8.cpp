#include "io/scenario/utf8.hpp"

namespace scree::io {

std::size_t utf8_length(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[k])) : 0U;
    };
    const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
    const unsigned lead = byte(i), second = byte(i + 1);
    if (lead < 0x80U) return 1;
    if (lead >= 0xC2U && lead <= 0xDFU) return follows(i + 1) ? 2 : 0;
    if (lead >= 0xE0U && lead <= 0xEFU) {
        const bool in_range = !(lead == 0xE0U && second < 0xA0U) && !(lead == 0xEDU && second > 0x9FU);
        return in_range && follows(i + 1) && follows(i + 2) ? 3 : 0;
    }
    if (lead >= 0xF0U && lead <= 0xF4U) {
        const bool in_range = !(lead == 0xF0U && second < 0x90U) && !(lead == 0xF4U && second > 0x8FU);
        return in_range && follows(i + 1) && follows(i + 2) && follows(i + 3) ? 4 : 0;
    }
    return 0;
}

}  // namespace scree::io
