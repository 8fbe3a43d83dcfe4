// The surfaces of polyhedra at one time, as points and polygons that ParaView reads. Larger than the bodies that it is
// made from (a rock with 20 vertices and 12 faces: 0.6 kB before compression); `output.mesh: false` leaves it out.
//
// Datasets of /mesh in a snapshot:
//   points  (p, 3)  vertices in the world, body after body; single precision if that moves none by more than
//                   kMovedMost of the smallest body's radius, else double
//   cells   (c)     the faces as XDMF's topology Mixed has them: 3 (polygon), how many corners, rows of `points`
//   body    (f)     of each face: row of /bodies
#pragma once

#include "core/bodies.hpp"
#include "core/convex_shape.hpp"
#include "io/hdf5/shared_file.hpp"

namespace scree::io {

inline constexpr double kMovedMost = 1e-3;

// Collective. `bodies`: this rank's slice of them, in the order of the file. `origin` is added to the points.
void write_body_mesh(SharedFile& file, const Bodies& bodies, const std::vector<ConvexShape>& shapes, const Vec3& origin,
                     const Layout& layout);

}  // namespace scree::io
