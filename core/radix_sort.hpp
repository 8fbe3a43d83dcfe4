// Stable sort by a 64-bit key, in as many passes as the keys that occur need.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace scree {

// `key(item)` gives the key; `scratch` keeps its memory between calls.
template <class Item, class Key>
void radix_sort(std::vector<Item>& items, std::vector<Item>& scratch, Key key) {
    constexpr int kDigit = 11;
    constexpr std::uint64_t kMask = (1U << kDigit) - 1;
    if (items.empty()) return;
    std::uint64_t varies = 0;
    for (const Item& item : items) varies |= key(item) ^ key(items.front());
    scratch.resize(items.size());
    std::array<std::uint32_t, kMask + 2> count;
    for (int shift = 0; shift < 64; shift += kDigit) {
        if (((varies >> shift) & kMask) == 0) continue;
        count.fill(0);
        for (const Item& item : items) ++count[((key(item) >> shift) & kMask) + 1];
        for (std::size_t k = 0; k < kMask; ++k) count[k + 1] += count[k];
        for (const Item& item : items) scratch[count[(key(item) >> shift) & kMask]++] = item;
        items.swap(scratch);
    }
}

}  // namespace scree
