// Overlaps of bodies at the start: how many, and the deepest.
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
