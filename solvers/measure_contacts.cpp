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

void read_wall_force(const Sampled& s, Numbers& out) {
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

namespace {

struct BodyCount {
    std::uint64_t id, contacts;
};

// The contacts with an impulse of each body that this rank has; `foreign`: the other bodies that have some of this
// rank's contacts, each as often.
std::vector<std::uint64_t> count_contacts(const Sampled& s, std::vector<std::uint64_t>& foreign) {
    const Bodies& bodies = s.state.bodies;
    std::vector<std::uint64_t> count(bodies.size(), 0);
    const auto add = [&](std::uint64_t id) {
        const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), BodyId{id});
        const auto i = static_cast<std::size_t>(at - bodies.id.begin());
        if (i < bodies.size() && raw(*at) == id && !bodies.is_ghost(i))
            ++count[i];
        else
            foreign.push_back(id);
    };
    for (const ContactRecord& contact : s.outcome.contacts) {
        if (contact.impulse.isZero(0.0)) continue;
        add(contact.key.a);
        if (!contact.key.is_wall()) add(contact.key.b);
    }
    return count;
}

// A body's contacts may lie on ranks that do not know who has the body now. So counts meet on the rank id % ranks:
// those of the bodies to be counted, from the ranks that have them, and those of the contacts found elsewhere.
std::vector<BodyCount> bring_together(const std::vector<BodyCount>& bodies, const std::vector<std::uint64_t>& foreign,
                                      const Communicator& ranks) {
    const auto size = static_cast<std::uint64_t>(ranks.size());
    std::vector<std::vector<BodyCount>> to(size);
    for (const BodyCount& body : bodies) to[body.id % size].push_back(body);
    std::vector<std::vector<std::uint64_t>> elsewhere(size);
    for (const std::uint64_t id : foreign) elsewhere[id % size].push_back(id);
    std::vector<Communicator::Message> out;
    for (std::size_t r = 0; r < size; ++r) {
        if (to[r].empty() && elsewhere[r].empty()) continue;
        Packer packer;
        packer.put(static_cast<std::uint64_t>(to[r].size()));
        packer.put_all(std::span<const BodyCount>(to[r]));
        packer.put_all(std::span<const std::uint64_t>(elsewhere[r]));
        out.push_back({static_cast<int>(r), std::move(packer.bytes)});
    }
    std::vector<BodyCount> met;
    std::vector<std::uint64_t> touched;
    for (const Communicator::Message& message : ranks.exchange(out)) {
        Unpacker from(message.bytes);
        for (auto n = from.get<std::uint64_t>(); n > 0; --n) met.push_back(from.get<BodyCount>());
        while (!from.empty()) touched.push_back(from.get<std::uint64_t>());
    }
    std::sort(touched.begin(), touched.end());
    for (BodyCount& body : met) {
        const auto [first, last] = std::equal_range(touched.begin(), touched.end(), body.id);
        body.contacts += static_cast<std::uint64_t>(last - first);
    }
    return met;
}

}  // namespace

// Numbers: bodies, their contacts, bodies without one.
void sample_coordination(const Sampled& s, Pool& pool) {
    const Bodies& bodies = s.state.bodies;
    std::vector<std::uint64_t> foreign;
    const std::vector<std::uint64_t> count = count_contacts(s, foreign);
    std::vector<BodyCount> counted;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!bodies.is_ghost(i) && in_region(s.measure, bodies.position[i]))
            counted.push_back({raw(bodies.id[i]), count[i]});
    if (!s.ranks.alone()) counted = bring_together(counted, foreign, s.ranks);
    double contacts = 0.0, free = 0.0;
    for (const BodyCount& body : counted) {
        contacts += static_cast<double>(body.contacts);
        if (body.contacts == 0) free += 1.0;
    }
    const std::span<ExactSum> sums = pool.sums(3);
    sums[0].add(static_cast<double>(counted.size()));
    sums[1].add(contacts);
    sums[2].add(free);
}

Numbers finish_coordination(std::span<const double> numbers) {
    return {numbers[1] / numbers[0], numbers[2] / numbers[0]};
}

}  // namespace scree::solvers::detail
