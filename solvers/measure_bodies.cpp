// Measures that look at bodies alone: mass in a region, and how far the bodies reach.
#include <algorithm>
#include <array>

#include "core/parallel/body_sums.hpp"
#include "solvers/measure_kinds.hpp"
#include "solvers/measure_polyhedra.hpp"

namespace scree::solvers::detail {

bool in_region(const Measure& measure, const Vec3& x) {
    return !measure.region || contains(*measure.region, x);
}

Columns mass_in_columns() {
    return {{"mass", "kg", "Mass of the bodies with their centre in the region", 1},
            {"number", "1", "Bodies with their centre in the region", 1}};
}

void sample_mass_in(const Sampled& s, Pool& pool) {
    const Bodies& bodies = s.state.bodies;
    add_over_bodies(bodies, std::span<ExactSum, 2>(pool.sums(2)), [&](std::size_t i) {
        const bool in = in_region(s.measure, bodies.position[i]);
        return std::array{in ? bodies.mass[i] : 0.0, in ? 1.0 : 0.0};
    });
}

Columns extent_columns() {
    return {{"lowest", "m", "Lowest point of the bodies along the axis", 1},
            {"highest", "m", "Highest point of the bodies along the axis", 1},
            {"centre_of_mass", "m", "Centre of mass of the bodies, along the axis", 1}};
}

void sample_extent(const Sampled& s, Pool& pool) {
    const Bodies& bodies = s.state.bodies;
    double lowest = kForever, highest = -kForever;
    const auto sample = [&](const auto& reach_from) {
        add_over_bodies(bodies, std::span<ExactSum, 2>(pool.sums(2)), [&](std::size_t i) {
            if (bodies.is_ghost(i) || !in_region(s.measure, bodies.position[i])) return std::array{0.0, 0.0};
            const double along = bodies.position[i].dot(s.measure.axis);
            const Reach reach = reach_from(i, along);
            lowest = std::min(lowest, reach.low);
            highest = std::max(highest, reach.high);
            return std::array{bodies.mass[i], bodies.mass[i] * along};
        });
    };
    if (bodies.has_shapes()) {
        sample([&](std::size_t i, double) { return reach_of(s.state, i, s.measure.axis); });
    } else {
        sample([&](std::size_t i, double along) { return Reach{along - bodies.radius[i], along + bodies.radius[i]}; });
    }
    const std::span<double> most = pool.most(2);
    most[0] = -lowest;
    most[1] = highest;
}

// Numbers: 1 if there are bodies, lowest, highest, centre of mass (0 if there are none).
void read_extent(Pool& pool, Numbers& out) {
    const std::span<const double> sums = pool.next_sums(2), most = pool.next_most(2);
    if (sums[0] > 0.0) {
        append(out, {1.0, -most[0], most[1], sums[1] / sums[0]});
    } else {
        append(out, {0.0, 0.0, 0.0, 0.0});
    }
}

Numbers finish_extent(const Scene& scene, const Measure& measure, std::span<const double> numbers) {
    const double origin = scene.origin.dot(measure.axis);
    Numbers values;
    for (std::size_t i = 1; i < 4; ++i) values.push_back(numbers[i] / numbers[0] + origin);
    return values;
}

}  // namespace scree::solvers::detail
