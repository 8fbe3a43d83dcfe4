// A polyhedron as it is given: vertices and face loops in any frame, before anything is known of it. make_shape turns a
// good one into a ConvexShape; a bad one is refused by one of the names below.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/convex_shape.hpp"
#include "core/errors.hpp"

namespace scree {

struct Polyhedron {
    std::vector<Vec3> vertex;                      // [m]
    std::vector<std::vector<std::uint32_t>> face;  // vertices of each, counter-clockwise seen from outside
};

enum class ShapeFault {
    not_finite,     // a coordinate is infinite or not a number
    too_few,        // fewer than 4 vertices or faces (points, for a hull)
    bad_face,       // fewer than 3 corners, a corner twice, or one that is not a vertex
    not_closed,     // an edge of one face only
    not_oriented,   // neighbours disagree about what is outside, or all are clockwise seen from outside
    not_manifold,   // an edge of more than two faces, or a surface that is not that of a ball
    not_connected,  // several bodies
    self_crossing,  // the surface cuts itself (told by scenarios/shapes/mesh_file)
    not_planar,     // corners of one face out of its plane
    not_convex,     //
    no_volume,      // all in one plane, line or point, or too thin to tell
};
const char* name_of(ShapeFault fault);

// A body that cannot be: the user's input.
class ShapeError : public Error {
  public:
    ShapeError(ShapeFault fault, const std::string& what) : Error(ExitCode::invalid_scenario, what), fault_(fault) {}
    ShapeFault fault() const { return fault_; }

  private:
    ShapeFault fault_;
};

// Numbers are finite and faces are loops of different vertices, or a ShapeError.
void check_loops(const Polyhedron& body);
// Each edge once, in order of (from, to). A surface that is not closed, oriented, connected and that of a ball (by its
// Euler characteristic V - E + F = 2) is a ShapeError. After check_loops.
std::vector<ConvexShape::Edge> edges_of(const Polyhedron& body);
// Leaves out vertices that no face uses.
void drop_unused_vertices(Polyhedron& body);

// Area times unit normal [m2] of a loop, also where it is not quite planar: (1/2) sum x_i x x_(i+1), from its first
// corner.
Vec3 area_vector(const Polyhedron& body, std::size_t face);
// Smallest box that holds the vertices.
struct Extent {
    Vec3 lower, upper;
    Vec3 middle() const { return 0.5 * lower + 0.5 * upper; }
    double size() const { return (upper - lower).norm(); }  // [m] its diagonal: what tolerances are relative to
    // [m] Coordinates so far from 0 carry no finer digits.
    double rounding() const;
};
Extent extent_of(const std::vector<Vec3>& points);

}  // namespace scree
