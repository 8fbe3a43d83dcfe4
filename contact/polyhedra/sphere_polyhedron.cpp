#include "contact/polyhedra/sphere_polyhedron.hpp"

#include <cmath>

namespace scree::contact {
namespace {

// x, from the body's centre, has its foot on face f within the polygon.
bool over_face(const Placed& body, std::size_t f, const Vec3& x) {
    const std::span<const std::uint32_t> corners = body.shape->corners(f);
    const Vec3* from = &body.vertex[corners.back()];
    for (const std::uint32_t c : corners) {
        const Vec3* to = &body.vertex[c];
        if (body.normal[f].cross(*to - *from).dot(x - *from) < 0.0) return false;
        from = to;
    }
    return true;
}

// A centre on the feature itself has no direction of its own: the mean of the normals of the faces that meet there.
Vec3 mean_normal(const Placed& body, std::uint32_t e, Region region, std::uint32_t vertex) {
    if (region == Region::edge) {
        const ConvexShape::Edge& edge = body.shape->edge[e];
        return (body.normal[edge.left] + body.normal[edge.right]).normalized();
    }
    Vec3 sum = Vec3::Zero();
    for (const ConvexShape::Edge& edge : body.shape->edge) {
        if (edge.from == vertex) sum += body.normal[edge.left];
        if (edge.to == vertex) sum += body.normal[edge.right];
    }
    return sum.normalized();
}

}  // namespace

SpherePolyhedronGap sphere_polyhedron(const Vec3& centre, double radius, const Placed& body) {
    const ConvexShape& shape = *body.shape;
    const Vec3 x = centre - body.position;
    const auto height = [&](std::size_t f) { return body.normal[f].dot(x) - body.offset(f); };

    std::uint32_t face = 0;
    double above = height(0);
    for (std::uint32_t f = 1; f < shape.face.size(); ++f) {
        const double h = height(f);
        if (h > above) above = h, face = f;
    }
    if (above <= 0.0 || over_face(body, face, x)) {
        return {above - radius, body.normal[face], Region::face, face};
    }

    double least = std::numeric_limits<double>::infinity();
    Vec3 from_foot = Vec3::Zero();
    Region region = Region::vertex;
    std::uint32_t feature = 0, nearest = 0;
    for (std::uint32_t e = 0; e < shape.edge.size(); ++e) {
        const ConvexShape::Edge& edge = shape.edge[e];
        if (height(edge.left) < 0.0 && height(edge.right) < 0.0) continue;  // out of sight
        const Vec3 &from = body.vertex[edge.from], &to = body.vertex[edge.to];
        const double t = (x - from).dot(to - from) / (to - from).squaredNorm();
        const bool at_from = t <= 0.0, at_to = t >= 1.0;
        const Vec3 d = at_from ? Vec3(x - from) : at_to ? Vec3(x - to) : Vec3(x - (from + t * (to - from)));
        const double square = d.squaredNorm();
        if (square >= least) continue;
        least = square, from_foot = d, nearest = e;
        region = at_from || at_to ? Region::vertex : Region::edge;
        feature = at_from ? edge.from : at_to ? edge.to : e;
    }
    // Nearer than round-off of the coordinates the difference is noise.
    const double noise = 4.0 * std::numeric_limits<double>::epsilon() * (shape.radius + x.norm());
    const double distance = std::sqrt(least);
    const Vec3 normal = distance > noise ? Vec3(from_foot / distance) : mean_normal(body, nearest, region, feature);
    return {distance - radius, normal.normalized(), region, feature};
}

}  // namespace scree::contact
