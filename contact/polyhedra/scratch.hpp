// Room that the narrow phase of two polyhedra works in. Owned by the caller, one a thread; it grows to the largest
// shapes it meets and is never given back, so that after the first pairs nothing is allocated. No result depends on
// what is in it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/convex_shape.hpp"
#include "core/vec.hpp"

namespace scree::contact {

struct PolyhedraScratch {
    // separating axes
    std::vector<double> row[2];             // heights of the other body's vertices over a face, face after face
    std::vector<std::uint64_t> outside[2];  // per vertex: the faces of the other body that it is well outside of
    std::vector<std::uint32_t> edge[2];     // edges that may take part

    // patch
    struct SlabVertex {
        std::uint32_t vertex;
        Vec3 at;  // [m]
    };
    struct SlabEdge {
        std::uint32_t edge;
        Vec3 from, to;  // [m] (u, v, height)
    };
    struct SlabFace {
        Vec3 normal;
        double offset, slope;  // [m]; cosine of the face against the direction of contact
    };
    std::vector<double> height[2];        // [m] of vertices, along the direction of contact
    std::vector<std::uint8_t> face_used;  //
    std::vector<SlabVertex> slab_vertex[2];
    std::vector<SlabEdge> slab_edge[2];
    std::vector<SlabFace> slab_face[2];

    // terrain: a triangle with upright sides, as a shape
    ConvexShape triangle;
    std::vector<Vec3> triangle_room;
};

}  // namespace scree::contact
