// Edges on the Gauss map, where a face is the point of its normal and an edge the arc between those of its faces
// (Gregorius 2013). Private to this folder.
#pragma once

#include "contact/polyhedra/placed.hpp"

namespace scree::contact::detail {

struct Arc {
    Vec3 along;        // [m] the edge, with the left face to its left seen from outside
    Vec3 left, right;  // normals of the faces
    Vec3 point;        // [m] on the edge

    Arc(const Vec3& edge, const Vec3& left_normal, const Vec3& right_normal, const Vec3& start)
        : along(edge), left(left_normal), right(right_normal), point(start) {}
    Arc(const Placed& body, std::uint32_t e) {
        const ConvexShape::Edge& edge = body.shape->edge[e];
        along = body.vertex[edge.to] - body.vertex[edge.from];
        left = body.normal[edge.left], right = body.normal[edge.right];
        point = body.vertex[edge.from];
    }
};

// The arc of a crosses that of b mirrored at the origin: the edges span a face of the Minkowski difference.
inline bool cross(const Arc& a, const Arc& b) {
    const double cba = b.left.dot(a.along), dba = b.right.dot(a.along);
    if (cba * dba >= 0.0) return false;
    const double adc = -a.left.dot(b.along), bdc = -a.right.dot(b.along);
    return adc * bdc < 0.0 && cba * bdc > 0.0;
}

// Unit, across both edges, towards the outside of a; false if they are parallel. Made perpendicular to the edge of a
// once more, so that round-off does not tilt it along nearly parallel edges.
inline bool across_edges(const Arc& a, const Arc& b, Vec3& normal) {
    constexpr double kParallel = 1e-12;  // sine
    normal = a.along.cross(b.along);
    const double length = normal.norm(), square = a.along.squaredNorm();
    if (length <= kParallel * std::sqrt(square * b.along.squaredNorm())) return false;
    normal /= length;
    normal -= (normal.dot(a.along) / square) * a.along;
    normal.normalize();
    if (normal.dot(a.left + a.right) < 0.0) normal = -normal;
    return true;
}

}  // namespace scree::contact::detail
