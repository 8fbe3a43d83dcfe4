// Bodies from a text file: a body a line, numbers separated by blanks, `#` begins a comment. What the columns hold is
// said by the scenario's `columns`.
#pragma once

#include <vector>

#include "core/ids.hpp"
#include "scenarios/generators.hpp"

namespace scree::scenarios {

// The numbers of a file, scaled, in the file's own frame: the scenario's `offset` comes later, so that it can be added
// to the local origin first and costs no digits.
struct BodyFile {
    std::vector<double> radius;  // [m]
    std::vector<MaterialIndex> material;
    std::vector<Vec3> position, velocity, spin;  // [m], [m/s], [rad/s]
    Vec3 offset = Vec3::Zero();                  // [m]
};

// Reads the file of one `generator: file`. Faults are reported with file:line:col of the data file.
BodyFile read_body_file(const io::Node& node, const Context& context);
void add_file_bodies(const BodyFile& file, const Context& context, BodyList& bodies);

}  // namespace scree::scenarios
