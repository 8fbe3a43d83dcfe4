// Compares two results: two snapshots, checkpoints or histories, or two run folders (their snapshots by number, their
// histories, trajectories and rasters, their newest checkpoints). Bodies are matched by id. Provenance and times of the
// wall clock do not count.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scree::io {

struct Difference {
    std::string dataset;  // "bodies/position"; in run folders "snapshots/000002.h5: bodies/position"
    std::string unit;
    std::size_t compared = 0;   // numbers
    std::size_t different = 0;  // of them
    double max_absolute = 0.0;  // [unit]
    double max_relative = 0.0;  // max_absolute over the largest magnitude in either dataset
    bool identical = true;      // to the bit
    bool within = true;         // the tolerance
    std::string note;           // why it could not be compared in full ("only in the second")
};

struct Comparison {
    bool identical = true;                            // all that was compared, to the bit
    bool within = true;                               // the tolerance
    std::vector<Difference> differences;              // one a dataset, equal ones included
    std::vector<std::uint64_t> only_in_a, only_in_b;  // ids of bodies (of the last file compared that has any)
    std::vector<std::string> notes;
};

// `tolerance` bounds max_relative. Throws IoError if a or b cannot be read or they are of different kinds.
Comparison compare(const std::string& a, const std::string& b, double tolerance = 0.0);
std::string to_text(const Comparison& comparison);

}  // namespace scree::io
