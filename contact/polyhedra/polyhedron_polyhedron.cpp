#include "contact/polyhedra/polyhedron_polyhedron.hpp"

#include <algorithm>

#include "contact/polyhedra/closest_points.hpp"
#include "contact/polyhedra/patch.hpp"
#include "contact/polyhedra/segments.hpp"
#include "contact/polyhedra/separating_axis.hpp"

namespace scree::contact {
namespace {

constexpr double kRoundOff = 1e-12;        // of the sizes
constexpr double kSharp = 1e-14;           // of the sizes: bounds of the gap from both sides that agree
constexpr double kLoose = 2e-10;           // of the sizes: those that leave no doubt of the normal
constexpr double kAlongFace = 1.0 - 1e-6;  // cosine: v may be the way from a face

bool less(const Vec3& x, const Vec3& y) {
    return std::lexicographical_compare(x.data(), x.data() + 3, y.data(), y.data() + 3);
}

// Whether the pair is worked on as (b, a).
bool exchanged(const Placed& a, const Placed& b) {
    const Vec3 r = a.position - b.position;
    int largest = 0;
    if (r.cwiseAbs().maxCoeff(&largest) > 0.0) return r[largest] < 0.0;
    if (a.vertex.size() != b.vertex.size()) return a.vertex.size() < b.vertex.size();
    return std::lexicographical_compare(a.vertex.begin(), a.vertex.end(), b.vertex.begin(), b.vertex.end(), less);
}

// The face that looks most nearly along `direction`.
std::size_t face_towards(const Placed& body, const Vec3& direction) {
    std::size_t best = 0;
    double most = -2.0;
    for (std::size_t f = 0; f < body.normal.size(); ++f) {
        const double cosine = body.normal[f].dot(direction);
        if (cosine > most) most = cosine, best = f;
    }
    return best;
}

// The first of the three that differs from the first one, or the first one.
std::size_t second_of(const std::array<std::uint32_t, 3>& vertices, int count) {
    for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i) {
        if (vertices[i] != vertices[0]) return i;
    }
    return 0;
}

// Every direction's separation is a lower bound of the gap: of v / |v| and the normals of the features next to it the
// one with the largest is the best.
PolyhedraGap sharpened(const Placed& a, const Placed& b, const ClosestPoints& closest) {
    const double length = closest.v.norm();
    Vec3 direction = closest.v / length;
    if (closest.corners == 2) {  // an edge of the difference: round-off must not tilt v along it
        const Vec3 d = (a.vertex[closest.on_a[1]] - a.vertex[closest.on_a[0]]) -
                       (b.vertex[closest.on_b[1]] - b.vertex[closest.on_b[0]]);
        direction = (direction - (direction.dot(d) / d.squaredNorm()) * d).normalized();
    }
    PolyhedraGap best{separation(a, b, direction), direction};
    const std::size_t i = second_of(closest.on_a, closest.corners), j = second_of(closest.on_b, closest.corners);
    if (closest.corners == 3 && i != 0 && j != 0) {
        const Vec3 d = a.vertex[closest.on_a[i]] - a.vertex[closest.on_a[0]];
        Vec3 across = d.cross(b.vertex[closest.on_b[j]] - b.vertex[closest.on_b[0]]);
        across -= (across.dot(d) / d.squaredNorm()) * d;
        if (!across.isZero(0.0)) {
            across.normalize();
            if (across.dot(direction) < 0.0) across = -across;
            const double s = separation(a, b, across);
            if (s >= best.gap) best = {s, across};
        }
    }
    // A face's normal is the cleanest: it is taken if it does as well.
    const auto attempt = [&](const Vec3& normal) {
        if (normal.dot(direction) < kAlongFace) return;
        const double s = separation(a, b, normal);
        if (s >= best.gap - kSharp * (a.shape->radius + b.shape->radius)) best = {s, normal};
    };
    attempt(-a.normal[face_towards(a, -direction)]);
    attempt(b.normal[face_towards(b, direction)]);
    return best;
}

// The shortest way from an edge of b to one of a, no longer than `v`; of those edges that can have it.
Vec3 between_edges(const Placed& a, const Placed& b, const PolyhedraGap& bound, const Vec3& v,
                   PolyhedraScratch& scratch) {
    const Vec3 r = a.position - b.position, &n = bound.normal;
    const double size = a.shape->radius + b.shape->radius;
    const double depth = v.norm() - bound.gap + kRoundOff * size;
    const double low = lowest(a, n).height + depth, high = highest(b, n).height - depth;
    const auto near = [](const Placed& body, const auto& within, std::vector<std::uint32_t>& edges) {
        edges.clear();
        for (std::uint32_t e = 0; e < body.shape->edge.size(); ++e) {
            const ConvexShape::Edge& edge = body.shape->edge[e];
            if (within(body.vertex[edge.from]) || within(body.vertex[edge.to])) edges.push_back(e);
        }
    };
    near(
        a, [&](const Vec3& x) { return n.dot(x) <= low; }, scratch.edge[0]);
    near(
        b, [&](const Vec3& x) { return n.dot(x) >= high; }, scratch.edge[1]);
    Vec3 best = v;
    for (const std::uint32_t ea : scratch.edge[0]) {
        const ConvexShape::Edge& p = a.shape->edge[ea];
        for (const std::uint32_t eb : scratch.edge[1]) {
            const ConvexShape::Edge& q = b.shape->edge[eb];
            const Vec3 way =
                detail::between_segments(a.vertex[p.from] + r, a.vertex[p.to] + r, b.vertex[q.from], b.vertex[q.to]);
            if (way.squaredNorm() < best.squaredNorm()) best = way;
        }
    }
    return best;
}

bool foot_within(const Placed& body, std::uint32_t face, const Vec3& x, double slack) {
    const std::span<const std::uint32_t> corners = body.shape->corners(face);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &p = body.vertex[corners[i]], &q = body.vertex[corners[(i + 1) % corners.size()]];
        if (body.normal[face].cross(q - p).dot(x - p) < -slack * (q - p).norm()) return false;
    }
    return true;
}

// The axis is that of a face which a nearest vertex of the other body lies over: then its separation is the gap.
bool vertex_over_face(const Placed& a, const Placed& b, const SeparatingAxis& axis) {
    const bool of_a = axis.kind == SeparatingAxis::Kind::face_of_a;
    if (!of_a && axis.kind != SeparatingAxis::Kind::face_of_b) return false;
    const Placed &body = of_a ? a : b, &other = of_a ? b : a;
    const std::uint32_t face = of_a ? axis.feature_a : axis.feature_b;
    const Vec3 r = other.position - body.position, &out = body.normal[face];
    const double size = a.shape->radius + b.shape->radius, low = lowest(other, out).height + kSharp * size;
    for (const Vec3& v : other.vertex) {
        if (out.dot(v) <= low && foot_within(body, face, v + r, kRoundOff * size)) return true;
    }
    return false;
}

PolyhedraGap ordered_gap(const Placed& a, const Placed& b, double margin, PolyhedraScratch& scratch) {
    const double size = a.shape->radius + b.shape->radius;
    const ClosestPoints closest = closest_points(a, b, margin);
    if (closest.nearness == Nearness::far) {
        const Vec3 direction = closest.v.normalized();
        return {separation(a, b, direction), direction};
    }
    const double length = closest.v.norm();
    PolyhedraGap sharp{-std::numeric_limits<double>::infinity(), Vec3::Zero()};
    if (closest.nearness == Nearness::near) {
        sharp = sharpened(a, b, closest);
        if (sharp.gap >= length - kSharp * size) return sharp;
        if (closest.bound >= length - kSharp * size && sharp.gap >= length - kLoose * size)
            return {length, sharp.normal};
    }
    const SeparatingAxis axis = separating_axis(a, b, scratch);
    if (axis.separation <= 0.0 || closest.nearness == Nearness::overlapping || vertex_over_face(a, b, axis)) {
        return {axis.separation, axis.normal};
    }
    if (axis.separation > sharp.gap) sharp = {axis.separation, axis.normal};
    // Apart, by something between this and |v|: round-off kept the simplex from its end.
    const Vec3 d = between_edges(a, b, sharp, closest.v, scratch);
    const double distance = d.norm();
    if (distance <= sharp.gap + kLoose * size) return sharp;
    // the direction of a short way may be all round-off
    const Vec3 direction = d / distance;
    return {distance, separation(a, b, direction) > sharp.gap ? direction : sharp.normal};
}

}  // namespace

PolyhedraGap polyhedra_gap(const Placed& a, const Placed& b, double margin, PolyhedraScratch& scratch) {
    if (!exchanged(a, b)) return ordered_gap(a, b, margin, scratch);
    PolyhedraGap found = ordered_gap(b, a, margin, scratch);
    found.normal = -found.normal;
    return found;
}

bool polyhedron_polyhedron(const Placed& a, const Placed& b, double margin, Vec3& axis, PolyhedraScratch& scratch,
                           Manifold& out) {
    out.count = 0, out.area = 0.0;
    const double size = a.shape->radius + b.shape->radius;
    if ((a.position - b.position).squaredNorm() > (size + margin) * (size + margin)) return false;
    // More than the margin by more than round-off: then what follows would say the same.
    if (!axis.isZero(0.0) && separation(a, b, axis) > margin + kRoundOff * size) return false;
    const bool exchange = exchanged(a, b);
    const Placed &first = exchange ? b : a, &second = exchange ? a : b;
    const PolyhedraGap found = ordered_gap(first, second, margin, scratch);
    axis = exchange ? Vec3(-found.normal) : found.normal;
    if (found.gap > margin) return false;
    contact_patch(first, second, found.normal, margin, scratch, out);
    for (ManifoldPoint& p : std::span(out.item).first(static_cast<std::size_t>(out.count))) p.point += second.position;
    // A vertex or an edge nearest to an edge, by a way so short that its direction is lost, may not lie over it along
    // the normal: the vertex that reaches farthest stands for it.
    const auto deep = [&](const ManifoldPoint& p) { return p.gap <= found.gap + kLoose * size; };
    const std::span<const ManifoldPoint> points = out.points();
    if (std::none_of(points.begin(), points.end(), deep)) {
        const std::uint32_t vertex = lowest(first, found.normal).vertex;
        const FeatureKey key = feature_key(Meeting::vertex_of_a, vertex, 0);
        const auto same = std::find_if(out.item.begin(), out.item.begin() + out.count,
                                       [&](const ManifoldPoint& p) { return p.key == key; });
        const ManifoldPoint point{first.position + first.vertex[vertex] - 0.5 * found.gap * found.normal, found.normal,
                                  found.gap, key};
        if (same != out.item.begin() + out.count) {
            *same = point;
        } else {
            out.count = std::min(out.count, Manifold::kCapacity - 1);
            out.add(point);
        }
    }
    if (exchange) {
        for (ManifoldPoint& p : std::span(out.item).first(static_cast<std::size_t>(out.count))) {
            p.normal = -p.normal, p.key = mirrored(p.key);
        }
    }
    return true;
}

}  // namespace scree::contact
