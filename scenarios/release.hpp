// Release areas: the part of a terrain between its surface and sliding planes, within a perimeter. The terrain is
// lowered to the planes, and bodies fill the place of what was taken.
#pragma once

#include "core/terrain.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// From the key `release` of a terrain. Lowers each node of `grid`, which is in the local frame, that lies within the
// perimeter and above the highest of the planes to this one.
TerrainRelease cut_release(const io::Node& node, const Context& context, HeightGrid& grid);

}  // namespace scree::scenarios
