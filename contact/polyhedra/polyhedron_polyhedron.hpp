// Two convex polyhedra: how far apart, along which normal, and where they touch.
//
//   apart: gap = |v| by closest_points.hpp; where the nearest features are a vertex and a face, or two edges, the
//     normal is that of these features, which has no round-off of a short v, else v / |v|
//   overlapping: gap = s and its normal by separating_axis.hpp
//   where round-off keeps |v| from its end (nearly parallel features, nearly touching): bounded by s from below and by
//     the shortest way between edges from above
//
// To 1e-14 of the sizes in general position, to 3e-9 where features are nearly parallel and the gap is tiny.
//
// Both are the largest separation over all normals, so gap and normal go through zero without a step. Only where an
// edge or a vertex is nearest to a vertex or an edge has the normal of bodies apart no continuation: when they touch it
// becomes that of the least overlap, one of the cone of normals there.
//
// The normal of the least overlap jumps where two directions are equally deep; that lies in the matter.
// Equal bits under exchange of a and b: the pair is worked on in an order of its own, by the sign of the largest
// coordinate of x_a - x_b; for coincident centres by the turned vertices. (Two equal shapes in the same place and
// orientation have no order: there a is the first.)
//
// `axis` is a guess kept from an earlier step: a direction that still separates the pair by more than the margin ends
// the question. It changes no result.
#pragma once

#include "contact/polyhedra/manifold.hpp"
#include "contact/polyhedra/placed.hpp"
#include "contact/polyhedra/scratch.hpp"

namespace scree::contact {

struct PolyhedraGap {
    double gap;   // [m]; if it is more than the margin, a lower bound of it
    Vec3 normal;  // unit, from b to a
};

PolyhedraGap polyhedra_gap(const Placed& a, const Placed& b, double margin, PolyhedraScratch& scratch);

// The points where the gap is at most `margin`; false if there are none. `axis` is unit or zero (no guess); on return
// the direction of contact, or one that separates. Overwrites `out`.
bool polyhedron_polyhedron(const Placed& a, const Placed& b, double margin, Vec3& axis, PolyhedraScratch& scratch,
                           Manifold& out);

}  // namespace scree::contact
