// snapshots/shapes.h5: the shapes of a run's bodies, once for all its snapshots, which link to it as their /shapes.
//
// A rock with 14 vertices takes 2.2 kB here (half of that compressed) and, as a body of a snapshot, 0.1 kB: where many
// bodies have shapes of their own, shapes in every snapshot would be most of it.
#pragma once

#include <string>
#include <vector>

#include "core/convex_shape.hpp"
#include "core/parallel/communicator.hpp"
#include "io/results/provenance.hpp"

namespace scree::io {

inline constexpr const char* kShapesFile = "shapes.h5";  // beside the snapshots

// Atomically, by rank 0; collective. Layout: format "scree shapes", /shapes (flat_shape_fields.hpp), /provenance.
void write_shapes(const std::string& path, const std::vector<ConvexShape>& shapes, const Provenance& provenance,
                  int compression, const Communicator& ranks);

}  // namespace scree::io
