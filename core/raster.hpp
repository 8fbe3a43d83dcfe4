// Rasters: a grid of rectangular cells seen from above (along z), and what flowed over each cell.
//
// Flow depth [m]: volume of the bodies in the column over a cell / (area of the cell times `solid_fraction`), upright,
//   as depth-averaged models have it (flow thickness times the secant of the slope). With solid_fraction 1 it is the
//   depth of the solid; with the packing fraction of the flow (about 0.6) that of grains and pores. A body's volume is
//   spread evenly over a square as large as the shadow of a sphere of its volume, so that no cell is too small.
// Flow height [m]: of the highest point of a body above the ground below its centre; single blocks and their jumps
// show. Speed [m/s]: of the centre of mass of the fastest body whose square meets the cell. Arrival [s]: time of the
// first sample in which the flow depth is above `covered`. Deposit [m]: the flow depth at the end of the run.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/vec.hpp"

namespace scree {

struct RasterGrid {
    std::uint32_t columns = 0, rows = 0;  // cells along x, y
    double x = 0.0, y = 0.0;              // [m] lower corner of the first cell
    double dx = 0.0, dy = 0.0;            // [m] size of a cell

    std::uint64_t cells() const { return std::uint64_t{columns} * rows; }
    double centre_x(std::uint64_t cell) const { return x + (static_cast<double>(cell % columns) + 0.5) * dx; }
    double centre_y(std::uint64_t cell) const { return y + (static_cast<double>(cell / columns) + 0.5) * dy; }
};

struct RasterSettings {
    RasterGrid grid;                   // in the local frame
    std::optional<WallIndex> terrain;  // heights are above this terrain wall, else above `level`
    double level = 0.0;                // [m] z
    std::uint64_t sample_every = 1;    // steps
    double solid_fraction = 1.0;       //
    bool at_snapshots = false;         // write them with each snapshot too
    double covered = 0.0;              // [m] a cell is covered if its flow depth is above this
};

// Of this rank's rows of cells, which are Division{rows, 1, ranks} of all (core/parallel/sorted_slices.hpp).
struct RasterState {
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    std::vector<double> depth, height, speed;  // [m], [m], [m/s]: largest so far
    std::vector<double> arrival;               // [s] or kNever
    std::uint64_t columns = 0;                 // of the grid
    // What was there at the start; relative to the scene's origin.
    double volume = 0.0;         // [m3] of the bodies
    Vec3 centre = Vec3::Zero();  // [m] centre of mass
    Vec3 top = Vec3::Zero();     // [m] the highest point of a body, over its centre; NaN if there was none
};

}  // namespace scree
