#include "core/make_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/simplify.hpp"
#include "core/volume_integrals.hpp"

namespace scree {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Tolerance {
    double length;  // [m]
    double size;    // [m] of the body
    double noise;   // [m] round-off in coordinates
};

void check_volume(const VolumeIntegrals& body, const Tolerance& tolerance) {
    if (!std::isfinite(std::pow(tolerance.size, 5)) || !std::isnormal(std::pow(tolerance.length, 5)))
        throw ShapeError(
            ShapeFault::not_finite,
            fmt::format("a body of {:g} m has moments of inertia that no number can hold", tolerance.size));
    const double least = tolerance.length * body.area;
    if (body.volume < -least)
        throw ShapeError(
            ShapeFault::not_oriented,
            fmt::format("inside out: its volume is {:g} m3; faces should be counter-clockwise seen from outside",
                        body.volume));
    if (body.volume <= least)
        throw ShapeError(
            ShapeFault::no_volume,
            fmt::format("no volume: {:g} m3 within a surface of {:g} m2 is thinner than the tolerance of {:g} m",
                        body.volume, body.area, tolerance.length));
}

// How far round-off in the corners of a small or thin face can tilt its plane, over the size of the body [m].
double tilt(const Polyhedron& body, std::size_t f, double area, const Tolerance& tolerance) {
    double perimeter = 0.0;
    for (std::size_t k = 0; k < body.face[f].size(); ++k)
        perimeter += (body.vertex[body.face[f][k]] - body.vertex[body.face[f][(k + 1) % body.face[f].size()]]).norm();
    return 4.0 * tolerance.noise * perimeter / area * tolerance.size;
}

[[noreturn]] void not_convex(std::size_t vertex, std::size_t face, double above, const Tolerance& tolerance) {
    throw ShapeError(
        ShapeFault::not_convex,
        fmt::format("not convex: vertex {} lies {:g} m outside of the plane of face {} ({:.2g} of the size; at most "
                    "{:.2g} is taken for round-off)",
                    vertex, above, face, above / tolerance.size, 4.0 * tolerance.length / tolerance.size));
}

// Neighbouring faces only, before faces are merged: merging needs a surface that bends one way.
void check_edges(const Polyhedron& body, const std::vector<ConvexShape::Edge>& edges, const Tolerance& tolerance) {
    for (const auto& edge : edges)
        for (const auto& [face, other] : {std::pair(edge.left, edge.right), std::pair(edge.right, edge.left)}) {
            const Vec3 area = area_vector(body, face);
            const double size = area.norm(), allowed = 4.0 * tolerance.length + tilt(body, face, size, tolerance);
            if (!(size > 0.0)) continue;
            for (const std::uint32_t v : body.face[other]) {
                const double above = area.dot(body.vertex[v] - body.vertex[body.face[face][0]]) / size;
                if (above > allowed) not_convex(v, face, above, tolerance);
            }
        }
}

// The planes, each so far out that no vertex lies above it; all vertices against all planes.
std::vector<ConvexShape::Face> planes_of(const Polyhedron& body, const Tolerance& tolerance) {
    std::vector<ConvexShape::Face> planes;
    std::uint32_t begin = 0;
    double thickness = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < body.face.size(); ++f) {
        const auto& loop = body.face[f];
        const Vec3 area = area_vector(body, f);
        const double size = area.norm(), allowed = 4.0 * tolerance.length + tilt(body, f, size, tolerance);
        if (!(size > 0.0))
            throw ShapeError(ShapeFault::no_volume, fmt::format("face {} has no area: its corners lie on a line", f));
        const Vec3 normal = area / size;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t v : loop) {
            low = std::min(low, normal.dot(body.vertex[v]));
            high = std::max(high, normal.dot(body.vertex[v]));
        }
        if (high - low > allowed)
            throw ShapeError(
                ShapeFault::not_planar,
                fmt::format("the {} corners of face {} are not in one plane: they lie up to {:g} m apart across "
                            "it ({:.2g} of the size)",
                            loop.size(), f, high - low, (high - low) / tolerance.size));
        double offset = high, lowest = low;
        for (std::size_t v = 0; v < body.vertex.size(); ++v) {
            const double x = normal.dot(body.vertex[v]);
            if (x > high + allowed) not_convex(v, f, x - high, tolerance);
            offset = std::max(offset, x);
            lowest = std::min(lowest, x);
        }
        thickness = std::min(thickness, offset - lowest);
        planes.push_back({normal, offset, begin, static_cast<std::uint32_t>(loop.size())});
        begin += static_cast<std::uint32_t>(loop.size());
    }
    if (thickness <= 4.0 * tolerance.length)
        throw ShapeError(
            ShapeFault::no_volume,
            fmt::format("no volume: it is {:g} m thick and {:g} m large ({:.2g}); more than {:.2g} is expected",
                        thickness, tolerance.size, thickness / tolerance.size,
                        4.0 * tolerance.length / tolerance.size));
    return planes;
}

struct BodyFrame {
    Vec3 centre;
    Mat3 axes;  // columns
    Vec3 inertia;
    double volume;
};

// Moments of inertia from the diagonal of C, in increasing order; those that are equal up to `noise` keep the order of
// the axes and share their mean.
Vec3 order_axes(const Vec3& second, double noise, Mat3& axes) {
    std::array<std::pair<double, int>, 3> moment;
    for (int k = 0; k < 3; ++k) moment[k] = {second[(k + 1) % 3] + second[(k + 2) % 3], k};
    const auto sort_by = [&moment](const auto& wrong) {
        for (const int k : {0, 1, 0})
            if (wrong(k)) std::swap(moment[k], moment[k + 1]);
    };
    sort_by([&](int k) { return moment[k].first > moment[k + 1].first; });
    const double equal = noise * moment[2].first;
    const std::array<bool, 2> same = {moment[1].first - moment[0].first <= equal,
                                      moment[2].first - moment[1].first <= equal};
    sort_by([&](int k) { return same[k] && moment[k].second > moment[k + 1].second; });
    Vec3 inertia(moment[0].first, moment[1].first, moment[2].first);
    if (same[0] && same[1])
        inertia.setConstant((inertia[0] + inertia[1] + inertia[2]) / 3.0);
    else if (same[0])
        inertia[0] = inertia[1] = 0.5 * (inertia[0] + inertia[1]);
    else if (same[1])
        inertia[1] = inertia[2] = 0.5 * (inertia[1] + inertia[2]);
    const Mat3 before = axes;
    for (int k = 0; k < 3; ++k) axes.col(k) = before.col(moment[k].second);
    for (int k = 0; k < 2; ++k) {
        const double largest = axes.col(k).cwiseAbs().maxCoeff();
        int i = 0;
        while (std::abs(axes(i, k)) < (1.0 - 1e-6) * largest) ++i;
        if (axes(i, k) < 0.0) axes.col(k) = -axes.col(k);
    }
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return inertia;
}

// In the frame of a first guess the thin directions of a needle are not lost beside the long one, so do it again there.
BodyFrame body_frame(const Polyhedron& body, const VolumeIntegrals& first, double noise) {
    Polyhedron turned = body;
    BodyFrame frame{first.centre, principal_axes(first.second, noise), Vec3::Zero(), 0.0};
    Vec3 second;
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t v = 0; v < body.vertex.size(); ++v)
            turned.vertex[v] = frame.axes.transpose() * (body.vertex[v] - frame.centre);
        const VolumeIntegrals here = volume_integrals(turned);
        frame.centre += frame.axes * here.centre;
        if (pass == 0) frame.axes = (frame.axes * principal_axes(here.second, noise)).eval();
        frame.volume = here.volume;
        second = here.second.diagonal();
    }
    // products of many rotations: back to unit vectors at right angles
    frame.axes.col(0).normalize();
    frame.axes.col(1) = (frame.axes.col(1) - frame.axes.col(0).dot(frame.axes.col(1)) * frame.axes.col(0)).normalized();
    frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
    frame.inertia = order_axes(second, noise, frame.axes);
    return frame;
}

}  // namespace

PlacedShape make_shape(const Polyhedron& given, double relative) {
    check_loops(given);
    Polyhedron body = given;
    drop_unused_vertices(body);
    const Extent extent = extent_of(body.vertex);
    const Tolerance tolerance{relative * extent.size() + 4.0 * extent.rounding(), extent.size(),
                              kEpsilon * extent.size() + extent.rounding()};
    const Vec3 reference = extent.middle();
    for (Vec3& x : body.vertex) x -= reference;

    const auto edges = edges_of(body);
    check_volume(volume_integrals(body), tolerance);
    check_edges(body, edges, tolerance);
    simplify(body, tolerance.length);
    check_loops(body);

    PlacedShape result;
    ConvexShape& shape = result.shape;
    shape.edge = edges_of(body);
    planes_of(body, tolerance);
    const double noise = 64.0 * tolerance.noise / tolerance.size;
    const BodyFrame frame = body_frame(body, volume_integrals(body), noise);
    result.centre = reference + frame.centre;
    result.rotation = Quat(frame.axes).normalized();
    for (Vec3& x : body.vertex) x = frame.axes.transpose() * (x - frame.centre);

    shape.face = planes_of(body, tolerance);
    for (const auto& loop : body.face) shape.corner.insert(shape.corner.end(), loop.begin(), loop.end());
    shape.vertex = std::move(body.vertex);
    link_vertices(shape);
    shape.volume = frame.volume;
    shape.inertia = frame.inertia;
    shape.inner_radius = std::numeric_limits<double>::infinity();
    for (const Vec3& x : shape.vertex) shape.radius = std::max(shape.radius, x.norm());
    for (const auto& face : shape.face) shape.inner_radius = std::min(shape.inner_radius, face.offset);
    return result;
}

Polyhedron polyhedron_of(const PlacedShape& placed) {
    Polyhedron body;
    for (const Vec3& x : placed.shape.vertex) body.vertex.push_back(placed.centre + placed.rotation * x);
    for (std::size_t f = 0; f < placed.shape.face.size(); ++f) {
        const auto corners = placed.shape.corners(f);
        body.face.emplace_back(corners.begin(), corners.end());
    }
    return body;
}

ConvexShape scaled(ConvexShape shape, double factor) {
    for (Vec3& x : shape.vertex) x *= factor;
    for (auto& face : shape.face) face.offset *= factor;
    shape.volume *= factor * factor * factor;
    shape.inertia *= factor * factor * factor * factor * factor;
    shape.radius *= factor;
    shape.inner_radius *= factor;
    return shape;
}

}  // namespace scree
