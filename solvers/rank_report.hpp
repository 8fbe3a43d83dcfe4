// What one rank has, and what it sent and waited for since the start of the program.
#pragma once

#include <cstdint>

namespace scree::solvers {

struct RankReport {
    std::uint64_t own = 0, ghosts = 0;      // bodies
    std::uint64_t contacts = 0;             // solved in the last step
    std::uint64_t neighbours = 0;           // ranks that hold bodies of this one
    std::uint64_t messages = 0, bytes = 0;  // sent
    std::uint64_t repartitions = 0;         // times that space was cut anew
    std::uint64_t migrated = 0;             // bodies given away
    double wait_seconds = 0.0;              // for messages
    double imbalance = 1.0;                 // largest work of a rank over the mean, when last looked at
};

}  // namespace scree::solvers
