// The rasters of a run (core/raster.hpp): rasters/rasters.h5, and each as an ESRI grid for geographic information
// systems. Written at the end of a run, however it ends; if asked for, as rasters/NNNNNN.h5 with each snapshot too.
//
// Layout of rasters.h5: format "scree rasters", time, /provenance, and /rasters with the attributes x, y (world: lower
// corner of the first cell), dx, dy [m] and the datasets (rows, columns), the southernmost row first:
//   flow_depth_max, flow_height_max, speed_max, deposit   0 where nothing flowed
//   arrival_time                                          NaN where nothing arrived (no data in the ESRI grid)
// All ranks write rasters.h5; for the ESRI grids rank 0 reads one raster after the other back from it and holds it.
#pragma once

#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/results/provenance.hpp"

namespace scree::io {

// Collective, both. `deposit`: flow depth now, of this rank's cells.
void write_raster_file(const std::string& path, const Scene& scene, const State& state,
                       const std::vector<double>& deposit, const Provenance& provenance, const Communicator& ranks);
// All of the folder.
void write_rasters(const std::string& folder, const Scene& scene, const State& state,
                   const std::vector<double>& deposit, const Provenance& provenance, const Communicator& ranks);

}  // namespace scree::io
