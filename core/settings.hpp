// Settings of a run, with unit, default and consequence. The scenario reader's table gives the same defaults.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace scree {

struct TimeSettings {
    double end = 0.0;   // [s]
    double step = 0.0;  // [s]
    // No body moves more than this share of its radius in a step: faster ones make the step be halved as often as
    // needed, so that nothing can pass through anything. Such substeps are counted and reported.
    double max_travel = 1.0;  // [radii]; 0: never substep
};

enum class SolverMethod {
    gauss_seidel,            // plain sweeps
    conjugate_gauss_seidel,  // sweeps accelerated by a nonlinear conjugate gradient (the default)
};

enum class SolverPrecision {
    mixed,  // sweeps in single precision where it cannot be what limits, completed and judged in double (the default)
    full,   // all in double precision
};

struct SolverSettings {
    SolverMethod method = SolverMethod::conjugate_gauss_seidel;
    SolverPrecision precision = SolverPrecision::mixed;
    double tolerance = 1e-2;  // on the scaled natural map, rms; its maximum must be below 16 times this
    int max_sweeps = 100;     // a step that ends here unconverged is counted and reported
    int min_sweeps = 2;
    bool warm_start = true;   // start from the last step's impulses
    double block_size = 0.0;  // [m], edge of the blocks that order the work; 0: chosen from the sizes of the bodies
    // Contacts that free flight would leave open are held too if their gap is below this share of what the bodies move
    // against each other in half a step: less penetration, more contacts to solve, and less restitution.
    double look_ahead = 0.0;
};

// Position-level correction of penetration: moves bodies, not velocities.
struct CorrectionSettings {
    bool on = true;
    int sweeps = 40;      // at most, in a step; they end when none moves a contact any more
    double share = 0.83;  // of the penetration, aimed at in one step
};

// Bodies whose way is written down. None: no ids, and a count of 0.
struct TrajectorySettings {
    std::vector<std::uint64_t> ids;  // increasing
    std::uint64_t count = 0;         // so many more, spread evenly over the ids at the start
    std::uint64_t every = 1;         // steps between rows

    bool any() const { return !ids.empty() || count > 0; }
};

struct OutputSettings {
    double snapshot_interval = 0.0;      // [s]; 0: only the first and the last
    double history_interval = 0.0;       // [s]; 0: every step
    double checkpoint_interval = 600.0;  // [s of wall time]; 0: only at the end or when stopped
    double report_interval = 10.0;       // [s of wall time] between progress lines when standard error is no terminal
    std::vector<std::string> fields;  // of bodies, beside id, position and radius: velocity, spin, material, mass, ...
    bool contacts = false;            // write the contacts into each snapshot
    bool mesh = true;                 // write the surfaces of polyhedra into each snapshot
    int compression = 4;              // gzip level, 0 to 9
};

}  // namespace scree
