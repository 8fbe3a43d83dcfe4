// Measures that look at bodies alone: mass in a region, and how far the bodies reach.
#include <cmath>
#include <limits>

#include "solvers/measure_kinds.hpp"

namespace scree::solvers::detail {

bool in_region(const Measure& measure, const Vec3& x) {
    return !measure.region || contains(*measure.region, x);
}

Columns mass_in_columns() {
    return {{"mass", "kg", "Mass of the bodies with their centre in the region", 1},
            {"number", "1", "Bodies with their centre in the region", 1}};
}

void sample_mass_in(const Sampled& s, Numbers& out) {
    const Bodies& bodies = s.state.bodies;
    double mass = 0.0, number = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!in_region(s.measure, bodies.position[i])) continue;
        mass += bodies.mass[i];
        number += 1.0;
    }
    append(out, {mass, number});
}

Columns extent_columns() {
    return {{"lowest", "m", "Lowest point of the bodies along the axis", 1},
            {"highest", "m", "Highest point of the bodies along the axis", 1},
            {"centre_of_mass", "m", "Centre of mass of the bodies, along the axis", 1}};
}

// Numbers: 1 if there are bodies, lowest, highest, centre of mass (0 if there are none).
void sample_extent(const Sampled& s, Numbers& out) {
    const Bodies& bodies = s.state.bodies;
    double lowest = kForever, highest = -kForever, mass = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!in_region(s.measure, bodies.position[i])) continue;
        const double along = bodies.position[i].dot(s.measure.axis);
        lowest = std::min(lowest, along - bodies.radius[i]);
        highest = std::max(highest, along + bodies.radius[i]);
        mass += bodies.mass[i];
        moment += bodies.mass[i] * along;
    }
    if (mass > 0.0) {
        append(out, {1.0, lowest, highest, moment / mass});
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
