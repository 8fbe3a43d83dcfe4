// Distributions of grain diameter [m], by number.
#pragma once

#include <variant>
#include <vector>

#include "core/random.hpp"

namespace scree {

struct FixedSize {
    double diameter;
};
struct UniformSize {
    double lower, upper;
};
struct NormalSize {
    double mean, deviation, lower, upper;
};  // truncated to [lower, upper]
struct LogNormalSize {
    double median, sigma, lower, upper;
};  // ln d ~ N(ln median, sigma^2), truncated
struct PowerLawSize {
    double lower, upper, exponent;
};  // number density ~ d^-exponent
struct TableSize {
    std::vector<double> diameter, passing;
};  // cumulative share by number, 0 to 1, linear between
using SizeDistribution = std::variant<FixedSize, UniformSize, NormalSize, LogNormalSize, PowerLawSize, TableSize>;

// One diameter; uses as many draws as it needs from `random`.
double draw_diameter(const SizeDistribution& distribution, Random& random);
double smallest_diameter(const SizeDistribution& distribution);
double largest_diameter(const SizeDistribution& distribution);

}  // namespace scree
