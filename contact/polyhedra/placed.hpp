// A convex polyhedron where it is: vertices and face normals turned into the world's axes, but still counted from the
// body's own centre of mass. What two bodies share is the one difference of their positions, so that the gap of a pair
// far from the origin loses no digits but those of the positions themselves.
#pragma once

#include <cassert>
#include <limits>
#include <span>

#include "core/convex_shape.hpp"
#include "core/vec.hpp"

namespace scree::contact {

struct Placed {
    const ConvexShape* shape;
    Vec3 position;                 // [m] of the centre of mass
    std::span<const Vec3> vertex;  // [m] from the centre of mass, world axes
    std::span<const Vec3> normal;  // of the faces, outward, unit, world axes

    double offset(std::size_t f) const { return shape->face[f].offset; }  // [m] normal . x on face f, x from the centre
};

// How many vectors of room place() fills.
inline std::size_t placed_size(const ConvexShape& shape) {
    return shape.vertex.size() + shape.face.size();
}

// `room` belongs to the caller and outlives what is returned: nothing is allocated.
inline Placed place(const ConvexShape& shape, const Vec3& position, const Quat& orientation, std::span<Vec3> room) {
    assert(room.size() >= placed_size(shape));
    const Mat3 turn = orientation.toRotationMatrix();
    const std::size_t vertices = shape.vertex.size(), faces = shape.face.size();
    for (std::size_t i = 0; i < vertices; ++i) room[i] = turn * shape.vertex[i];
    for (std::size_t f = 0; f < faces; ++f) room[vertices + f] = turn * shape.face[f].normal;
    return {&shape, position, room.first(vertices), room.subspan(vertices, faces)};
}

struct Extreme {
    double height;  // [m] direction . vertex
    std::uint32_t vertex;
};

// The vertex farthest along `direction`, the first of equals.
inline Extreme highest(const Placed& body, const Vec3& direction) {
    Extreme best{-std::numeric_limits<double>::infinity(), 0};
    for (std::uint32_t i = 0; i < body.vertex.size(); ++i) {
        const double height = direction.dot(body.vertex[i]);
        if (height > best.height) best = {height, i};
    }
    return best;
}
inline Extreme lowest(const Placed& body, const Vec3& direction) {
    Extreme best{std::numeric_limits<double>::infinity(), 0};
    for (std::uint32_t i = 0; i < body.vertex.size(); ++i) {
        const double height = direction.dot(body.vertex[i]);
        if (height < best.height) best = {height, i};
    }
    return best;
}

// Separation of a from b along a unit direction from b to a [m]: min over a of n.x - max over b of n.x. For every n it
// is at most the gap; the gap is its maximum.
inline double separation(const Placed& a, const Placed& b, const Vec3& direction) {
    return direction.dot(a.position - b.position) + lowest(a, direction).height - highest(b, direction).height;
}

}  // namespace scree::contact
