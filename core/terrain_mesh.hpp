// A surface of triangles that bodies stay on one side of: terrain. Plain data; the heights need no order, and the
// surface may be any that does not cut itself. The outer side is the one from which corners go round counter-clockwise.
//
// Neighbours are known, so that a body that slides over an edge between two triangles meets the surface that both make,
// and not the end of each (ghost collisions): edges and vertices act only along directions that no triangle beside them
// answers for, their Voronoi regions (Ericson 2005, 5.1; Coumans 2011 for triangles).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace scree {

struct TerrainMesh {
    static constexpr std::uint32_t kNone = 0xffffffffU;

    struct Triangle {
        std::array<std::uint32_t, 3> corner;
        std::array<std::uint32_t, 3> edge;  // from corner i to corner i + 1
        Vec3 normal;                        // outward, unit
    };
    struct Edge {
        std::uint32_t from, to;      // from < to
        std::uint32_t left, right;   // triangles: `left` has it from `from` to `to`; kNone beyond a border
        Vec3 into_left, into_right;  // unit, in the plane of the triangle, across the edge; zero beyond a border
        bool convex;                 // a ridge by more than round-off, or a border

        std::uint32_t owner() const { return left < right ? left : right; }  // it speaks for the edge
    };

    std::vector<Vec3> vertex;  // [m]
    std::vector<Triangle> triangle;
    std::vector<Edge> edge;
    std::vector<std::uint32_t> link_begin, link;  // vertices joined to each by an edge, increasing
    std::vector<std::uint32_t> owner;             // of each vertex: its first triangle
    std::vector<std::uint8_t> on_ridge;           // of each vertex: one of its edges is convex
    std::vector<Vec3> outward;                    // of each vertex: sum of the normals around it times their angles

    std::span<const std::uint32_t> links(std::size_t v) const {
        return {link.data() + link_begin[v], link.data() + link_begin[v + 1]};
    }
};

// Throws ScenarioError, naming the triangle, where one has no area, a corner that is not there, or an edge that
// another triangle has in the same direction.
TerrainMesh make_terrain_mesh(std::vector<Vec3> vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace scree
