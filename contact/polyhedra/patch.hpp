// The points of contact of two convex polyhedra, given the direction n from b to a along which they meet.
//
//   gap(u, v) = z_a(u, v) - z_b(u, v)      heights along n of a's lower and b's upper surface over the plane across n
//
// This is a convex, piecewise linear function, and its corners are where a vertex of one body lies over the other, or
// an edge of one crosses an edge of the other. All corners with a gap of at most the margin are taken; nothing is asked
// of how faces are tilted. So a point comes and goes with a gap of the margin, where it carries nothing, or at the
// border of the overlap, where another one takes its place: between contact of faces, edges and vertices there is no
// switch to flicker. Where two faces lie on one another the corners are those of their clipped polygon.
//
// Corners nearer to one another than kSameCorner of the smaller radius are one, with the place of the deeper one; and a
// corner as near to a vertex has that vertex's key, of a first, then of b. So the corners of two aligned faces keep
// their keys when round-off moves them; nor are edges that lie on one another nearly all along said to cross. More than
// Manifold::kCapacity: the most open ones go first, down to half-way between the deepest gap and the margin; then those
// inside of the hull, again the most open ones first; then corners of the hull, those first that leave it the largest
// area. The deepest one stays.
#pragma once

#include "contact/polyhedra/manifold.hpp"
#include "contact/polyhedra/placed.hpp"
#include "contact/polyhedra/scratch.hpp"

namespace scree::contact {

inline constexpr double kSameCorner = 2e-5;  // of the smaller body's radius

// `points` from the position of b. Overwrites `out`, which is empty if no corner is within the margin.
void contact_patch(const Placed& a, const Placed& b, const Vec3& normal, double margin, PolyhedraScratch& scratch,
                   Manifold& out);

}  // namespace scree::contact
