#include "contact/polyhedra/polyhedron_polyhedron.hpp"

#include <algorithm>

#include "contact/polyhedra/closest_points.hpp"
#include "contact/polyhedra/patch.hpp"
#include "contact/polyhedra/separating_axis.hpp"

namespace scree::contact {
namespace {

constexpr double kRoundOff = 1e-12;        // of the sizes
constexpr double kSharp = 1e-14;           // of the sizes: bounds of the gap from both sides that agree
constexpr double kAlongFace = 1.0 - 1e-6;  // cosine: v may be the way from a face
constexpr double kShort = 1e-6;            // of the sizes: the direction of a shorter v is not asked without need

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

PolyhedraGap ordered_gap(const Placed& a, const Placed& b, double margin, PolyhedraScratch& scratch) {
    const double size = a.shape->radius + b.shape->radius;
    const ClosestPoints closest = closest_points(a, b, margin);
    if (closest.nearness == Nearness::far) {
        const Vec3 direction = closest.v.normalized();
        return {separation(a, b, direction), direction};
    }
    if (closest.nearness == Nearness::near) {
        const PolyhedraGap sharp = sharpened(a, b, closest);
        const double length = closest.v.norm();
        if (sharp.gap >= length - kSharp * size) return sharp;
        if (length > kShort * size) return {length, sharp.normal};
        const SeparatingAxis axis = separating_axis(a, b, scratch);
        if (axis.separation >= length - kSharp * size) return {axis.separation, axis.normal};
        return {length, axis.separation > sharp.gap ? axis.normal : sharp.normal};
    }
    const SeparatingAxis axis = separating_axis(a, b, scratch);
    return {axis.separation, axis.normal};
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
    if (out.count == 0) {  // round-off at a border hid the corner
        const std::uint32_t vertex = lowest(first, found.normal).vertex;
        out.add({first.position + first.vertex[vertex] - 0.5 * found.gap * found.normal, found.normal, found.gap,
                 feature_key(Meeting::vertex_of_a, vertex, 0)});
    }
    if (exchange) {
        for (ManifoldPoint& p : std::span(out.item).first(static_cast<std::size_t>(out.count))) {
            p.normal = -p.normal, p.key = mirrored(p.key);
        }
    }
    return true;
}

}  // namespace scree::contact
