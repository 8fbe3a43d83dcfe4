// The distance to each shape of wall, one function a shape, one file a function; find_contacts() calls them.
// Private to this folder. Arguments as in wall_contact.hpp.
#pragma once

#include <optional>

#include "contact/walls/axial_frame.hpp"
#include "contact/walls/wall_contact.hpp"

namespace scree::contact::detail {

// What is asked about: a sphere, and how near a place must be to be reported.
struct Probe {
    Vec3 centre;    // wall frame [m]
    double radius;  // [m]
    double margin;  // [m]
};

void plane_contacts(const PlaneWall& plane, const Probe& probe, WallContacts& out);
void box_contacts(const BoxWall& box, const Probe& probe, WallContacts& out);
void cylinder_contacts(const CylinderWall& cylinder, const Probe& probe, WallContacts& out);
void cone_contacts(const ConeWall& cone, const Probe& probe, WallContacts& out);
void disc_contacts(const DiscWall& disc, const Probe& probe, WallContacts& out);
void orifice_floor_contacts(const OrificeFloor& floor, const Probe& probe, WallContacts& out);
void slot_floor_contacts(const SlotFloor& floor, const Probe& probe, WallContacts& out);
void terrain_contacts(const TerrainWall& wall, const Probe& probe, WallContacts& out);
// The triangle that speaks for a feature; none beyond a closed border.
std::optional<std::uint32_t> terrain_triangle(const Terrain& terrain, std::uint32_t feature);
// Whether a centre within probe.margin of this one may touch: never false where it does.
bool near_terrain(const TerrainWall& wall, const Probe& probe);

// A finite surface of revolution with a straight profile, thin and two-sided: cones, and cylinders with open ends.
struct Shell {
    Vec3 base, axis;
    double radius_base, radius_end, length;  // [m]
    bool inside;                             // which side a centre that lies exactly on the surface belongs to
};
void shell_contacts(const Shell& shell, const Probe& probe, WallContacts& out);

// The contact with one point of a wall; `fallback` is the normal if the centre lies on the point.
inline void add_point(const Vec3& from_point, const Vec3& fallback, const Probe& probe, std::uint32_t feature,
                      WallContacts& out) {
    const double distance = length_of(from_point);
    if (distance - probe.radius > probe.margin) return;
    out.add(distance > 0.0 ? Vec3((from_point / distance).normalized()) : fallback, distance - probe.radius, feature);
}

}  // namespace scree::contact::detail
