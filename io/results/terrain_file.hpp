// snapshots/terrain.h5: the ground of a run's terrain walls, once for all its snapshots, which link to it as /terrain.
//
// Layout: format "scree terrain", /provenance, and a group /terrain/<row of /walls> for each with
//   height    (rows, columns)  of a grid: heights of its nodes, NaN without data; the southernmost row first.
//                              Attributes of the group: x, y (world) of the first node and dx, dy between nodes [m]
//   vertex    (v, 3), triangle (t, 3)  the surface, without the sides at its border; for ParaView, and of a terrain
//                              that is no grid for all readers
#pragma once

#include <string>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "io/results/provenance.hpp"

namespace scree::io {

inline constexpr const char* kTerrainFile = "terrain.h5";  // beside the snapshots

bool has_terrain(const Scene& scene);
// Atomically, by rank 0; collective. The surfaces of grids if scene.output.mesh.
void write_terrain(const std::string& path, const Scene& scene, const Provenance& provenance,
                   const Communicator& ranks);

}  // namespace scree::io
