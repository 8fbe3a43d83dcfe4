// Flow through a plane, or through a disc of it. A body passes when its centre changes sides in a scenario step; it
// passes at the point where the line from its old to its new place meets the plane, and at the time in that proportion.
//
// A body that an outlet took in the step has no new place. It is where it would have flown freely,
//   x + h v + h^2 g / 2,
// moved to the nearest point of an outlet's region (it was in one). So a surface that bounds an outlet counts what the
// outlet takes.
#include <algorithm>
#include <cmath>

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

// Where a body ended, and how far that may be off by round-off.
struct End {
    Vec3 place;
    double slack;
};

End end_of_taken(const Passage& p, std::size_t i) {
    const double h = p.state.time - p.start.time;
    const Vec3 step = h * p.start.velocity[i] + 0.5 * h * h * p.scene.gravity.at(p.start.time + 0.5 * h);
    const Vec3 flown = p.start.position[i] + step;
    Vec3 best = flown;
    double nearest = kForever;
    for (const Outlet& outlet : p.scene.outlets) {
        if (outlet.until < p.start.time || outlet.from > p.state.time) continue;
        const Vec3 place = std::visit(NearestPoint{flown}, outlet.region);
        const double distance = (place - flown).norm();
        if (distance < nearest) nearest = distance, best = place;
    }
    return {best, 1e-9 * (step.norm() + p.start.position[i].norm())};
}

}  // namespace

Columns flow_rate_columns() {
    return {{"mass_rate", "kg/s", "Mass through the surface since the last row, over the time since then", 1},
            {"number_rate", "1/s", "Bodies through the surface since the last row, over the time since then", 1},
            {"passed_mass", "kg", "Mass through the surface since the start: along its normal less against it", 1},
            {"passed_number", "1", "Bodies through the surface since the start: along its normal less against it", 1}};
}

void count_passed(const Passage& p, const Measure& measure, MeasureState& counters) {
    const Vec3 &point = measure.surface.point, &normal = measure.surface.normal;
    const Bodies& now = p.state.bodies;
    std::size_t j = 0;
    for (std::size_t i = 0; i < p.start.id.size(); ++i) {
        while (j < now.size() && now.id[j] < p.start.id[i]) ++j;
        const bool taken = j == now.size() || now.id[j] != p.start.id[i];
        const Vec3& from = p.start.position[i];
        const End end = taken ? end_of_taken(p, i) : End{now.position[j], 0.0};
        const double before = (from - point).dot(normal);
        const double after = (end.place - point).dot(normal);
        const bool was_beyond = before >= 0.0;
        const bool is_beyond = after >= (was_beyond ? end.slack : -end.slack);
        if (was_beyond == is_beyond) continue;
        const double share = before == after ? 1.0 : std::clamp(before / (before - after), 0.0, 1.0);
        const Vec3 crossing = from + share * (end.place - from);
        if (measure.surface.radius && (crossing - point).norm() > *measure.surface.radius) continue;
        const double sign = is_beyond ? 1.0 : -1.0;
        counters.passed_mass += sign * p.start.mass[i];
        counters.passed_count += sign;
        const double time = p.start.time + share * (p.state.time - p.start.time);
        if (time < measure.from || time > measure.until) continue;
        counters.window_sum[0] += sign * p.start.mass[i];
        counters.window_sum[1] += sign;
    }
}

}  // namespace scree::solvers::detail
