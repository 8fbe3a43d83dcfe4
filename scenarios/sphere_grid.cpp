#include "scenarios/sphere_grid.hpp"

#include <cmath>

namespace scree::scenarios {

// 21 bits an axis. Cells 2^21 apart share a key, which costs a test of distance and changes no answer.
std::uint64_t SphereGrid::key(std::int64_t i, std::int64_t j, std::int64_t k) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
    return (static_cast<std::uint64_t>(i) & kMask) << 42 | (static_cast<std::uint64_t>(j) & kMask) << 21 |
           (static_cast<std::uint64_t>(k) & kMask);
}

void SphereGrid::add(const Vec3& centre, double radius) {
    int exponent = 0;
    std::frexp(2.0 * radius, &exponent);  // 2 radius < 2^exponent <= 4 radius
    Level& level = levels_[exponent];
    level.cell = std::ldexp(1.0, exponent);
    const auto index = static_cast<std::uint32_t>(spheres_.size());
    const auto cell = [&](int axis) { return static_cast<std::int64_t>(std::floor(centre[axis] / level.cell)); };
    const auto [at, is_new] = level.first.emplace(key(cell(0), cell(1), cell(2)), index);
    spheres_.push_back({centre, radius, is_new ? kNone : at->second});
    at->second = index;
    level.all.push_back(index);
}

bool SphereGrid::is_clear(std::uint32_t other, const Vec3& centre, double reach) const {
    const Sphere& sphere = spheres_[static_cast<std::size_t>(other)];
    const double distance = reach + sphere.radius;
    return (sphere.centre - centre).squaredNorm() >= distance * distance;
}

bool SphereGrid::is_free_in(const Level& level, const Vec3& centre, double radius, double gap) const {
    const double reach = radius + gap, far = reach + 0.5 * level.cell;
    std::int64_t low[3], high[3];
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = static_cast<std::int64_t>(std::floor((centre[axis] - far) / level.cell));
        high[axis] = static_cast<std::int64_t>(std::floor((centre[axis] + far) / level.cell));
        cells *= static_cast<double>(high[axis] - low[axis] + 1);
    }
    if (cells > static_cast<double>(level.all.size())) {
        for (const std::uint32_t other : level.all) {
            if (!is_clear(other, centre, reach)) return false;
        }
        return true;
    }
    for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        for (std::int64_t j = low[1]; j <= high[1]; ++j) {
            for (std::int64_t k = low[2]; k <= high[2]; ++k) {
                const auto found = level.first.find(key(i, j, k));
                if (found == level.first.end()) continue;
                for (std::uint32_t other = found->second; other != kNone;
                     other = spheres_[static_cast<std::size_t>(other)].next) {
                    if (!is_clear(other, centre, reach)) return false;
                }
            }
        }
    }
    return true;
}

bool SphereGrid::is_free(const Vec3& centre, double radius, double gap) const {
    for (const auto& [exponent, level] : levels_) {
        if (!is_free_in(level, centre, radius, gap)) return false;
    }
    return true;
}

}  // namespace scree::scenarios
