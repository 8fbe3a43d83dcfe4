// A convex polyhedron (a) inside or above an analytic wall (b): a container that is flat or curves towards the body is
// touched by vertices alone,
//   gap = distance of the vertex from the surface, negative beyond it,   normal = that of the surface there, inwards
//
// Each flat side, and each curved surface, is one place with a manifold of its own.
//   planes, closed boxes, endless cylinders from inside   one-sided: exact, nothing gets out
//   open boxes, finite cylinders, cones from inside, discs   only while the centre of mass lies within (before the
//   disc),
//       and only vertices beside the surface: exact for what does not reach over an end. What leans on a rim is not
//       held.
// Boxes from outside are polyhedra themselves, and terrain is triangles: narrow_phase.hpp sees to both, not this file.
// Not covered, nothing is reported: cylinders and cones from outside, floors with a hole. There edges and faces of the
// body meet rims and convex sides. polyhedron_wall_cover() tells.
#pragma once

#include "contact/polyhedra/manifold.hpp"
#include "contact/polyhedra/placed.hpp"
#include "core/wall.hpp"

namespace scree::contact {

struct WallPlaces {
    static constexpr int kCapacity = 6;
    std::array<Manifold, kCapacity> item;
    int count = 0;

    std::span<const Manifold> places() const { return {item.data(), static_cast<std::size_t>(count)}; }
};

enum class WallCover : std::uint8_t {
    exact,   // every contact is found
    inside,  // those that do not reach over an end of the surface
    none
};
WallCover polyhedron_wall_cover(const WallShape& shape);  // of all that a step does

// All places where the gap is at most `margin`. `body` is placed in the wall's frame, and so are points and normals.
// Keys name the vertex, as vertex_of_a, and the place: sides of boxes as in walls/box.cpp, else 0. Overwrites `out`.
void polyhedron_wall(const WallShape& shape, const Placed& body, double margin, WallPlaces& out);

}  // namespace scree::contact
