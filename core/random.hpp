// Counter-based random numbers: a number is a pure function of (seed, stream, index, draw), so that it depends neither
// on the order in which bodies are made nor on the number of ranks, and a restart needs only the counters.
// Mixing: two rounds of the finaliser of SplitMix64 (Steele, Lea, Flood 2014) over the four words.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace scree {

constexpr std::uint64_t mix64(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

// The draws of one thing (a body, an attempt): call uniform() as often as needed, always in the same order.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t index)
        : key_(mix64(mix64(mix64(seed) ^ stream) ^ index)) {}

    std::uint64_t bits() { return mix64(key_ ^ mix64(draw_++)); }
    // in [0, 1), 53 bits
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    // standard normal (Box and Muller 1958); two uniforms a call
    double normal() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

  private:
    std::uint64_t key_;
    std::uint64_t draw_ = 0;
};

}  // namespace scree
