// Terrain: a fixed surface of triangles that bodies stay on the outer side of; from a grid of heights or from a mesh.
// Plain data; distances are in contact/walls/terrain.cpp and contact/polyhedra/.
//
// A grid's cell is cut in two along the diagonal whose ends differ less in height (the one from the lowest x and y
// where they differ alike): ridges and valleys that run across cells stay what they are. A cell with a node without
// data has one triangle or none: a hole.
//
// Where the surface ends, at the border and around holes, upright triangles (its sides) go on:
//   open     outer sides go down from it: the ground is solid. Bodies roll off the edge and fall along the side.
//   closed   walls go up from it, and bodies are kept inside.
// They end as far below the lowest or above the highest point as the terrain is wide. Surfaces of a mesh that overhang
// have no outer sides: they are sheets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/terrain_lookup.hpp"
#include "core/terrain_mesh.hpp"
#include "core/vec.hpp"

namespace scree {

// Heights at the nodes of a grid.
struct HeightGrid {
    std::uint32_t columns = 0, rows = 0;  // nodes along x, y
    double x = 0.0, y = 0.0;              // [m] the node with the lowest x and y
    double dx = 0.0, dy = 0.0;            // [m] between nodes
    std::vector<double> height;           // [m] columns x rows, x fastest, from the lowest y on; NaN: no data

    double at(std::uint32_t i, std::uint32_t j) const { return height[std::size_t{j} * columns + i]; }
    bool has(std::uint32_t i, std::uint32_t j) const { return at(i, j) == at(i, j); }
    double last_x() const { return x + (columns - 1) * dx; }
    double last_y() const { return y + (rows - 1) * dy; }
};

enum class TerrainBorder : std::uint8_t { open, closed };

// What was taken from a grid of heights so that bodies may fill its place.
struct TerrainRelease {
    std::vector<double> thickness;  // [m] at each node of the grid: so much higher was the ground; 0 outside
    double volume = 0.0;            // [m3]
    double area = 0.0;              // [m2] seen from above, of the nodes that were lowered
    double deepest = 0.0;           // [m] upright
};

struct Terrain {
    TerrainMesh mesh;
    TerrainLookup lookup;
    std::uint32_t ground = 0;  // triangles: those after them are sides
    TerrainBorder border = TerrainBorder::open;
    Vec3 lower, upper;                    // [m] of the ground
    double bottom = 0.0, top = 0.0;       // [m] where the sides end
    std::optional<HeightGrid> grid;       // what the surface was made of, if it is a height field
    std::vector<MaterialIndex> material;  // of each triangle; empty: that of the wall
    std::optional<TerrainRelease> release;
    std::string checksum;  // of the file that it was read from

    // visit(triangle) for each that may touch the box, in increasing order, each once.
    template <class Visit>
    void visit(const Vec3& low, const Vec3& high, Visit&& call) const {
        lookup.visit(low, high, call);
    }
    // The triangle of a height field above or below a place.
    std::optional<std::uint32_t> column(double x, double y) const;
    // x lies in the solid ground of a height field: nothing may be there, however deep.
    bool under(const Vec3& x) const { return grid && x.z() < upper.z() && under(x, column(x.x(), x.y())); }
    bool under(const Vec3& x, std::optional<std::uint32_t> column) const;  // of which this is the column
    // x lies beyond the border of a closed height field: nothing may be there either.
    bool outside(const Vec3& x) const;
    MaterialIndex material_of(std::uint32_t triangle, MaterialIndex wall) const {
        return material.empty() ? wall : material[triangle];
    }
    std::size_t bytes() const;
};

// Behind a surface that is no height field, bodies are pushed out when their centre is no deeper than this [m].
inline double terrain_depth(double body_radius) {
    return body_radius;
}

// Throw ScenarioError where there is no triangle; of meshes as make_terrain_mesh.
Terrain make_terrain(HeightGrid grid, TerrainBorder border);
Terrain make_terrain(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles, TerrainBorder border);
Terrain translated(const Terrain& terrain, const Vec3& shift);

}  // namespace scree
