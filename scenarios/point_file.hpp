// Bodies from a text file of points: a point a line, x y z separated by blanks; an empty line ends a body, `#` begins a
// comment. Each body is the convex hull of its points, where they are.
#pragma once

#include <limits>
#include <vector>

#include "scenarios/generators.hpp"

namespace scree::scenarios {

// What a file holds, scaled, in the file's own frame: the scenario's `offset` comes later, so that it can be added to
// the local origin first and costs no digits. The same on all ranks.
struct PointFile {
    std::vector<std::vector<Vec3>> points;  // [m] of each body
    std::vector<int> line;                  // of the file, where each begins
    std::string path;
    Vec3 offset = Vec3::Zero();  // [m]
    // The box around all points, offset included [m].
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

// Reads the file of one `generator: hulls`. Faults are reported with file:line:col of the data file.
PointFile read_point_file(const io::Node& node, const Context& context, const Communicator& ranks);
// Points that have no hull are reported with the line where they begin.
void add_hulls(const io::Node& node, const PointFile& file, const Context& context, const Communicator& ranks,
               BodyList& bodies);

}  // namespace scree::scenarios
