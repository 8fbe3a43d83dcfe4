// The figures of core/runout.hpp, over all ranks.
#pragma once

#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/raster.hpp"
#include "core/runout.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

struct BodiesTogether {
    double volume = 0.0, mass = 0.0;  // [m3], [kg]
    Vec3 centre = Vec3::Zero();       // [m] of mass; NaN if there is none
};
// Exact sums over the bodies of all ranks whose centre is over the grid (all, without one). Collective.
BodiesTogether together(const Scene& scene, const Bodies& bodies, const RasterGrid* grid, const Communicator& ranks);
// The highest point of a body, over its centre; of equal ones that of the smallest id; NaN if there is none.
// Collective.
Vec3 highest_of_all(const State& state, const Communicator& ranks);

// `deposit`: flow depth at the end, of this rank's cells. Collective.
Runout runout(const Scene& scene, const State& state, const std::vector<double>& deposit, const Communicator& ranks);

}  // namespace scree::solvers
