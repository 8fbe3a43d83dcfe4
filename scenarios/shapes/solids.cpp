#include "scenarios/shapes/solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::scenarios {
namespace {

void check_lengths(const char* what, std::initializer_list<double> lengths) {
    for (const double x : lengths)
        if (!(x > 0.0 && std::isfinite(x)))
            throw ShapeError(ShapeFault::no_volume,
                             fmt::format("a {} of length {:g} m, where a positive length is expected", what, x));
}

// The faces of a convex body with known corners whose faces have known normals: the corners farthest out along each,
// counter-clockwise. Corners that lie within 1e-9 of the farthest belong to the face.
Polyhedron body_of(std::vector<Vec3> corners, const std::vector<Vec3>& normals) {
    Polyhedron body{std::move(corners), {}};
    for (const Vec3& n : normals) {
        double farthest = 0.0;
        for (const Vec3& x : body.vertex) farthest = std::max(farthest, n.dot(x));
        std::vector<std::uint32_t> loop;
        Vec3 middle = Vec3::Zero();
        for (std::uint32_t v = 0; v < body.vertex.size(); ++v) {
            if (n.dot(body.vertex[v]) < (1.0 - 1e-9) * farthest) continue;
            loop.push_back(v);
            middle += body.vertex[v];
        }
        middle /= static_cast<double>(loop.size());
        const Vec3 s = body.vertex[loop[0]] - middle, t = n.cross(s) / n.norm();
        const auto angle = [&](std::uint32_t v) {
            const double a = std::atan2(t.dot(body.vertex[v] - middle), s.dot(body.vertex[v] - middle));
            return a < -1e-9 ? a + 2.0 * std::numbers::pi : a;
        };
        std::sort(loop.begin(), loop.end(), [&](auto a, auto b) { return angle(a) < angle(b); });
        body.face.push_back(loop);
    }
    return body;
}

// All (+-x, +-y, +-z), without repetitions.
void add_signs(const Vec3& x, std::vector<Vec3>& points) {
    for (int k = 0; k < 8; ++k) {
        bool twice = false;
        for (int i = 0; i < 3; ++i) twice = twice || ((k >> i & 1) != 0 && x[i] == 0.0);
        if (!twice) points.emplace_back(k & 1 ? -x[0] : x[0], k & 2 ? -x[1] : x[1], k & 4 ? -x[2] : x[2]);
    }
}
// The same for (x, y, z), (y, z, x) and (z, x, y).
std::vector<Vec3> cycled(std::initializer_list<Vec3> given) {
    std::vector<Vec3> points;
    for (const Vec3& x : given)
        for (int k = 0; k < (x[0] == x[1] && x[1] == x[2] ? 1 : 3); ++k)
            add_signs(Vec3(x[k], x[(k + 1) % 3], x[(k + 2) % 3]), points);
    return points;
}

const std::vector<Vec3>& cube_corners() {
    static const std::vector<Vec3> corners = cycled({Vec3(1, 1, 1)});
    return corners;
}
const std::vector<Vec3>& axes() {
    static const std::vector<Vec3> normals = cycled({Vec3(1, 0, 0)});
    return normals;
}

// With the faces of one along the corners of its dual; the edge of each below.
Polyhedron unit_platonic(Platonic solid) {
    using std::numbers::phi;
    const std::vector<Vec3> twelve = cycled({Vec3(0, 1, phi)});
    const std::vector<Vec3> twenty = cycled({Vec3(1, 1, 1), Vec3(0, phi, 1.0 / phi)});
    switch (solid) {
        case Platonic::tetrahedron:
            return body_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                           {{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}});
        case Platonic::cube:
            return body_of(cube_corners(), axes());
        case Platonic::octahedron:
            return body_of(axes(), cube_corners());
        case Platonic::dodecahedron:
            return body_of(twenty, twelve);
        case Platonic::icosahedron:
            return body_of(twelve, twenty);
    }
    return {};
}
double unit_edge(Platonic solid) {
    switch (solid) {
        case Platonic::tetrahedron:
            return 2.0 * std::numbers::sqrt2;
        case Platonic::octahedron:
            return std::numbers::sqrt2;
        case Platonic::dodecahedron:
            return 2.0 / std::numbers::phi;
        default:
            return 2.0;
    }
}

PlacedShape stretched(Polyhedron body, const Vec3& factor) {
    for (Vec3& x : body.vertex) x = x.cwiseProduct(factor);
    return make_shape(body);
}

}  // namespace

PlacedShape box(const Vec3& size) {
    check_lengths("box", {size.x(), size.y(), size.z()});
    return stretched(body_of(cube_corners(), axes()), 0.5 * size);
}

PlacedShape prism(int sides, double diameter, double length) {
    check_lengths("prism", {diameter, length});
    if (sides < 3)
        throw ShapeError(ShapeFault::too_few,
                         fmt::format("a prism with {} sides, where at least 3 are expected", sides));
    std::vector<Vec3> corners, normals = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
    for (int k = 0; k < sides; ++k) {
        const double corner = 2.0 * std::numbers::pi * k / sides, side = 2.0 * std::numbers::pi * (k + 0.5) / sides;
        for (const double z : {-1.0, 1.0}) corners.emplace_back(std::cos(corner), std::sin(corner), z);
        normals.emplace_back(std::cos(side), std::sin(side), 0.0);
    }
    return stretched(body_of(corners, normals), 0.5 * Vec3(diameter, diameter, length));
}

PlacedShape platonic(Platonic solid, double edge) {
    check_lengths("regular solid", {edge});
    return stretched(unit_platonic(solid), Vec3::Constant(edge / unit_edge(solid)));
}

PlacedShape eota_block(const Vec3& sides) {
    check_lengths("block", {sides.x(), sides.y(), sides.z()});
    const std::vector<Vec3> corners = cycled({Vec3(2, 1, 1)});
    return stretched(body_of(corners, cycled({Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)})), 0.25 * sides);
}

Polyhedron box_between(const Vec3& lower, const Vec3& upper) {
    check_lengths("box", {upper.x() - lower.x(), upper.y() - lower.y(), upper.z() - lower.z()});
    Polyhedron body = body_of(cube_corners(), axes());
    for (Vec3& x : body.vertex)
        for (int i = 0; i < 3; ++i) x[i] = x[i] < 0.0 ? lower[i] : upper[i];
    return body;
}

PlacedShape with_volume(PlacedShape placed, double volume) {
    const double factor = std::cbrt(volume / placed.shape.volume);
    placed.centre *= factor;
    placed.shape = scaled(std::move(placed.shape), factor);
    return placed;
}

double ball_volume(double diameter) {
    return std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

}  // namespace scree::scenarios
