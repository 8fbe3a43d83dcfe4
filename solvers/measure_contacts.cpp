// Measures that look at contacts: force on a wall, coordination.
#include <fmt/format.h>

#include <algorithm>

#include "solvers/measure_kinds.hpp"

namespace scree::solvers::detail {

Columns wall_force_columns(const Measure& measure, const Scene& scene) {
    const std::string& wall = scene.walls[raw(measure.wall)].name;
    const std::string force = fmt::format("Force of the bodies on wall `{}`, mean over the step, ", wall);
    const std::string torque = fmt::format("Torque on wall `{}` about the scene's origin ({}, {}, {}), ", wall,
                                           scene.origin.x(), scene.origin.y(), scene.origin.z());
    return {{"force_x", "N", force + "x", 1},
            {"force_y", "N", force + "y", 1},
            {"force_z", "N", force + "z", 1},
            {"torque_x", "N m", torque + "x", 1},
            {"torque_y", "N m", torque + "y", 1},
            {"torque_z", "N m", torque + "z", 1},
            {"contacts", "1", "Contacts with the wall that carry an impulse", 1}};
}

void sample_wall_force(const Sampled& s, Numbers& out) {
    const std::size_t wall = raw(s.measure.wall);
    const WallLoad none;
    const WallLoad& load = wall < s.outcome.wall_loads.size() ? s.outcome.wall_loads[wall] : none;
    const double per_second = s.outcome.length > 0.0 ? 1.0 / s.outcome.length : 0.0;
    for (const Vec3& impulse : {load.impulse, load.angular}) {
        for (int i = 0; i < 3; ++i) out.push_back(impulse[i] * per_second);
    }
    out.push_back(static_cast<double>(load.contacts));
}

Columns coordination_columns() {
    return {{"mean", "1", "Contacts with an impulse, walls included, a body with its centre in the region", 1},
            {"rattlers", "1", "Share of these bodies that have no contact with an impulse", 1}};
}

// Numbers: bodies, their contacts, bodies without one.
void sample_coordination(const Sampled& s, Numbers& out) {
    const Bodies& bodies = s.state.bodies;
    std::vector<std::uint32_t> count(bodies.size(), 0);
    const auto add = [&](std::uint64_t id) {
        const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), BodyId{id});
        if (at != bodies.id.end() && raw(*at) == id) ++count[static_cast<std::size_t>(at - bodies.id.begin())];
    };
    for (const ContactRecord& contact : s.outcome.contacts) {
        if (contact.impulse.isZero(0.0)) continue;
        add(contact.key.a);
        if (!contact.key.is_wall()) add(contact.key.b);
    }
    double number = 0.0, contacts = 0.0, free = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!in_region(s.measure, bodies.position[i])) continue;
        number += 1.0;
        contacts += count[i];
        if (count[i] == 0) free += 1.0;
    }
    append(out, {number, contacts, free});
}

Numbers finish_coordination(std::span<const double> numbers) {
    return {numbers[1] / numbers[0], numbers[2] / numbers[0]};
}

}  // namespace scree::solvers::detail
