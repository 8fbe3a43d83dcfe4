// How far a flow ran: figures of the start and of the end of a run with rasters. Heights are z, lengths horizontal.
//
//   H / L         from the highest point of what was released to the farthest covered cell of the deposit, at the
//                 ground: the slope of the line from crest to toe (Heim's Fahrboeschung), as in regressions on rock
//                 avalanches (Mitchell et al. 2019). L is straight; lengths along a bent path are longer.
//   H_G / L_G     the same between the centres of mass: the mean friction coefficient of a sliding block
//   deposit       cells whose flow depth at the end is above RasterSettings::covered
// Bodies that an inlet made or an outlet took are in the end's figures or not, as they are there.
#pragma once

#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

struct BodiesTogether {
    double volume = 0.0, mass = 0.0;  // [m3], [kg]
    Vec3 centre = Vec3::Zero();       // [m] of mass; zero if there is none
};
// Exact sums over the bodies of all ranks. Collective.
BodiesTogether together(const Scene& scene, const Bodies& bodies, const Communicator& ranks);
// The highest point of a body, over its centre; of equal ones that of the smallest id. Collective.
Vec3 highest_of_all(const State& state, const Communicator& ranks);

struct Runout {
    double released_volume = 0.0;                       // [m3] of the bodies, without pores
    Vec3 top, toe;                                      // [m] absolute: crest and farthest point; NaN without a deposit
    double fall_height = 0.0, length = 0.0;             // H, L [m]
    Vec3 centre_before, centre_after;                   // [m] absolute: centres of mass
    double centre_fall = 0.0, centre_length = 0.0;      // H_G, L_G [m]
    double deposit_area = 0.0, deposit_volume = 0.0;    // [m2], [m3] depth times area, with pores if so asked
    double deposit_most = 0.0;                          // [m] largest depth
    double flowed_area = 0.0;                           // [m2] cells with an arrival, the release's among them
};
// `deposit`: flow depth at the end, of this rank's cells. Collective.
Runout runout(const Scene& scene, const State& state, const std::vector<double>& deposit, const Communicator& ranks);

}  // namespace scree::solvers
