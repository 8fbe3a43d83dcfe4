// The local origin. Given by the scenario, or chosen: if the coordinates of bodies, inlets and finite walls are more
// than 1000 times as large as the box around them, the box's middle, rounded to a multiple of a power of two about the
// size of the box. Taking such an origin from a coordinate loses no digit. Otherwise zero. A terrain is wide, and the
// bodies on it small: with one it is enough that zero lies outside of the box by its size.
#pragma once

#include <vector>

#include "scenarios/body_file.hpp"
#include "scenarios/context.hpp"
#include "scenarios/terrain.hpp"

namespace scree::scenarios {

// `files`: the bodies of each `generator: file`; `terrains`: of each wall that is one.
Vec3 choose_origin(const io::Node& scenario, const std::vector<BodyFile>& files,
                   const std::vector<TerrainFile>& terrains);

}  // namespace scree::scenarios
