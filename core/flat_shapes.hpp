// Shapes one after another in plain arrays, as files hold them, and back to the same bits. Of a shape everything is
// kept that cannot be derived from the rest without round-off.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/convex_shape.hpp"

namespace scree {

struct FlatShapes {
    // one a shape
    std::vector<std::uint64_t> vertices, faces, corners, edges;  // how many
    std::vector<double> volume, radius, inner_radius;            // [m3], [m], [m]
    std::vector<Vec3> inertia;                                   // [m5]
    // shape after shape
    std::vector<Vec3> vertex;                          // [m]
    std::vector<Vec3> face_normal;                     //
    std::vector<double> face_offset;                   // [m]
    std::vector<std::uint64_t> sides;                  // of each face
    std::vector<std::uint32_t> corner;                 // vertices of the faces, counted from the first of the shape
    std::vector<std::uint32_t> from, to, left, right;  // of the edges
};

FlatShapes flatten(const std::vector<ConvexShape>& shapes);
// Throws IoError if lengths do not agree or an index points nowhere.
std::vector<ConvexShape> unflatten(const FlatShapes& flat);

}  // namespace scree
