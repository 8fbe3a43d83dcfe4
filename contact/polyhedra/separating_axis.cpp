#include "contact/polyhedra/separating_axis.hpp"

#include <algorithm>

#include "contact/polyhedra/gauss_map.hpp"

namespace scree::contact {
namespace {

using Kind = SeparatingAxis::Kind;

constexpr std::size_t kMaskBits = 64;  // faces that can rule out edges

// Faces of `of` against the vertices of `other`, whose centre is at `r` from that of `of`. The rows of heights of the
// first faces that had a chance stay in `row`; returns how many.
std::size_t faces(const Placed& of, const Placed& other, const Vec3& r, bool of_a, std::vector<double>& row,
                  SeparatingAxis& best) {
    const std::size_t vertices = other.vertex.size();
    if (row.size() < kMaskBits * vertices) row.resize(kMaskBits * vertices);
    std::size_t rows = 0;
    for (std::uint32_t f = 0; f < of.normal.size(); ++f) {
        const Vec3 normal = of.normal[f];
        const double centre = normal.dot(r) - of.offset(f);
        if (centre - other.shape->inner_radius < best.separation) continue;
        double* heights = row.data() + rows * vertices;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t v = 0; v < vertices; ++v) {
            heights[v] = centre + normal.dot(other.vertex[v]);
            least = heights[v] < least ? heights[v] : least;
        }
        if (rows + 1 < kMaskBits) ++rows;
        if (least > best.separation) {
            best = {of_a ? Vec3(-normal) : normal, least, of_a ? Kind::face_of_a : Kind::face_of_b, f, f};
        }
    }
    return rows;
}

// Edges of `body` that come within `reach` of the other one, as far as the rows tell.
void edges_near(const Placed& body, const std::vector<double>& row, std::size_t rows, double reach,
                std::vector<std::uint64_t>& outside, std::vector<std::uint32_t>& near) {
    const std::size_t vertices = body.vertex.size();
    outside.assign(vertices, 0);
    for (std::size_t f = 0; f < rows; ++f) {
        const double* heights = row.data() + f * vertices;
        for (std::size_t v = 0; v < vertices; ++v) {
            outside[v] |= static_cast<std::uint64_t>(heights[v] > reach) << f;
        }
    }
    near.clear();
    const std::vector<ConvexShape::Edge>& edge = body.shape->edge;
    for (std::uint32_t e = 0; e < edge.size(); ++e) {
        if ((outside[edge[e].from] & outside[edge[e].to]) == 0) near.push_back(e);
    }
}

void edge_pairs(const Placed& a, const Placed& b, const Vec3& r, const PolyhedraScratch& scratch,
                SeparatingAxis& best) {
    for (const std::uint32_t ea : scratch.edge[0]) {
        const detail::Arc arc_a(a, ea);
        for (const std::uint32_t eb : scratch.edge[1]) {
            const detail::Arc arc_b(b, eb);
            if (!detail::cross(arc_a, arc_b)) continue;
            Vec3 normal;
            if (!detail::across_edges(arc_a, arc_b, normal)) continue;
            normal = -normal;
            if (normal.dot(arc_a.point + r - arc_b.point) <= best.separation) continue;
            // What round-off made of an arc's end must not pass for a separation: the supports decide.
            const double s = separation(a, b, normal);
            if (s > best.separation) best = {normal, s, Kind::edges, ea, eb};
        }
    }
}

}  // namespace

SeparatingAxis separating_axis(const Placed& a, const Placed& b, PolyhedraScratch& scratch) {
    const Vec3 r = a.position - b.position;
    const double size = a.shape->radius + b.shape->radius;
    // Any direction bounds the answer from below; the line of centres is a good one.
    const double distance = r.norm();
    const Vec3 between = distance > 1e-12 * size ? Vec3(r / distance) : Vec3::UnitX();
    SeparatingAxis best{between, separation(a, b, between) - 1e-12 * size, Kind::centres, 0, 0};
    const std::size_t rows_of_a = faces(a, b, -r, true, scratch.row[1], best);
    const std::size_t rows_of_b = faces(b, a, r, false, scratch.row[0], best);
    const double reach = std::abs(best.separation) + 1e-12 * size;
    edges_near(a, scratch.row[0], rows_of_b, reach, scratch.outside[0], scratch.edge[0]);
    edges_near(b, scratch.row[1], rows_of_a, reach, scratch.outside[1], scratch.edge[1]);
    edge_pairs(a, b, r, scratch, best);
    return best;
}

}  // namespace scree::contact
