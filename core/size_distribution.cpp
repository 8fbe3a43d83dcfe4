#include "core/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree {
namespace {

// Share of the standard normal distribution in [a, b], a <= b; from the tail's side, so that far tails keep digits.
double normal_share(double a, double b) {
    if (a > 0.0) return normal_share(-b, -a);
    const double below_b = 0.5 * std::erfc(-b / std::numbers::sqrt2);
    return below_b - 0.5 * std::erfc(-a / std::numbers::sqrt2);
}

// Standard normal truncated to [a, b], by the rejection that wastes least: from the normal itself, from the uniform
// distribution on [a, b], or from an exponential one in a far tail (Robert 1995, Simulation of truncated normal
// variables, section 2).
double truncated_normal(double a, double b, Random& random) {
    if (!(a < b)) return a;
    if (a > 0.0) return -truncated_normal(-b, -a, random);
    // now a <= 0: the density has its peak in [a, b], or at b if b < 0
    const double peak = std::min(b, 0.0);
    if (normal_share(a, b) > 0.25) {
        for (;;) {
            const double x = random.normal();
            if (x >= a && x <= b) return x;
        }
    }
    const double rate = 0.5 * (-peak + std::sqrt(peak * peak + 4.0));
    if ((b - a) * rate < 2.0 || b > 0.0) {
        for (;;) {
            const double x = random.uniform(a, b);
            if (random.uniform() <= std::exp(0.5 * (peak * peak - x * x))) return x;
        }
    }
    for (;;) {
        const double x = b + std::log(1.0 - random.uniform()) / rate;
        const double excess = x + rate;
        if (random.uniform() <= std::exp(-0.5 * excess * excess) && x >= a) return x;
    }
}

// Inverse transform of the density d^-n on [l, u]. With k = 1 - n and v uniform, counted from the end where the
// density of d^k makes the argument of exp negative, so that no exponent overflows:
//   d = end * (1 + v (e^{-|k| ln(u/l)} - 1))^(1/k)
double power_law(const PowerLawSize& s, double v) {
    const double span = std::log(s.upper / s.lower);
    const double k = 1.0 - s.exponent;
    if (std::abs(k) * span < 1e-12) return s.lower * std::exp(v * span);
    const double end = k > 0.0 ? s.upper : s.lower;
    return end * std::exp(std::log1p(v * std::expm1(-std::abs(k) * span)) / k);
}

struct Draw {
    Random& random;

    double operator()(const FixedSize& s) const { return s.diameter; }
    double operator()(const UniformSize& s) const { return random.uniform(s.lower, s.upper); }
    double operator()(const NormalSize& s) const {
        const double a = (s.lower - s.mean) / s.deviation, b = (s.upper - s.mean) / s.deviation;
        return std::clamp(s.mean + s.deviation * truncated_normal(a, b, random), s.lower, s.upper);
    }
    double operator()(const LogNormalSize& s) const {
        const double a = std::log(s.lower / s.median) / s.sigma, b = std::log(s.upper / s.median) / s.sigma;
        return std::clamp(s.median * std::exp(s.sigma * truncated_normal(a, b, random)), s.lower, s.upper);
    }
    double operator()(const PowerLawSize& s) const {
        return std::clamp(power_law(s, random.uniform()), s.lower, s.upper);
    }
    double operator()(const TableSize& s) const {
        const double share = random.uniform();
        const auto above = std::upper_bound(s.passing.begin(), s.passing.end(), share);
        if (above == s.passing.begin()) return s.diameter.front();
        if (above == s.passing.end()) return s.diameter.back();
        const auto i = static_cast<std::size_t>(above - s.passing.begin());
        const double part = (share - s.passing[i - 1]) / (s.passing[i] - s.passing[i - 1]);
        return s.diameter[i - 1] + part * (s.diameter[i] - s.diameter[i - 1]);
    }
};

struct Smallest {
    double operator()(const FixedSize& s) const { return s.diameter; }
    double operator()(const TableSize& s) const { return s.diameter.front(); }
    double operator()(const auto& s) const { return s.lower; }
};
struct Largest {
    double operator()(const FixedSize& s) const { return s.diameter; }
    double operator()(const TableSize& s) const { return s.diameter.back(); }
    double operator()(const auto& s) const { return s.upper; }
};

}  // namespace

double draw_diameter(const SizeDistribution& distribution, Random& random) {
    return std::visit(Draw{random}, distribution);
}
double smallest_diameter(const SizeDistribution& distribution) {
    return std::visit(Smallest{}, distribution);
}
double largest_diameter(const SizeDistribution& distribution) {
    return std::visit(Largest{}, distribution);
}

}  // namespace scree
