// A convex polyhedron (a) and one triangle of a terrain (b), one-sided: where the body reaches behind the triangle, by
// up to `depth`, it is pushed out.
//
// The normal is the one along which they overlap least (or are farthest apart) among those that the terrain has there:
//   the triangle's own,
//   for each of its ridges (convex edges) and an edge of the body whose arcs cross on the Gauss map, their cross
//   product;
//       the ridge's arc goes from the normal of the triangle to that of its neighbour,
//   for each face of the body that a vertex of the triangle meets: its normal, within the cone of directions in which
//       no edge that starts at the vertex rises.
// Flat edges and valleys have no arc: no direction but the triangles' own acts there, so nothing catches on an inner
// edge (Voronoi regions; Ericson 2005; Coumans 2011). Ridges and vertices belong to their first triangle; the others
// leave them to it. The points are those of patch.hpp. With the triangle's own normal, those where the body crosses a
// flat edge or valley, or covers a vertex without a ridge, are left out: the surface goes on there. Of valleys those
// that are inside the body stay: below a valley no triangle has ground along its normal, and a corner of the body would
// sink in.
//
// Bodies that are apart by less than the margin, with a vertex nearest to a ridge or an edge nearest to a vertex, are
// not reported before features meet that make a normal: such pairs touch only by chance.
#pragma once

#include "contact/polyhedra/manifold.hpp"
#include "contact/polyhedra/placed.hpp"
#include "contact/polyhedra/scratch.hpp"
#include "core/terrain_mesh.hpp"

namespace scree::contact {

// Keys: edges and vertices of b are 0 to 2, as in TerrainMesh::Triangle. `area` is that of the whole part of the
// triangle that the body covers within the margin. Overwrites `out`; false if it has no points.
bool polyhedron_triangle(const Placed& body, const TerrainMesh& mesh, std::uint32_t triangle, double depth,
                         double margin, PolyhedraScratch& scratch, Manifold& out);

}  // namespace scree::contact
