// Bodies from a text file: a body a line, numbers separated by blanks, `#` begins a comment. What the columns hold is
// said by the scenario's `columns`.
//
// Rank 0 reads the file in pieces and tells them to the others, so that it is read once. Each rank understands every
// line, so that all see the same faults and the same number of bodies, and keeps the bodies of its part of the file.
#pragma once

#include <limits>
#include <vector>

#include "core/ids.hpp"
#include "scenarios/row_figures.hpp"

namespace scree::scenarios {

// The numbers of a file, scaled, in the file's own frame: the scenario's `offset` comes later, so that it can be added
// to the local origin first and costs no digits. Those that this rank keeps.
struct BodyFile {
    std::vector<std::uint64_t> row;  // among the bodies of the file, from 0
    std::vector<double> radius;      // [m] of polyhedra: of the ball that holds it
    std::vector<MaterialIndex> material;
    std::vector<Vec3> position, velocity, spin;  // [m], [m/s], [rad/s]
    // Of polyhedra; else empty.
    std::vector<std::size_t> instance;   // of `instances`
    std::vector<Quat> orientation;       // of the body frame
    std::vector<RowInstance> instances;  // of all rows: the same on all ranks
    Vec3 offset = Vec3::Zero();          // [m]
    std::uint64_t bodies = 0;            // in the whole file
    // The box around all bodies of the file, offset included [m].
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

// Reads the file of one `generator: file`, which is item `stream` of the bodies. Faults are reported with file:line:col
// of the data file. `whole`: each rank keeps all bodies.
BodyFile read_body_file(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                        bool whole);
void add_file_bodies(const BodyFile& file, const Context& context, BodyList& bodies);

}  // namespace scree::scenarios
