// What a scenario asks to be measured. Each measure adds columns to the history (name, unit) and, for the time window
// [from, until], its mean to the summary. The quantities themselves are computed in solvers/measures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/region.hpp"

namespace scree {

enum class MeasureKind {
    flow_rate,     // mass [kg/s] and number [1/s] through `surface` along its normal, and the mass that passed [kg]
    mass_in,       // mass [kg] and number of bodies whose centre lies in `region`
    wall_force,    // force [N] that the bodies exert on a wall (mean over the step), and its torque about the origin
    coordination,  // contacts with an impulse, a body with its centre in `region`; share of bodies with none
    packing_fraction,  // volume of the spheres cut by `region` / volume of the region, by exact caps for boxes' faces
    profile,  // along `axis` from `from_coordinate` to `to_coordinate` in `bins`: packing fraction, mean velocity
    extent,   // lowest and highest point [m] along `axis` of the bodies in `region` (all if none), centre of mass
};

struct MeasureSurface {
    Vec3 point, normal;            // the plane
    std::optional<double> radius;  // only within this distance of `point`, if given [m]
};

struct Measure {
    std::string name;
    MeasureKind kind{};
    std::optional<Region> region;
    MeasureSurface surface{};                           // flow_rate
    WallIndex wall{};                                   // wall_force
    Vec3 axis = Vec3::UnitZ();                          // profile, extent: unit vector
    double from_coordinate = 0.0, to_coordinate = 0.0;  // profile [m], along the axis
    int bins = 0;                                       // profile
    double from = 0.0;                                  // window of the mean in the summary [s]
    double until = 0.0;
};

// One column of the history.
struct HistoryColumn {
    std::string name;  // e.g. "outflow.mass_rate"
    std::string unit;  // e.g. "kg/s"
    std::string description;
    int width = 1;  // numbers a row (a profile has one a bin)
};

}  // namespace scree
