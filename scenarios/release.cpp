#include "scenarios/release.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenarios/polygon.hpp"

namespace scree::scenarios {
namespace {

// Falls by tan(dip) along its dip direction, which is counted clockwise from +y (north).
struct SlidingPlane {
    Vec3 point;          // [m]
    double east, north;  // slope along +x and +y

    SlidingPlane(const io::Node& node, const Context& context) : point(context.point(node.at("point"))) {
        const double slope = std::tan(node.number("dip")), azimuth = node.number("dip_direction");
        east = -slope * std::sin(azimuth), north = -slope * std::cos(azimuth);
    }
    double height(double x, double y) const { return point.z() + east * (x - point.x()) + north * (y - point.y()); }
};

// [m3] Each cell with four heights counts by the mean of its corners, one with three by half its area.
double volume_of(const HeightGrid& grid, const std::vector<double>& thickness) {
    double sum = 0.0;
    for (std::uint32_t j = 0; j + 1 < grid.rows; ++j)
        for (std::uint32_t i = 0; i + 1 < grid.columns; ++i) {
            int corners = 0;
            double of_cell = 0.0;
            for (const std::uint32_t b : {j, j + 1})
                for (const std::uint32_t a : {i, i + 1}) {
                    if (!grid.has(a, b)) continue;
                    of_cell += thickness[std::size_t{b} * grid.columns + a];
                    ++corners;
                }
            if (corners == 4) sum += of_cell / 4.0;
            if (corners == 3) sum += of_cell / 6.0;
        }
    return sum * grid.dx * grid.dy;
}

}  // namespace

TerrainRelease cut_release(const io::Node& node, const Context& context, HeightGrid& grid) {
    TerrainRelease release;
    release.thickness.assign(grid.height.size(), 0.0);
    const Polygon perimeter(node.at("perimeter"), context);
    std::vector<SlidingPlane> planes;
    for (const io::Node& plane : node.at("planes").items()) planes.emplace_back(plane, context);
    if (planes.empty()) context.error(node.at("planes"), "one sliding plane is needed at least");
    if (!perimeter.has_area() || planes.empty()) return release;
    bool any_within = false;
    for (std::uint32_t j = 0; j < grid.rows; ++j)
        for (std::uint32_t i = 0; i < grid.columns; ++i) {
            const double x = grid.x + i * grid.dx, y = grid.y + j * grid.dy;
            if (!grid.has(i, j) || !perimeter.holds(x, y)) continue;
            any_within = true;
            double base = -std::numeric_limits<double>::infinity();
            for (const SlidingPlane& plane : planes) base = std::max(base, plane.height(x, y));
            double& height = grid.height[std::size_t{j} * grid.columns + i];
            const double taken = height - base;
            if (!(taken > 0.0)) continue;
            release.thickness[std::size_t{j} * grid.columns + i] = taken;
            release.deepest = std::max(release.deepest, taken);
            release.area += grid.dx * grid.dy;
            height = base;
        }
    release.volume = volume_of(grid, release.thickness);
    if (!any_within) {
        context.error(node.at("perimeter"), fmt::format("no node of the terrain lies within it; nodes are {:g} x {:g} "
                                                        "m apart",
                                                        grid.dx, grid.dy));
    } else if (!(release.volume > 0.0)) {
        context.error(node.at("planes"), "the terrain lies nowhere above the sliding planes within the perimeter");
    }
    return release;
}

}  // namespace scree::scenarios
