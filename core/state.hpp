// The state: everything that changes and that a restart needs, and only that.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bodies.hpp"
#include "core/convex_shape.hpp"
#include "core/ids.hpp"
#include "core/ledger.hpp"
#include "core/raster.hpp"
#include "core/scene.hpp"
#include "core/step_report.hpp"

namespace scree {

// Impulses of the last step, in order of key, for warm start. `impulse_vector` in scenes with friction,
// `impulse_normal` in scenes without; the other is empty.
struct WarmStart {
    std::vector<ContactKey> key;         // m, increasing
    std::vector<Vec3> impulse_vector;    // [N s], m, world frame, acts on a
    std::vector<double> impulse_normal;  // [N s], m
    double step = 0.0;                   // [s] length of the step that they belong to
};

struct InletState {
    std::uint64_t attempts = 0;  // draws so far: the counter of the random numbers
    std::uint64_t bodies = 0;
    double mass = 0.0;  // [kg] made so far
};
struct OutletState {
    std::uint64_t bodies = 0;
    double mass = 0.0;  // [kg] taken so far
};
// Running numbers of one measure (what passed a surface; sums for the mean over the window).
struct MeasureState {
    double passed_mass = 0.0;  // [kg] flow_rate: since the start
    double passed_count = 0.0;
    double passed_mass_at_row = 0.0;  // at the last history row
    double passed_count_at_row = 0.0;
    double time_at_row = 0.0;        // [s]
    double window_time = 0.0;        // [s] inside the window so far
    std::vector<double> window_sum;  // one a number of the measure's columns, time-weighted
};

struct State {
    double time = 0.0;          // [s]
    std::uint64_t step = 0;     // scenario steps done (a cut step counts once)
    std::uint64_t next_id = 0;  // next free BodyId
    double block_size = 0.0;    // [m] edge of the blocks that order the work; 0: not chosen yet
    // Of this rank: its own bodies and, while a run goes on, the ghosts among them; likewise the impulses.
    Bodies bodies;
    // By ShapeIndex, the same on all ranks; constant during a run, but a restart cannot make them anew. Empty when all
    // bodies are spheres.
    std::vector<ConvexShape> shapes;
    WarmStart warm_start;
    std::vector<InletState> inlets;      // one an inlet
    std::vector<OutletState> outlets;    // one an outlet
    std::vector<MeasureState> measures;  // one a measure
    RasterState rasters;                 // empty if the scene has none
    Ledger ledger;
    RunTotals totals;
    // Output counters, so that a resumed run goes on with the next file and row.
    std::uint64_t snapshots_written = 0;
    std::uint64_t history_rows = 0;
    std::uint64_t trajectory_rows = 0;
    std::vector<std::uint64_t> followed;  // ids of the bodies whose trajectories are written, increasing
};

}  // namespace scree
