// Exact sums over the bodies that a rank owns, for every step: vector arithmetic on blocks of terms in place of the
// superaccumulator's 5 ns a term.
//
// A block's terms are split by rounding against a large number (Dekker 1971; Rump, Ogita and Oishi 2008): with
// |x| < 2^e and M = 1.5 * 2^(e+1), the low bits of x + M are the integer k nearest to x / 2^(e-51), and
// x - k 2^(e-51) is exact. The integers of a block add up in 64 bits without overflow; the remainders are split again,
// until none is left, and each integer sum goes into an ExactSum. Nothing is rounded, so blocks and order do not count.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/bodies.hpp"
#include "core/exact_sum.hpp"

namespace scree {

struct TermBlock {
    static constexpr std::size_t kSize = 512;
    alignas(64) std::array<double, kSize> term;
};

// Adds the first `count` terms, any doubles; one that is not finite makes the sum nan. The block is used up.
void add_terms(TermBlock& block, std::size_t count, ExactSum& sum);

// terms(i) gives the terms of body i, a std::array of K, one for each sum.
template <std::size_t K, class Terms>
void add_over_bodies(const Bodies& bodies, std::span<ExactSum, K> sums, const Terms& terms) {
    std::array<TermBlock, K> block;
    std::size_t count = 0;
    const auto flush = [&] {
        for (std::size_t k = 0; k < K; ++k) add_terms(block[k], count, sums[k]);
        count = 0;
    };
    for (std::size_t first = 0; first < bodies.size(); first += TermBlock::kSize) {
        const std::size_t last = std::min(bodies.size(), first + TermBlock::kSize);
        for (std::size_t i = first; i < last; ++i) {
            const std::array<double, K> term = terms(i);
            for (std::size_t k = 0; k < K; ++k) block[k].term[count] = term[k];
            count += bodies.is_ghost(i) ? 0 : 1;
        }
        flush();
    }
}

}  // namespace scree
