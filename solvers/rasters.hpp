// Keeps the rasters of a scene (core/raster.hpp) while it runs. Every rank has some rows of cells; after a sample it
// gets from the others what their bodies add there. Depths are summed as integers (of 2^-40 of a cell's width): no
// order of bodies and no number of ranks changes a bit. No rank holds the whole grid.
#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/raster.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

class Rasters {
  public:
    Rasters(const Scene& scene, const Communicator& ranks);

    // Collective, all of them. At the start of a run: what is released, and the first sample. A resumed run has them.
    void start(const Scene& scene, State& state) {
        if (scene.rasters && state.rasters.columns == 0) begin(scene, state);
    }
    void after_step(const Scene& scene, State& state) {
        if (scene.rasters && state.step % scene.rasters->sample_every == 0) sample(scene, state);
    }
    // At the end, after the last checkpoint: no deposit is deeper than the largest flow depth.
    void finish(const Scene& scene, State& state) { sample(scene, state); }
    // Flow depth now [m], of this rank's cells.
    std::vector<double> depth(const Scene& scene, const State& state);

  private:
    // What a body adds to a cell, or several bodies together.
    struct Touch {
        std::uint64_t cell;
        std::int64_t depth;  // in units
        double height, speed;
    };
    void begin(const Scene& scene, State& state);
    void sample(const Scene& scene, State& state);
    void touch_all(const Scene& scene, const State& state);
    void merge();
    void send_home(const RasterGrid& grid);

    const Communicator& ranks_;
    double unit_ = 0.0;             // [m] of depth
    std::uint64_t first_cell_ = 0;  // of this rank
    std::size_t cells_ = 0;         // of this rank
    std::vector<Touch> touches_;    // scratch
};

// Highest point of a body [m], relative to the scene's origin.
double highest_point(const State& state, std::size_t body);
// z [m] of the ground at a place; NaN beyond it.
double ground_height(const Scene& scene, const RasterSettings& rasters, double x, double y);

}  // namespace scree::solvers
