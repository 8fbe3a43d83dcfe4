#include "core/parallel/body_sums.hpp"

#include <bit>
#include <cstdint>

namespace scree {
namespace {

constexpr std::int64_t kMagnitude = 0x7fffffffffffffff, kInfinity = 0x7ff0000000000000;
constexpr int kDigitBits = 51;           // of a term go into an integer at once
constexpr int kLeastExponent = -1074;    // of a double's lowest bit
constexpr std::int64_t kLargest = 2000;  // biased exponent up to which 1.5 * 2^(e+1) and a block's sum are doubles

// 1.5 * 2^(52 + unit): to add it rounds to a multiple of 2^unit, and the sum's low bits are the multiple.
double rounder(int unit) {
    return std::bit_cast<double>((static_cast<std::int64_t>(52 + unit + 1023) << 52) | (std::int64_t{1} << 51));
}

// Splits off the multiples of two units and adds them up; gives the bits of the largest remainder.
std::int64_t split(double* x, std::size_t n, double coarse, double fine, std::uint64_t& high, std::uint64_t& low) {
    std::int64_t largest = 0;
    std::uint64_t high_sum = 0, low_sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double a = x[i] + coarse;
        high_sum += std::bit_cast<std::uint64_t>(a);
        const double rest = x[i] - (a - coarse);
        const double b = rest + fine;
        low_sum += std::bit_cast<std::uint64_t>(b);
        x[i] = rest - (b - fine);
        largest = std::max(largest, std::bit_cast<std::int64_t>(x[i]) & kMagnitude);
    }
    high = high_sum - n * std::bit_cast<std::uint64_t>(coarse);
    low = low_sum - n * std::bit_cast<std::uint64_t>(fine);
    return largest;
}

}  // namespace

void add_terms(TermBlock& block, std::size_t count, ExactSum& sum) {
    double* x = block.term.data();
    const std::size_t n = (count + 7) / 8 * 8;  // whole vectors
    for (std::size_t i = count; i < n; ++i) x[i] = 0.0;
    std::int64_t largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::bit_cast<std::int64_t>(x[i]) & kMagnitude);
    if (largest >= kInfinity) return sum.add_not_finite();
    if (largest >> 52 > kLargest) {
        for (std::size_t i = 0; i < n; ++i) sum.add(x[i]);
        return;
    }
    while (largest != 0) {
        const int bound = static_cast<int>(std::max<std::int64_t>(largest >> 52, 1)) - 1022;  // |x| < 2^bound
        const int coarse = std::max(bound - kDigitBits, kLeastExponent);
        const int fine = std::max(coarse - kDigitBits, kLeastExponent);
        std::uint64_t high = 0, low = 0;
        largest = split(x, n, rounder(coarse), rounder(fine), high, low);
        sum.add(static_cast<std::int64_t>(high), coarse);
        sum.add(static_cast<std::int64_t>(low), fine);
    }
}

}  // namespace scree
