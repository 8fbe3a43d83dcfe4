#include "core/polyhedron.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace scree {
namespace {

struct Side {
    std::uint32_t from, to, face;

    std::uint32_t low() const { return std::min(from, to); }
    std::uint32_t high() const { return std::max(from, to); }
    bool same_edge(const Side& other) const { return low() == other.low() && high() == other.high(); }
};

std::vector<Side> sides_of(const Polyhedron& body) {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < body.face.size(); ++f) {
        const auto& loop = body.face[f];
        for (std::size_t k = 0; k < loop.size(); ++k) sides.push_back({loop[k], loop[(k + 1) % loop.size()], f});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tuple(a.low(), a.high(), a.from, a.face) < std::tuple(b.low(), b.high(), b.from, b.face);
    });
    return sides;
}

void check_connected(const Polyhedron& body, const std::vector<ConvexShape::Edge>& edges) {
    std::vector<std::uint32_t> root(body.face.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&root](std::uint32_t f) {
        while (root[f] != f) f = root[f] = root[root[f]];
        return f;
    };
    std::size_t parts = root.size();
    for (const auto& edge : edges) {
        const std::uint32_t a = find(edge.left), b = find(edge.right);
        if (a == b) continue;
        root[std::max(a, b)] = std::min(a, b);
        --parts;
    }
    if (parts != 1)
        throw ShapeError(ShapeFault::not_connected,
                         fmt::format("not connected: its {} faces make up {} separate surfaces, where one is expected",
                                     body.face.size(), parts));
}

// Also finds surfaces that touch themselves in a vertex: each such vertex counts once where a ball would have two.
void check_ball(const Polyhedron& body, std::size_t edges) {
    std::vector<std::uint8_t> used(body.vertex.size(), 0);
    for (const auto& loop : body.face)
        for (const std::uint32_t v : loop) used[v] = 1;
    const auto vertices = std::accumulate(used.begin(), used.end(), std::int64_t{0});
    const std::int64_t euler =
        vertices - static_cast<std::int64_t>(edges) + static_cast<std::int64_t>(body.face.size());
    if (euler != 2)
        throw ShapeError(ShapeFault::not_manifold,
                         fmt::format("not the surface of a ball: {} vertices - {} edges + {} faces = {}, where 2 is "
                                     "expected (it has a hole through it, or touches itself)",
                                     vertices, edges, body.face.size(), euler));
}

}  // namespace

const char* name_of(ShapeFault fault) {
    switch (fault) {
        case ShapeFault::not_finite:
            return "not finite";
        case ShapeFault::too_few:
            return "too few points";
        case ShapeFault::bad_face:
            return "bad face";
        case ShapeFault::not_closed:
            return "not closed";
        case ShapeFault::not_oriented:
            return "not oriented";
        case ShapeFault::not_manifold:
            return "not manifold";
        case ShapeFault::not_connected:
            return "not connected";
        case ShapeFault::self_crossing:
            return "self-crossing";
        case ShapeFault::not_planar:
            return "not planar";
        case ShapeFault::not_convex:
            return "not convex";
        case ShapeFault::no_volume:
            return "no volume";
    }
    return "";
}

void check_loops(const Polyhedron& body) {
    for (std::size_t v = 0; v < body.vertex.size(); ++v)
        if (!body.vertex[v].allFinite())
            throw ShapeError(ShapeFault::not_finite, fmt::format("vertex {} has a coordinate that is not finite", v));
    if (body.vertex.size() < 4 || body.face.size() < 4)
        throw ShapeError(ShapeFault::too_few,
                         fmt::format("{} vertices and {} faces, where at least 4 of each are expected",
                                     body.vertex.size(), body.face.size()));
    for (std::size_t f = 0; f < body.face.size(); ++f) {
        std::vector<std::uint32_t> sorted = body.face[f];
        std::sort(sorted.begin(), sorted.end());
        if (sorted.size() < 3)
            throw ShapeError(ShapeFault::bad_face,
                             fmt::format("face {} has {} corners, where at least 3 are expected", f, sorted.size()));
        if (sorted.back() >= body.vertex.size())
            throw ShapeError(ShapeFault::bad_face, fmt::format("face {} names vertex {}, but there are only {}", f,
                                                               sorted.back(), body.vertex.size()));
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        if (twice != sorted.end())
            throw ShapeError(ShapeFault::bad_face, fmt::format("face {} has vertex {} more than once", f, *twice));
    }
}

std::vector<ConvexShape::Edge> edges_of(const Polyhedron& body) {
    const std::vector<Side> sides = sides_of(body);
    std::vector<ConvexShape::Edge> edges;
    std::size_t open = 0;
    for (std::size_t k = 0, next = 0; k < sides.size(); k = next) {
        next = k + 1;
        while (next < sides.size() && sides[next].same_edge(sides[k])) ++next;
        const Side& a = sides[k];
        if (next - k > 2)
            throw ShapeError(
                ShapeFault::not_manifold,
                fmt::format("the edge between vertices {} and {} belongs to {} faces, where 2 are expected", a.low(),
                            a.high(), next - k));
        if (next - k == 1) {
            ++open;
            continue;
        }
        const Side& b = sides[k + 1];
        if (a.from == b.from)
            throw ShapeError(ShapeFault::not_oriented,
                             fmt::format("faces {} and {} go the same way along the edge from vertex {} to {}: one of "
                                         "them is inside out",
                                         a.face, b.face, a.from, a.to));
        edges.push_back({a.from, a.to, a.face, b.face});
    }
    if (open > 0)
        throw ShapeError(ShapeFault::not_closed,
                         fmt::format("not closed: {} of its {} edges belong to one face only, where 2 are expected",
                                     open, open + edges.size()));
    check_connected(body, edges);
    check_ball(body, edges.size());
    return edges;
}

void drop_unused_vertices(Polyhedron& body) {
    constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(body.vertex.size(), kUnused);
    for (const auto& loop : body.face)
        for (const std::uint32_t v : loop) place[v] = 0;
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
        if (place[v] == kUnused) continue;
        body.vertex[count] = body.vertex[v];
        place[v] = count++;
    }
    body.vertex.resize(count);
    for (auto& loop : body.face)
        for (std::uint32_t& v : loop) v = place[v];
}

Vec3 area_vector(const Polyhedron& body, std::size_t face) {
    const auto& loop = body.face[face];
    const Vec3& first = body.vertex[loop[0]];
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 2; k < loop.size(); ++k)
        sum += (body.vertex[loop[k - 1]] - first).cross(body.vertex[loop[k]] - first);
    return 0.5 * sum;
}

Extent extent_of(const std::vector<Vec3>& points) {
    Extent extent{points.front(), points.front()};
    for (const Vec3& x : points) {
        extent.lower = extent.lower.cwiseMin(x);
        extent.upper = extent.upper.cwiseMax(x);
    }
    return extent;
}

double Extent::rounding() const {
    const double farthest = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
    return std::numeric_limits<double>::epsilon() * farthest;
}

}  // namespace scree
