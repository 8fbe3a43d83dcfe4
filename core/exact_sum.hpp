// A sum of doubles that does not depend on the order of the terms: each is added as an integer into 32-bit digits over
// the whole range of a double (a small superaccumulator; Neal 2015). Reductions that feed a decision use it, so that no
// order of work and no number of ranks can change a bit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace scree {

class ExactSum {
  public:
    // With a term that is not finite the sum is not a number.
    void add(double x) {
        const auto bits = std::bit_cast<std::uint64_t>(x);
        const auto exponent = static_cast<int>((bits >> 52) & 0x7ff);
        if (exponent == 0x7ff) {
            ++digits_[kDigits];
            return;
        }
        std::uint64_t mantissa = bits & 0xfffffffffffffULL;
        if (exponent != 0) mantissa |= std::uint64_t{1} << 52;
        const int position = exponent == 0 ? 0 : exponent - 1;  // of the lowest bit, above 2^-1074
        const auto digit = static_cast<std::size_t>(position / 32);
        const unsigned __int128 wide = static_cast<unsigned __int128>(mantissa) << (position % 32);
        const std::int64_t sign = (bits >> 63) != 0 ? -1 : 1;
        digits_[digit] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(wide));
        digits_[digit + 1] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(wide >> 32));
        digits_[digit + 2] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(wide >> 64));
    }
    void add_any(double x) {
        if (std::isfinite(x))
            add(x);
        else
            add_not_finite();
    }
    // whole * 2^exponent, exponent in [-1074, 1000].
    void add(std::int64_t whole, int exponent) {
        const int position = exponent + 1074;
        const auto digit = static_cast<std::size_t>(position / 32);
        const __int128 wide = static_cast<__int128>(whole) << (position % 32);
        digits_[digit] += static_cast<std::int64_t>(static_cast<std::uint32_t>(wide));
        digits_[digit + 1] += static_cast<std::int64_t>(static_cast<std::uint32_t>(wide >> 32));
        digits_[digit + 2] += static_cast<std::int64_t>(wide >> 64);  // with the sign
    }
    // A term that is infinite or not a number: the sum is not a number.
    void add_not_finite() { digits_[kDigits] += 1; }
    void add(const ExactSum& other) {
        for (std::size_t i = 0; i < digits_.size(); ++i) digits_[i] += other.digits_[i];
    }
    // The sum as a double: carried into its one canonical form first, so equal sums give equal bits.
    double value() const {
        if (digits_[kDigits] != 0) return std::numeric_limits<double>::quiet_NaN();
        std::array<std::int64_t, kDigits + 1> d = digits_;
        const auto carry_up = [&d] {
            for (std::size_t i = 0; i + 1 < kDigits; ++i) {
                const std::int64_t carry = d[i] >> 32;  // floor: digits below the top end in [0, 2^32)
                d[i] -= carry * (std::int64_t{1} << 32);
                d[i + 1] += carry;
            }
        };
        carry_up();
        const bool negative = d[kDigits - 1] < 0;
        if (negative) {
            for (std::int64_t& digit : d) digit = -digit;
            carry_up();
        }
        double sum = 0.0;
        for (std::size_t i = kDigits; i-- > 0;) {
            if (d[i] != 0) sum += std::ldexp(static_cast<double>(d[i]), static_cast<int>(i) * 32 - 1074);
        }
        return negative ? -sum : sum;
    }

    // What ranks add up, digit by digit.
    std::span<std::int64_t> digits() { return digits_; }

  private:
    static constexpr std::size_t kDigits = 68;        // 2098 bits and room for carries
    std::array<std::int64_t, kDigits + 1> digits_{};  // the last: how many terms were not finite
};

}  // namespace scree
