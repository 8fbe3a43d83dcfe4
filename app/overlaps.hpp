// Overlaps of bodies at the start, where each rank has any of the bodies: they meet on ranks by place.
//
// Space is cut into cells, each cell belongs to a rank by a hash of its place. A body goes to the rank of the cell that
// it lies in, and a copy to the ranks of all cells within its diameter of its centre. Two bodies overlap only if the
// smaller one's centre lies less than the larger one's diameter away from its centre: so the rank of the smaller one's
// cell has both, and counts the pair, once.
#pragma once

#include <cstdint>
#include <optional>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/find_overlaps.hpp"

namespace scree::app {

struct Overlaps {
    std::uint64_t count = 0;                  // of all ranks, on every rank
    std::optional<solvers::Overlap> deepest;  // of all ranks, on rank 0
};

// Deeper than `relative` of the smaller radius, between bodies and with walls. Collective.
Overlaps count_overlaps(const Scene& scene, const State& state, double relative, const Communicator& ranks);

}  // namespace scree::app
