// Walls as text, for files that a picture is drawn from.
#pragma once

#include <string>

#include "core/wall.hpp"

namespace scree::io {

// "plane", "box", "cylinder", "cone", "disc", "orifice_floor", "slot_floor", "terrain"
std::string shape_name(const WallShape& shape);
// The members of the shape as a JSON object, in the wall's own frame [m]; an infinite length is null.
std::string shape_json(const WallShape& shape);

}  // namespace scree::io
