#include "core/simplify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace scree {
namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
using Loops = std::vector<std::vector<std::uint32_t>>;

[[noreturn]] void vanished(double tolerance) {
    throw ShapeError(ShapeFault::no_volume,
                     fmt::format("nothing is left when parts thinner than {:g} m vanish", tolerance));
}

// Joins the ends of short edges: the vertex with the lower number stays where it is.
void weld(Polyhedron& body, double tolerance) {
    std::vector<std::uint32_t> root(body.vertex.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&root](std::uint32_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    bool any = false;
    for (const auto& loop : body.face)
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
            if ((body.vertex[a] - body.vertex[b]).norm() > tolerance) continue;
            const std::uint32_t low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
            root[high] = low;
            any = true;
        }
    if (!any) return;
    for (auto& loop : body.face) {
        for (std::uint32_t& v : loop) v = find(v);
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    }
    // A face with two corners left is an edge: its two neighbours now share it.
    std::erase_if(body.face, [](const auto& loop) { return loop.size() < 3; });
    if (body.face.size() < 4) vanished(tolerance);
}

// Which faces become one: grown from the largest face that is left, over neighbours that lie in its plane.
class Regions {
  public:
    Regions(const Polyhedron& body, const std::vector<ConvexShape::Edge>& edges, double tolerance)
        : body_(body),
          tolerance_(tolerance),
          neighbours_(body.face.size()),
          area_(body.face.size()),
          thin_(body.face.size()),
          of_(body.face.size(), kNone) {
        for (const auto& edge : edges) {
            neighbours_[edge.left].push_back(edge.right);
            neighbours_[edge.right].push_back(edge.left);
        }
        std::vector<std::uint32_t> order(body.face.size());
        std::vector<double> size(body.face.size());
        for (std::size_t f = 0; f < size.size(); ++f) {
            area_[f] = area_vector(body, f);
            size[f] = area_[f].norm();
            thin_[f] = 2.0 * size[f] <= tolerance * longest_side(f);
        }
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] > size[b]; });
        for (const std::uint32_t seed : order)
            if (of_[seed] == kNone) claim(seed);
    }

    const std::vector<std::uint32_t>& of() const { return of_; }  // face -> region
    std::uint32_t count() const { return count_; }

  private:
    struct Plane {
        Vec3 normal;
        double offset;
    };

    double longest_side(std::size_t f) const {
        const auto& loop = body_.face[f];
        double longest = 0.0;
        for (std::size_t k = 0; k < loop.size(); ++k)
            longest = std::max(longest, (body_.vertex[loop[k]] - body_.vertex[loop[(k + 1) % loop.size()]]).norm());
        return longest;
    }

    // In the middle between the corners that lie highest and lowest above it.
    Plane fit(const std::vector<std::uint32_t>& faces) const {
        Vec3 sum = Vec3::Zero();
        for (const std::uint32_t f : faces) sum += area_[f];
        const Vec3 normal = sum.normalized();
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t f : faces)
            for (const std::uint32_t v : body_.face[f]) {
                low = std::min(low, normal.dot(body_.vertex[v]));
                high = std::max(high, normal.dot(body_.vertex[v]));
            }
        return {normal, 0.5 * (low + high)};
    }

    // A face thinner than the tolerance has no normal worth asking.
    bool lies_in(std::uint32_t f, const Plane& plane) const {
        if (!thin_[f] && area_[f].dot(plane.normal) <= 0.0) return false;
        return std::all_of(body_.face[f].begin(), body_.face[f].end(), [&](std::uint32_t v) {
            return std::abs(plane.normal.dot(body_.vertex[v]) - plane.offset) <= tolerance_;
        });
    }

    std::vector<std::uint32_t> grown(std::uint32_t seed, const Plane& plane) {
        std::vector<std::uint32_t> faces = {seed};
        of_[seed] = count_;
        for (std::size_t k = 0; k < faces.size(); ++k)
            for (const std::uint32_t next : neighbours_[faces[k]]) {
                if (of_[next] != kNone || !lies_in(next, plane)) continue;
                of_[next] = count_;
                faces.push_back(next);
            }
        return faces;
    }

    // A small seed tells the plane of a large noisy face badly: fit it to all that was found, and look again.
    void claim(std::uint32_t seed) {
        constexpr int kFits = 8;
        std::vector<std::uint32_t> faces = {seed};
        for (int fits = 0; fits < kFits && !thin_[seed]; ++fits) {
            std::vector<std::uint32_t> more = grown(seed, fit(faces));
            for (const std::uint32_t f : more) of_[f] = kNone;
            if (more.size() <= faces.size()) break;
            faces = std::move(more);
        }
        for (const std::uint32_t f : faces) of_[f] = count_;
        ++count_;
    }

    const Polyhedron& body_;
    double tolerance_;
    std::vector<std::vector<std::uint32_t>> neighbours_;  // of each face
    std::vector<Vec3> area_;                              // [m2] area vector of each face
    std::vector<bool> thin_;
    std::vector<std::uint32_t> of_;
    std::uint32_t count_ = 0;
};

// The loop around each region: edges between two regions, end to end.
Loops outlines(const std::vector<ConvexShape::Edge>& edges, const Regions& regions) {
    struct Side {
        std::uint32_t region, from, to;
    };
    std::vector<Side> sides;
    for (const auto& edge : edges) {
        const std::uint32_t left = regions.of()[edge.left], right = regions.of()[edge.right];
        if (left == right) continue;
        sides.push_back({left, edge.from, edge.to});
        sides.push_back({right, edge.to, edge.from});
    }
    const auto before = [](const Side& a, const Side& b) {
        return std::tuple(a.region, a.from) < std::tuple(b.region, b.from);
    };
    std::sort(sides.begin(), sides.end(), before);
    Loops loops(regions.count());
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        const std::uint32_t region = sides[begin].region;
        while (end < sides.size() && sides[end].region == region) ++end;
        auto& loop = loops[region];
        std::uint32_t at = sides[begin].from;
        do {
            loop.push_back(at);
            at = std::lower_bound(sides.begin(), sides.end(), Side{region, at, 0}, before)->to;
        } while (at != loop.front() && loop.size() <= end - begin);
        if (loop.size() != end - begin)
            throw ShapeError(ShapeFault::not_convex, "not convex: a plane face of it has a hole, or touches itself");
    }
    return loops;
}

// A corner where only two faces meet lies on the line between its neighbours, up to the tolerance. A face left with two
// corners is that line.
void drop_flat_corners(Polyhedron& body, double tolerance) {
    std::vector<std::uint32_t> faces_at(body.vertex.size(), 0);
    for (const auto& loop : body.face)
        for (const std::uint32_t v : loop) ++faces_at[v];
    for (bool again = true; again;) {
        again = false;
        for (auto& loop : body.face) std::erase_if(loop, [&](std::uint32_t v) { return faces_at[v] == 2; });
        for (std::uint32_t& faces : faces_at)
            if (faces == 2) faces = 0;
        std::erase_if(body.face, [&](const auto& loop) {
            if (loop.size() > 2) return false;
            for (const std::uint32_t v : loop) --faces_at[v];
            again = true;
            return true;
        });
    }
    if (body.face.size() < 4) vanished(tolerance);
}

// Faces begin with their lowest vertex and come in order: whichever triangles a face was merged from, it is the same.
void put_in_order(Loops& loops) {
    for (auto& loop : loops) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    std::sort(loops.begin(), loops.end());
}

}  // namespace

void simplify(Polyhedron& body, double tolerance) {
    weld(body, tolerance);
    const auto edges = edges_of(body);
    const Regions regions(body, edges, tolerance);
    if (regions.count() < 4) vanished(tolerance);
    const bool merged = regions.count() < body.face.size();
    if (merged) body.face = outlines(edges, regions);
    drop_flat_corners(body, tolerance);
    if (merged) put_in_order(body.face);
    drop_unused_vertices(body);
}

}  // namespace scree
