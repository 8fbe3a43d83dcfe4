// Packing fraction of a region, and profiles along an axis. Bodies count with the part of them that lies in the region
// or in the bin (measure_overlap.hpp, measure_polyhedra.hpp); where they overlap each other, both count.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "solvers/measure_kinds.hpp"
#include "solvers/measure_polyhedra.hpp"

namespace scree::solvers::detail {
namespace {

std::size_t bins_of(const Measure& m) {
    return static_cast<std::size_t>(m.bins);
}
double bin_width(const Measure& m) {
    return (m.to_coordinate - m.from_coordinate) / m.bins;
}
double bin_start(const Measure& m, std::size_t bin) {
    return m.from_coordinate + (m.to_coordinate - m.from_coordinate) * static_cast<double>(bin) / m.bins;
}

constexpr double kParallel = 1.0 - 1e-12;  // cosine of two axes that are one

BoxRegion cut(BoxRegion box, int coordinate, double low, double high) {
    box.lower[coordinate] = std::max(box.lower[coordinate], low);
    box.upper[coordinate] = std::min(box.upper[coordinate], high);
    return box;
}

CylinderRegion cut(CylinderRegion cylinder, double low, double high) {  // heights from the base
    low = std::max(low, 0.0);
    high = std::min(high, cylinder.length);
    cylinder.base += low * cylinder.axis;
    cylinder.length = std::max(0.0, high - low);
    return cylinder;
}

// The part of the region in a bin, if it is a box or a cylinder that the axis goes along, so that the bin has a volume.
std::optional<Region> bin_region(const Measure& m, std::size_t bin) {
    const double low = bin_start(m, bin), high = bin_start(m, bin + 1);
    if (!m.region) return std::nullopt;
    if (const auto* box = std::get_if<BoxRegion>(&*m.region)) {
        for (int i = 0; i < 3; ++i) {
            if (m.axis[i] >= kParallel) return cut(*box, i, low, high);
            if (m.axis[i] <= -kParallel) return cut(*box, i, -high, -low);
        }
    }
    if (const auto* cylinder = std::get_if<CylinderRegion>(&*m.region)) {
        const double cosine = cylinder->axis.dot(m.axis), base = cylinder->base.dot(m.axis);
        if (cosine >= kParallel) return cut(*cylinder, low - base, high - base);
        if (cosine <= -kParallel) return cut(*cylinder, base - high, base - low);
    }
    return std::nullopt;
}

double region_volume(const Region& region) {
    if (const auto* box = std::get_if<BoxRegion>(&region)) {
        return (box->lower.array() < box->upper.array()).all() ? volume(region) : 0.0;
    }
    return volume(region);
}

}  // namespace

Columns packing_columns() {
    return {{"value", "1", "Volume of the bodies inside the region over the volume of the region", 1},
            {"solid_volume", "m3", "Volume of the bodies inside the region", 1}};
}

void sample_packing(const Sampled& s, Pool& pool) {
    const Bodies& bodies = s.state.bodies;
    const BoxRegion box = bounds(*s.measure.region);
    ExactSum& solid = pool.sums(1)[0];
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const Vec3& x = bodies.position[i];
        const double r = bodies.radius[i];
        if (((x - box.upper).array() >= r).any() || ((box.lower - x).array() >= r).any()) continue;
        solid.add(part_in(*s.measure.region, s.state, i));
    }
}

Numbers finish_packing(const Measure& measure, std::span<const double> numbers) {
    return {numbers[0] / volume(*measure.region), numbers[0]};
}

Columns profile_columns(const Measure& m, const Scene& scene) {
    const double origin = scene.origin.dot(m.axis);
    const std::string where =
        fmt::format("; {} bins from {} m to {} m along ({}, {}, {})", m.bins, m.from_coordinate + origin,
                    m.to_coordinate + origin, m.axis.x(), m.axis.y(), m.axis.z());
    Columns columns;
    if (bin_region(m, 0)) {
        columns.push_back({"packing_fraction", "1", "Share of the bin's volume that bodies fill" + where, m.bins});
    } else {
        columns.push_back({"volume_per_length", "m2", "Volume of bodies in the bin over its width" + where, m.bins});
    }
    for (const char* axis : {"x", "y", "z"}) {
        columns.push_back({fmt::format("velocity_{}", axis), "m/s",
                           fmt::format("Mean velocity in the bin, weighted by mass, {}", axis) + where, m.bins});
    }
    return columns;
}

// Numbers, each one a bin: volume of bodies, mass, momentum x, y, z.
void sample_profile(const Sampled& s, Pool& pool) {
    const Measure& m = s.measure;
    const Bodies& bodies = s.state.bodies;
    const std::size_t n = bins_of(m);
    std::vector<std::optional<Region>> region(n);
    for (std::size_t bin = 0; bin < n; ++bin) region[bin] = bin_region(m, bin);
    const std::span<ExactSum> sums = pool.sums(5 * n);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const double along = bodies.position[i].dot(m.axis), radius = bodies.radius[i];
        if (!region[0] && !in_region(m, bodies.position[i])) continue;  // no part of the region's shape: centres
        const double low = (along - radius - m.from_coordinate) / bin_width(m);
        const double high = (along + radius - m.from_coordinate) / bin_width(m);
        if (high < 0.0 || low >= m.bins) continue;
        const std::size_t last = high >= m.bins ? n - 1 : static_cast<std::size_t>(high);
        for (std::size_t bin = low <= 0.0 ? 0 : static_cast<std::size_t>(low); bin <= last; ++bin) {
            const double part = region[bin]
                                    ? part_in(*region[bin], s.state, i)
                                    : part_between(s.state, i, m.axis, bin_start(m, bin), bin_start(m, bin + 1));
            const double mass = bodies.mass[i] * part / volume_of(s.state, i);
            sums[bin].add(part);
            sums[n + bin].add(mass);
            for (std::size_t k = 0; k < 3; ++k)
                sums[(2 + k) * n + bin].add(mass * bodies.velocity[i][static_cast<Eigen::Index>(k)]);
        }
    }
}

Numbers finish_profile(const Measure& m, std::span<const double> numbers) {
    const std::size_t n = bins_of(m);
    Numbers values(4 * n);
    for (std::size_t bin = 0; bin < n; ++bin) {
        const std::optional<Region> region = bin_region(m, bin);
        const double size = region ? region_volume(*region) : bin_width(m);
        values[bin] = size > 0.0 ? numbers[bin] / size : 0.0;  // a bin beyond the region is empty
        for (std::size_t k = 1; k < 4; ++k) values[k * n + bin] = numbers[(k + 1) * n + bin] / numbers[n + bin];
    }
    return values;
}

}  // namespace scree::solvers::detail
