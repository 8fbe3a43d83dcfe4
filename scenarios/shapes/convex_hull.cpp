#include "scenarios/shapes/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace scree::scenarios {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool before(const Vec3& a, const Vec3& b) {
    return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
}

// In order of their coordinates, each farther than `tolerance` [m] from all before it.
std::vector<Vec3> different(std::vector<Vec3> points, double tolerance) {
    std::sort(points.begin(), points.end(), before);
    std::vector<Vec3> kept;
    for (const Vec3& x : points) {
        bool is_new = true;
        for (auto it = kept.rbegin(); it != kept.rend() && is_new && x.x() - it->x() <= tolerance; ++it)
            is_new = (x - *it).norm() > tolerance;
        if (is_new) kept.push_back(x);
    }
    return kept;
}

[[noreturn]] void flat(std::size_t points, const char* what, double distance, double size, double tolerance) {
    throw ShapeError(
        ShapeFault::no_volume,
        fmt::format("no volume: its {} points lie {}: none is farther than {:g} m from it, at a size of {:g} m "
                    "({:.2g}); more than {:.2g} is expected",
                    points, what, distance, size, distance / size, tolerance / size));
}

// The point for which `distance` is largest.
template <class Distance>
std::pair<Vec3, double> farthest(const std::vector<Vec3>& points, const Distance& distance) {
    const auto it = std::max_element(points.begin(), points.end(),
                                     [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
    return {*it, distance(*it)};
}

void check_spread(const std::vector<Vec3>& points, double size, double tolerance) {
    const Vec3 first = points.front();
    const Vec3 second = farthest(points, [&](const Vec3& x) { return (x - first).norm(); }).first;
    const Vec3 along = (second - first).normalized();
    const auto [third, from_line] = farthest(points, [&](const Vec3& x) { return along.cross(x - first).norm(); });
    if (from_line <= 4.0 * tolerance) flat(points.size(), "on one line", from_line, size, 4.0 * tolerance);
    const Vec3 normal = along.cross(third - first).normalized();
    const double from_plane = farthest(points, [&](const Vec3& x) { return std::abs(normal.dot(x - first)); }).second;
    if (from_plane <= 4.0 * tolerance) flat(points.size(), "in one plane", from_plane, size, 4.0 * tolerance);
}

// Triangles of the hull of sorted points. CGAL's own order depends on addresses in memory, so it is not used: vertices
// are those of `points`, triangles begin with their lowest vertex and are sorted.
Polyhedron hull_triangles(const std::vector<Vec3>& points) {
    std::vector<Kernel::Point_3> input;
    for (const Vec3& x : points) input.emplace_back(x.x(), x.y(), x.z());
    Mesh mesh;
    CGAL::convex_hull_3(input.begin(), input.end(), mesh);
    Polyhedron body{points, {}};
    for (const auto f : mesh.faces()) {
        auto& loop = body.face.emplace_back();
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
            const Vec3 x(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
            const auto place = std::lower_bound(points.begin(), points.end(), x, before);
            loop.push_back(static_cast<std::uint32_t>(place - points.begin()));
        }
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    }
    std::sort(body.face.begin(), body.face.end());
    return body;
}

}  // namespace

PlacedShape convex_hull(const std::vector<Vec3>& given, double relative) {
    for (std::size_t k = 0; k < given.size(); ++k)
        if (!given[k].allFinite())
            throw ShapeError(ShapeFault::not_finite, fmt::format("point {} has a coordinate that is not finite", k));
    if (given.size() < 4)
        throw ShapeError(ShapeFault::too_few, fmt::format("{} points, where at least 4 are expected", given.size()));
    const Extent extent = extent_of(given);
    const double size = extent.size(), tolerance = relative * size + 4.0 * extent.rounding();
    const std::vector<Vec3> points = different(given, tolerance);
    if (points.size() < 4)
        throw ShapeError(
            ShapeFault::too_few,
            fmt::format("only {} of its {} points are farther than {:g} m apart, where at least 4 are expected",
                        points.size(), given.size(), tolerance));
    check_spread(points, size, tolerance);

    return make_shape(hull_triangles(points), relative);
}

}  // namespace scree::scenarios
