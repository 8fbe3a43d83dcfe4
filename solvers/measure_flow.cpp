// Flow through a plane, or through a disc of it. A body passes when its centre changes sides in a scenario step; it
// passes at the point where the line from its old to its new place meets the plane, and at the time in that proportion.
//
// A body that an outlet took in the step has no new place. It is where it would have flown freely,
//   x + h v + h^2 g / 2,
// moved to the nearest point of an outlet's region (it was in one). So a surface that bounds an outlet counts what the
// outlet takes.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "solvers/measure_kinds.hpp"

namespace scree::solvers::detail {
namespace {

struct NearestPoint {
    const Vec3& x;

    Vec3 operator()(const BoxRegion& r) const { return x.cwiseMax(r.lower).cwiseMin(r.upper); }
    Vec3 operator()(const SphereRegion& r) const {
        const Vec3 d = x - r.centre;
        const double distance = d.norm();
        return distance <= r.radius ? x : Vec3(r.centre + d * (r.radius / distance));
    }
    Vec3 operator()(const CylinderRegion& r) const {
        const Vec3 d = x - r.base;
        const double along = d.dot(r.axis);
        const Vec3 across = d - along * r.axis;
        const double distance = across.norm();
        const double shrink = distance <= r.radius ? 1.0 : r.radius / distance;
        return r.base + std::clamp(along, 0.0, r.length) * r.axis + shrink * across;
    }
    Vec3 operator()(const HalfSpaceRegion& r) const {
        return x - std::max(0.0, (x - r.point).dot(r.normal)) * r.normal;
    }
};

Flight flight_of_taken(const Passage& p, std::size_t i) {
    const double h = p.state.time - p.start.time;
    const Vec3& from = p.start.position[i];
    const Vec3 step = h * p.start.velocity[i] + 0.5 * h * h * p.scene.gravity.at(p.start.time + 0.5 * h);
    const Vec3 flown = from + step;
    Vec3 best = flown;
    double nearest = kForever;
    for (const Outlet& outlet : p.scene.outlets) {
        if (outlet.until < p.start.time || outlet.from > p.state.time) continue;
        const Vec3 place = std::visit(NearestPoint{flown}, outlet.region);
        const double distance = (place - flown).norm();
        if (distance < nearest) nearest = distance, best = place;
    }
    return {p.start.mass[i], from, best, 1e-9 * (step.norm() + from.norm())};
}

void count(const Passage& p, const Flight& flight, const Measure& measure, std::span<ExactSum> sums) {
    const Vec3 &point = measure.surface.point, &normal = measure.surface.normal;
    const double before = (flight.from - point).dot(normal);
    const double after = (flight.to - point).dot(normal);
    const bool was_beyond = before >= 0.0;
    const bool is_beyond = after >= (was_beyond ? flight.slack : -flight.slack);
    if (was_beyond == is_beyond) return;
    const double share = before == after ? 1.0 : std::clamp(before / (before - after), 0.0, 1.0);
    const Vec3 crossing = flight.from + share * (flight.to - flight.from);
    if (measure.surface.radius && (crossing - point).norm() > *measure.surface.radius) return;
    const double sign = is_beyond ? 1.0 : -1.0;
    sums[0].add(sign * flight.mass);
    sums[1].add(sign);
    const double time = p.start.time + share * (p.state.time - p.start.time);
    if (time < measure.from || time > measure.until) return;
    sums[2].add(sign * flight.mass);
    sums[3].add(sign);
}

// here(i, j) for each body i of the start that is body j now, gone(i) for those that are not here.
template <class Here, class Gone>
void follow(const Passage& p, const Here& here, const Gone& gone) {
    const Bodies& now = p.state.bodies;
    std::size_t j = 0;
    for (std::size_t i = 0; i < p.start.id.size(); ++i) {
        while (j < now.size() && now.id[j] < p.start.id[i]) ++j;
        if (j < now.size() && now.id[j] == p.start.id[i])
            here(i, j);
        else
            gone(i);
    }
}

}  // namespace

Columns flow_rate_columns() {
    return {{"mass_rate", "kg/s", "Mass through the surface since the last row, over the time since then", 1},
            {"number_rate", "1/s", "Bodies through the surface since the last row, over the time since then", 1},
            {"passed_mass", "kg", "Mass through the surface since the start: along its normal less against it", 1},
            {"passed_number", "1", "Bodies through the surface since the start: along its normal less against it", 1}};
}

std::vector<Flight> flights_of_absent(const Passage& p, const Communicator& ranks) {
    struct Absent {
        std::uint64_t id;
        Flight if_taken;
    };
    std::vector<Absent> absent;
    follow(
        p, [](std::size_t, std::size_t) {},
        [&](std::size_t i) {
            absent.push_back({raw(p.start.id[i]), flight_of_taken(p, i)});
        });
    std::vector<Flight> flights;
    if (ranks.alone()) {
        for (const Absent& body : absent) flights.push_back(body.if_taken);
        return flights;
    }
    if (!ranks.any(!absent.empty())) return flights;
    // Taken by an outlet, or another rank's now, which counts it. They are few.
    const std::vector<std::byte> all = ranks.all_gather(std::as_bytes(std::span<const Absent>(absent)));
    std::vector<std::uint64_t> owned(all.size() / sizeof(Absent), 0);
    std::vector<Absent> everyone(owned.size());
    std::memcpy(static_cast<void*>(everyone.data()), all.data(), all.size());
    const Bodies& now = p.state.bodies;
    for (std::size_t k = 0; k < everyone.size(); ++k) {
        const auto at = std::lower_bound(now.id.begin(), now.id.end(), BodyId{everyone[k].id});
        const auto j = static_cast<std::size_t>(at - now.id.begin());
        if (j == now.size() || raw(*at) != everyone[k].id || now.is_ghost(j)) continue;
        owned[k] = 1;
        flights.push_back({everyone[k].if_taken.mass, everyone[k].if_taken.from, now.position[j], 0.0});
    }
    ranks.max(std::span<std::uint64_t>(owned));
    for (std::size_t k = 0; k < everyone.size(); ++k)
        if (owned[k] == 0 && ranks.root()) flights.push_back(everyone[k].if_taken);
    return flights;
}

void count_passed(const Passage& p, std::span<const Flight> absent, const Measure& measure, Pool& pool) {
    const std::span<ExactSum> sums = pool.sums(kPassageSums);
    follow(
        p,
        [&](std::size_t i, std::size_t j) {
            count(p, {p.start.mass[i], p.start.position[i], p.state.bodies.position[j], 0.0}, measure, sums);
        },
        [](std::size_t) {});
    for (const Flight& flight : absent) count(p, flight, measure, sums);
}

}  // namespace scree::solvers::detail
