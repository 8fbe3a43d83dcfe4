// The datasets of core/flat_shapes.hpp, as checkpoints and snapshots/shapes.h5 hold them: one list for both.
//
// The vertices of shape s are the rows from sum(vertices[:s]) on, vertices[s] of them; faces and edges likewise. The
// corners of a face are sides[f] numbers of `corner`, face after face, counter-clockwise seen from outside.
#pragma once

#include "core/flat_shapes.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

// visit(name, values, meaning). `Flat` is FlatShapes or const FlatShapes.
template <class Flat, class Visit>
void visit_fields(Flat& flat, const Visit& visit) {
    visit("vertices", flat.vertices, Meaning{"1", "vertices of each shape"});
    visit("faces", flat.faces, Meaning{"1", "faces of each shape"});
    visit("corners", flat.corners, Meaning{"1", "corners of all faces of each shape"});
    visit("edges", flat.edges, Meaning{"1", "edges of each shape"});
    visit("volume", flat.volume, Meaning{"m3", "volume"});
    visit("radius", flat.radius, Meaning{"m", "of the ball about the centre of mass that holds it"});
    visit("inner_radius", flat.inner_radius, Meaning{"m", "of the ball about the centre of mass inside of it"});
    visit("inertia", flat.inertia, Meaning{"m5", "principal moments of the volume", "body"});
    visit("vertex", flat.vertex, Meaning{"m", "vertices, shape after shape", "body"});
    visit("face_normal", flat.face_normal, Meaning{"1", "outward", "body"});
    visit("face_offset", flat.face_offset, Meaning{"m", "normal . x on the face"});
    visit("sides", flat.sides, Meaning{"1", "corners of each face"});
    visit("corner", flat.corner, Meaning{"1", "vertices of the faces, counted from the first of the shape"});
    visit("edge_from", flat.from, Meaning{"1", "vertex"});
    visit("edge_to", flat.to, Meaning{"1", "vertex"});
    visit("edge_left", flat.left, Meaning{"1", "face that has the edge from `from` to `to`"});
    visit("edge_right", flat.right, Meaning{"1", "the other face"});
}

}  // namespace scree::io
