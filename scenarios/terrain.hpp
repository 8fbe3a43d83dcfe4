// Terrain from files: grids of heights, and meshes. It is read before the local origin is chosen, and put into the
// local frame after it.
#pragma once

#include <optional>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/terrain.hpp"
#include "core/wall.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// In the file's coordinates times `scale`. Empty if the file could not be read; the fault is then in the diagnostics.
struct TerrainFile {
    std::optional<HeightGrid> grid;
    std::vector<Vec3> vertex;  // of a mesh
    std::vector<TriangleCorners> triangle;
    std::string checksum;
    Vec3 offset = Vec3::Zero();                       // [m] added to all
    Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  // [m] bounds, offset and all
    bool empty() const { return !grid && triangle.empty(); }
};

// Of each terrain among the walls, in their order. Rank 0 reads the files and tells the others; each then makes the
// same of them.
std::vector<TerrainFile> read_terrains(const io::Node& scenario, const Context& context, const Communicator& ranks);

WallShape build_terrain(const io::Node& node, TerrainFile file, const Context& context);

}  // namespace scree::scenarios
