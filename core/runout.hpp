// How far a flow ran: figures of the start and of the end of a run with rasters. Heights are z, lengths horizontal.
//
//   H / L         from the highest point of what was there at the start to the farthest covered cell of the deposit, at
//                 the ground: the slope of the line from crest to toe (Heim's Fahrboeschung), as regressions on rock
//                 avalanches have it (Mitchell et al. 2019). L is straight; lengths along a bent path are longer.
//   H_G / L_G     the same between the centres of mass: the mean friction coefficient of a sliding block
//   deposit       cells whose flow depth at the end is above RasterSettings::covered
// The figures of the end are of the bodies that are over the grid then, those of the start of all that were there.
#pragma once

#include "core/vec.hpp"

namespace scree {

struct Runout {
    double released_volume = 0.0;                                         // [m3] of the bodies, without pores
    Vec3 top = Vec3::Zero(), toe = Vec3::Zero();                          // [m] absolute; NaN without bodies, deposit
    double fall_height = 0.0, length = 0.0;                               // H, L [m]; NaN if no deposit
    Vec3 centre_before = Vec3::Zero(), centre_after = Vec3::Zero();       // [m] absolute: centres of mass
    double centre_fall = 0.0, centre_length = 0.0;                        // H_G, L_G [m]
    double deposit_area = 0.0, deposit_volume = 0.0, deposit_most = 0.0;  // [m2], [m3] depth times area, [m] depth
    double beyond = 0.0;       // [m3] volume of the bodies that are not over the grid at the end
    double flowed_area = 0.0;  // [m2] cells with an arrival
};

}  // namespace scree
