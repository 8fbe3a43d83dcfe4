#include "contact/polyhedra/patch.hpp"

#include <algorithm>

#include "contact/polyhedra/corners.hpp"

namespace scree::contact {
namespace {

using detail::Corner;
using detail::Corners;
using SlabVertex = PolyhedraScratch::SlabVertex;
using SlabEdge = PolyhedraScratch::SlabEdge;
using SlabFace = PolyhedraScratch::SlabFace;

constexpr double kSteep = 1e-3;  // cosine: faces nearly along the normal are borders, with some round-off allowed
constexpr double kUpright = 1e-12;
constexpr double kRoundOff = 1e-12;  // of the sizes

struct Axes {
    Vec3 u, v, n;

    explicit Axes(const Vec3& normal) : n(normal) {
        int smallest = 0;
        normal.cwiseAbs().minCoeff(&smallest);
        u = (Vec3::Unit(smallest) - normal[smallest] * normal).normalized();
        v = normal.cross(u);
    }
    Vec3 of(const Vec3& x) const { return {u.dot(x), v.dot(x), n.dot(x)}; }
};

// The part of a body that faces the other one and lies no farther than `depth` from its extreme vertex.
struct Slab {
    std::vector<SlabVertex>& vertex;
    std::vector<SlabEdge>& edge;
    std::vector<SlabFace>& face;
};

// `facing` points at the other body, `shift` is the body's position, `heights` those of its vertices along `facing`.
void cut(const Placed& body, const Axes& axes, const Vec3& facing, const Vec3& shift, double depth,
         const std::vector<double>& heights, std::vector<std::uint8_t>& face_used, Slab out) {
    out.vertex.clear(), out.edge.clear(), out.face.clear();
    const double floor = *std::max_element(heights.begin(), heights.end()) - depth;
    for (std::uint32_t i = 0; i < heights.size(); ++i) {
        if (heights[i] >= floor) out.vertex.push_back({i, axes.of(body.vertex[i] + shift)});
    }
    face_used.assign(body.normal.size(), 0);
    const std::vector<ConvexShape::Edge>& edge = body.shape->edge;
    for (std::uint32_t e = 0; e < edge.size(); ++e) {
        if (heights[edge[e].from] < floor && heights[edge[e].to] < floor) continue;
        face_used[edge[e].left] = face_used[edge[e].right] = 1;
        if (body.normal[edge[e].left].dot(facing) <= kUpright && body.normal[edge[e].right].dot(facing) <= kUpright) {
            continue;
        }
        out.edge.push_back({e, axes.of(body.vertex[edge[e].from] + shift), axes.of(body.vertex[edge[e].to] + shift)});
    }
    for (std::size_t f = 0; f < face_used.size(); ++f) {
        if (face_used[f] == 0) continue;
        const Vec3 normal = axes.of(body.normal[f]);
        out.face.push_back({normal, body.offset(f) + body.normal[f].dot(shift), body.normal[f].dot(facing)});
    }
}

// How far x is from the faces, along the direction in which they face the other body, negative if it lies behind them;
// infinite if the line through x passes by.
double distance_along(const std::vector<SlabFace>& faces, const Vec3& x, double round_off) {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (const SlabFace& face : faces) {
        const double above = face.normal.dot(x) - face.offset;
        if (face.slope > kSteep) {
            enter = std::max(enter, above / face.slope);
        } else if (face.slope > kUpright) {
            enter = std::max(enter, (above - round_off) / face.slope);
        } else if (face.slope < -kUpright) {
            leave = std::min(leave, (above - round_off) / face.slope);
        } else if (above > round_off) {
            return std::numeric_limits<double>::infinity();
        }
    }
    return enter <= leave + round_off ? enter : std::numeric_limits<double>::infinity();
}

// The kind of place that a corner is, the first one in the order of Meeting that is near enough.
class Names {
  public:
    Names(const std::vector<SlabVertex>& of_a, const std::vector<SlabVertex>& of_b, double same)
        : of_a_(of_a), of_b_(of_b), same_square_(same * same) {}

    FeatureKey of(const Vec3& at, FeatureKey otherwise) const {
        for (const SlabVertex& p : of_a_) {
            if (near(p.at, at)) return feature_key(Meeting::vertex_of_a, p.vertex, 0);
        }
        for (const SlabVertex& p : of_b_) {
            if (near(p.at, at)) return feature_key(Meeting::vertex_of_b, 0, p.vertex);
        }
        return otherwise;
    }

    double same_square() const { return same_square_; }

  private:
    bool near(const Vec3& x, const Vec3& y) const { return (x - y).head<2>().squaredNorm() <= same_square_; }

    const std::vector<SlabVertex>&of_a_, &of_b_;
    double same_square_;
};

void crossings(const std::vector<SlabEdge>& of_a, const std::vector<SlabEdge>& of_b, double margin, const Names& names,
               Corners& out) {
    constexpr double kLow = -1e-12, kHigh = 1.0 + 1e-12;  // an end on the other edge is a vertex over a face as well
    for (const SlabEdge& p : of_a) {
        const Vec3 d = p.to - p.from;
        const double square = d.x() * d.x() + d.y() * d.y();
        for (const SlabEdge& q : of_b) {
            const Vec3 e = q.to - q.from, f = q.from - p.from;
            const double det = d.x() * e.y() - d.y() * e.x();
            const double square_e = e.x() * e.x() + e.y() * e.y();
            if (det * det <= 1e-24 * square * square_e) continue;
            const double s = (f.x() * e.y() - f.y() * e.x()) / det, t = (f.x() * d.y() - f.y() * d.x()) / det;
            if (s < kLow || s > kHigh || t < kLow || t > kHigh) continue;
            const Vec3 on_a = p.from + s * d, on_b = q.from + t * e;
            const double gap = on_a.z() - on_b.z();
            if (gap > margin) continue;
            const bool shallow = det * det <= 4.0 * names.same_square() * std::max(square, square_e);
            out.add({on_a.x(), on_a.y(), 0.5 * (on_a.z() + on_b.z()), gap,
                     names.of(on_a, feature_key(Meeting::edges, p.edge, q.edge)), shallow});
        }
    }
}

}  // namespace

void contact_patch(const Placed& a, const Placed& b, const Vec3& normal, double margin, PolyhedraScratch& scratch,
                   Manifold& out) {
    out.count = 0, out.area = 0.0;
    const Vec3 r = a.position - b.position, down = -normal;
    const double size = a.shape->radius + b.shape->radius, round_off = kRoundOff * size;
    const Axes axes(normal);
    const auto heights = [](const Placed& body, const Vec3& along, std::vector<double>& into) {
        into.resize(body.vertex.size());
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < into.size(); ++i) {
            into[i] = along.dot(body.vertex[i]);
            most = std::max(most, into[i]);
        }
        return most;
    };
    // Both surfaces come within the margin of one another only this far below their extremes.
    const double lowest_of_a = normal.dot(r) - heights(a, down, scratch.height[0]);
    const double highest_of_b = heights(b, normal, scratch.height[1]);
    const double depth = margin - (lowest_of_a - highest_of_b) + round_off;
    if (depth < 0.0) return;
    const Slab slab_a{scratch.slab_vertex[0], scratch.slab_edge[0], scratch.slab_face[0]};
    const Slab slab_b{scratch.slab_vertex[1], scratch.slab_edge[1], scratch.slab_face[1]};
    cut(a, axes, down, r, depth, scratch.height[0], scratch.face_used, slab_a);
    cut(b, axes, normal, Vec3::Zero(), depth, scratch.height[1], scratch.face_used, slab_b);

    const double same = kSameCorner * std::min(a.shape->radius, b.shape->radius);
    const Names names(slab_a.vertex, slab_b.vertex, same);
    Corners corners(same, margin);
    for (const SlabVertex& p : slab_a.vertex) {
        const double gap = distance_along(slab_b.face, p.at, round_off);
        if (gap > margin) continue;
        corners.add({p.at.x(), p.at.y(), p.at.z() - 0.5 * gap, gap, names.of(p.at, 0)});
    }
    for (const SlabVertex& p : slab_b.vertex) {
        const double gap = distance_along(slab_a.face, p.at, round_off);
        if (gap > margin) continue;
        corners.add({p.at.x(), p.at.y(), p.at.z() + 0.5 * gap, gap, names.of(p.at, 0)});
    }
    crossings(slab_a.edge, slab_b.edge, margin, names, corners);
    corners.straighten(round_off);
    corners.reduce(Manifold::kCapacity);
    out.area = corners.hull_area();
    for (int i = 0; i < corners.size(); ++i) {
        const Corner& c = corners[i];
        out.add({c.u * axes.u + c.v * axes.v + c.height * axes.n, normal, c.gap, c.key});
    }
}

}  // namespace scree::contact
