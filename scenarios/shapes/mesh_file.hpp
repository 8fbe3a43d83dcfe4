// Shapes from mesh files: OFF, OBJ, STL (text or binary) and PLY. Faces may be any polygons. A mesh must
// be the closed surface of one convex body, faces counter-clockwise seen from outside; what it is instead is said with
// the file's name. With `hull` it may be any points with faces or without: the body is their convex hull.
//
// Tolerance: 1e-6 of the size, since most meshes hold single precision (6e-8): planes and equal points are found in
// spite of its round-off, dents up to 4e-6 are not seen.
#pragma once

#include <string>

#include "core/make_shape.hpp"

namespace scree::scenarios {

struct MeshOptions {
    double scale = 1.0;  // metres in one unit of the file
    bool hull = false;   // take the convex hull of its points
};

// A file that cannot be read is an IoError, a mesh that is no body a ShapeError; both begin with `path`.
PlacedShape read_mesh(const std::string& path, const MeshOptions& options = {});
// The same of a file's bytes, `path` for messages and for the kind of file that its end names.
PlacedShape read_mesh_bytes(const std::string& path, const std::string& bytes, const MeshOptions& options = {});

}  // namespace scree::scenarios
