// The scene: all that is constant during a run. State (state.hpp) is all that changes; scratch is neither.
//
// Every position in the scene and in the state is relative to `origin`, which is chosen near the bodies, so that
// coordinates of a national grid (1e6 m) cost no digits. Files and messages show origin + position.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/material.hpp"
#include "core/measure.hpp"
#include "core/raster.hpp"
#include "core/region.hpp"
#include "core/settings.hpp"
#include "core/size_distribution.hpp"
#include "core/time_function.hpp"
#include "core/wall.hpp"

namespace scree {

// Takes away every body whose centre is in the region at the end of a step; counts and mass are kept in the state.
struct Outlet {
    std::string name;
    Region region;
    double from = 0.0, until = kForever;  // [s]
};

// Makes bodies at random free places of a box region (bodies that would overlap wait for the next step).
struct Inlet {
    std::string name;
    BoxRegion region;
    MaterialIndex material{};
    SizeDistribution size = FixedSize{0.0};
    double mass_rate = 0.0;  // [kg/s]
    Vec3 velocity = Vec3::Zero();
    double from = 0.0, until = kForever;  // [s]
    double max_mass = kForever;           // [kg] in all
};

struct Scene {
    std::string title;
    std::uint64_t seed = 1;
    Vec3 origin = Vec3::Zero();  // [m] added to every position in files and messages
    TimeTable gravity = TimeTable::constant(Vec3(0.0, 0.0, -9.81));  // [m/s2]
    std::vector<Material> materials;
    PairTable pairs;
    std::vector<Wall> walls;
    std::vector<Outlet> outlets;
    std::vector<Inlet> inlets;
    std::vector<Measure> measures;
    std::optional<RasterSettings> rasters;
    TrajectorySettings trajectories;
    TimeSettings time;
    SolverSettings solver;
    CorrectionSettings correction;
    OutputSettings output;
};

}  // namespace scree
