#include "solvers/measure_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scree::solvers {
namespace {

using std::numbers::pi;

double segment_area(double rho, double a) {  // x >= a
    if (a >= rho) return 0.0;
    if (a <= -rho) return pi * rho * rho;
    return rho * rho * std::acos(a / rho) - a * std::sqrt((rho - a) * (rho + a));
}

// x - sin x for x >= 0.
double excess(double x) {
    if (x > 0.5) return x - std::sin(x);
    double term = x * x * x / 6.0, sum = term;
    for (int k = 4; std::abs(term) > 1e-17 * sum; k += 2) {
        term *= -x * x / (k * (k + 1));
        sum += term;
    }
    return sum;
}

// Gauss-Legendre, ten points on [-1, 1].
constexpr std::array<double, 5> kNode = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                         0.9739065285171717};
constexpr std::array<double, 5> kWeight = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820,
                                           0.1494513491505806, 0.0666713443086881};

template <class F>
double gauss(const F& f, double low, double high) {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    double sum = 0.0;
    for (std::size_t i = 0; i < kNode.size(); ++i) {
        sum += kWeight[i] * (f(middle - half * kNode[i]) + f(middle + half * kNode[i]));
    }
    return half * sum;
}

// Halves until both halves together agree with the whole.
template <class F>
double adaptive(const F& f, double low, double high, double whole, int depth) {
    const double middle = 0.5 * (low + high);
    const double left = gauss(f, low, middle), right = gauss(f, middle, high);
    if (depth == 0 || std::abs(left + right - whole) < 1e-14) return left + right;
    return adaptive(f, low, middle, left, depth - 1) + adaptive(f, middle, high, right, depth - 1);
}

// The integral over z in [low, high] of area(sqrt(1 - z^2)), whose formula changes where the radius is one of `breaks`.
// z = low + (high - low) sin^2(t) makes roots at the ends of a piece smooth.
template <class Area, std::size_t N>
double along_axis(const Area& area, double low, double high, const std::array<double, N>& breaks) {
    std::array<double, 2 * N + 2> cut{};  // increasing
    std::size_t n = 0;
    const auto insert = [&](double z) {
        std::size_t i = n++;
        for (; i > 0 && cut[i - 1] > z; --i) cut[i] = cut[i - 1];
        cut[i] = z;
    };
    insert(low);
    insert(high);
    for (double rho : breaks) {
        if (!(rho < 1.0)) continue;
        const double z = std::sqrt((1.0 - rho) * (1.0 + rho));
        if (-z > low && -z < high) insert(-z);
        if (z > low && z < high) insert(z);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double start = cut[i], size = cut[i + 1] - cut[i];
        const auto f = [&](double t) {
            const double s = std::sin(t), z = start + size * s * s;
            return area(std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)))) * 2.0 * size * s * std::cos(t);
        };
        sum += adaptive(f, 0.0, 0.5 * pi, gauss(f, 0.0, 0.5 * pi), 12);
    }
    return sum;
}

struct Overlap {
    const Vec3& centre;
    double radius;

    double sphere() const { return 4.0 / 3.0 * pi * radius * radius * radius; }

    double operator()(const HalfSpaceRegion& r) const {
        return slab_volume(radius, -kFar, (r.point - centre).dot(r.normal));
    }

    double operator()(const SphereRegion& r) const {
        const double d = (centre - r.centre).norm(), sum = radius + r.radius, difference = radius - r.radius;
        if (d >= sum) return 0.0;
        if (d <= std::abs(difference)) {
            const double smaller = std::min(radius, r.radius);
            return 4.0 / 3.0 * pi * smaller * smaller * smaller;
        }
        return pi * (sum - d) * (sum - d) * (d * d + 2.0 * d * sum - 3.0 * difference * difference) / (12.0 * d);
    }

    double operator()(const BoxRegion& r) const {
        if ((r.lower.array() >= r.upper.array()).any()) return 0.0;
        // Faces in units of the radius about the centre; a face that does not cut is at -1 or 1.
        const Vec3 low = ((r.lower - centre) / radius).cwiseMax(-1.0),
                   high = ((r.upper - centre) / radius).cwiseMin(1.0);
        if ((low.array() >= 1.0).any() || (high.array() <= -1.0).any()) return 0.0;
        std::array<int, 3> axis = {0, 1, 2};  // directions that cut come first
        int cut = 0;
        for (int i = 0; i < 3; ++i) {
            if (low[i] > -1.0 || high[i] < 1.0)
                std::swap(axis[static_cast<std::size_t>(cut++)], axis[static_cast<std::size_t>(i)]);
        }
        const int z = axis[0], x = axis[1], y = axis[2];
        if (cut == 0) return sphere();
        if (cut == 1) return slab_volume(radius, radius * low[z], radius * high[z]);
        const double x0 = low[x], x1 = high[x], y0 = low[y], y1 = high[y];
        const auto area = [&](double rho) {
            return quadrant_area(rho, x0, y0) - quadrant_area(rho, x1, y0) - quadrant_area(rho, x0, y1) +
                   quadrant_area(rho, x1, y1);
        };
        const std::array<double, 8> breaks = {std::abs(x0),       std::abs(x1),       std::abs(y0),
                                              std::abs(y1),       std::hypot(x0, y0), std::hypot(x1, y0),
                                              std::hypot(x0, y1), std::hypot(x1, y1)};
        return radius * radius * radius * std::max(0.0, along_axis(area, low[z], high[z], breaks));
    }

    double operator()(const CylinderRegion& r) const {
        if (r.length <= 0.0 || r.radius <= 0.0) return 0.0;
        const Vec3 relative = centre - r.base;
        const double height = relative.dot(r.axis);
        const double distance = (relative - height * r.axis).norm() / radius, wide = r.radius / radius;
        const double low = std::max(-height / radius, -1.0), high = std::min((r.length - height) / radius, 1.0);
        if (low >= high || distance >= wide + 1.0) return 0.0;
        if (distance + 1.0 <= wide) return slab_volume(radius, radius * low, radius * high);
        const auto area = [&](double rho) { return lens_area(rho, wide, distance); };
        const std::array<double, 2> breaks = {std::abs(wide - distance), wide + distance};
        return radius * radius * radius * std::max(0.0, along_axis(area, low, high, breaks));
    }

    static constexpr double kFar = std::numeric_limits<double>::infinity();
};

}  // namespace

double slab_volume(double radius, double low, double high) {
    const double a = std::clamp(low, -radius, radius), b = std::clamp(high, -radius, radius);
    if (b <= a) return 0.0;
    // pi (r^2 - (a^2 + a b + b^2) / 3) (b - a): no difference of two caps, which would lose the digits of a thin slab.
    return pi * (b - a) * (radius * radius - (a * a + a * b + b * b) / 3.0);
}

double quadrant_area(double rho, double a, double b) {
    if (a >= rho || b >= rho) return 0.0;
    if (a <= -rho) return segment_area(rho, b);
    if (b <= -rho) return segment_area(rho, a);
    const double x = std::sqrt((rho - b) * (rho + b));  // the circle meets y = b at -x and x
    if (a >= x) return b >= 0.0 ? 0.0 : segment_area(rho, a);
    if (a <= -x)
        return b >= 0.0 ? segment_area(rho, b) : pi * rho * rho - segment_area(rho, -a) - segment_area(rho, -b);
    const auto primitive = [&](double s) {  // of sqrt(rho^2 - s^2)
        return 0.5 * (s * std::sqrt(std::max(0.0, (rho - s) * (rho + s))) +
                      rho * rho * std::asin(std::clamp(s / rho, -1.0, 1.0)));
    };
    return primitive(x) - primitive(a) - b * (x - a) + (b < 0.0 ? segment_area(rho, x) : 0.0);
}

double lens_area(double rho, double radius, double distance) {
    if (distance >= rho + radius || rho <= 0.0) return 0.0;
    if (distance <= std::abs(rho - radius)) return pi * std::min(rho, radius) * std::min(rho, radius);
    // Half the chord and its distance from each centre, times 2 distance; no difference of squares, so that a small
    // circle at the edge of a large one keeps its digits.
    const double chord = std::sqrt((rho + radius - distance) * (distance + (rho - radius)) *
                                   (distance - (rho - radius)) * (distance + rho + radius));
    const double from_first = (distance - radius) * (distance + radius) + rho * rho;
    const double from_second = (distance - rho) * (distance + rho) + radius * radius;
    return 0.5 * (rho * rho * excess(2.0 * std::atan2(chord, from_first)) +
                  radius * radius * excess(2.0 * std::atan2(chord, from_second)));
}

double overlap_volume(const Region& region, const Vec3& centre, double radius) {
    return std::visit(Overlap{centre, radius}, region);
}

}  // namespace scree::solvers
