#include "scenarios/shapes/rock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenarios/shapes/convex_hull.hpp"

namespace scree::scenarios {
namespace {

Vec3 on_sphere(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = 2.0 * std::numbers::pi * random.uniform();
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

std::vector<Vec3> spread(int count, Random& random) {
    constexpr int kCandidates = 8;
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        Vec3 best = Vec3::Zero();
        double farthest = -1.0;
        for (int c = 0; c < kCandidates; ++c) {
            const Vec3 x = on_sphere(random);
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec3& y : points) nearest = std::min(nearest, (x - y).squaredNorm());
            if (nearest <= farthest) continue;
            farthest = nearest;
            best = x;
        }
        points.push_back(best);
    }
    return points;
}

}  // namespace

PlacedShape random_rock(const RockForm& form, Random random) {
    if (form.points < 6)
        throw ShapeError(ShapeFault::too_few,
                         fmt::format("a rock of {} points, where at least 6 are expected", form.points));
    for (const double ratio : {form.elongation, form.flatness})
        if (!(ratio > 0.0 && ratio <= 1.0))
            throw ShapeError(
                ShapeFault::no_volume,
                fmt::format("a rock with elongation {:g} and flatness {:g}, where both are expected in (0, 1]",
                            form.elongation, form.flatness));
    std::vector<Vec3> points = spread(form.points, random);
    const Extent extent = extent_of(points);
    const Vec3 sides(1.0, form.elongation, form.elongation * form.flatness);
    const Vec3 stretch = sides.cwiseQuotient(extent.upper - extent.lower);
    for (Vec3& x : points) x = (x - extent.middle()).cwiseProduct(stretch);
    return convex_hull(points);
}

}  // namespace scree::scenarios
