// Contacts of a sphere with one wall, exactly, in the wall's frame.
//   gap = distance from the sphere's surface to the wall's surface [m], negative when they overlap
//   normal = unit vector from the wall to the sphere's centre (contact frame: a = sphere, b = wall)
// A wall can touch a sphere at several places (a box's corner: three faces). Each place has a `feature` number that
// stays the same as the sphere moves along, for warm start.
//
// Which side a sphere is on is judged by its centre alone. One-sided walls, which nothing gets through however deep it
// is: planes, boxes closed all round with bodies inside, infinite cylinders with bodies inside. A surface with an open
// end can be walked round, so it is a thin shell that is touched from either side: open boxes, finite cylinders with
// bodies inside, cones. An infinite cylinder has no ends: its `base` is any point of its axis. Normals are defined for
// every centre, also on a surface, on an axis, at an apex. Lengths have no scale here.
//
// A terrain can touch a sphere at more places than are kept: then the deepest are (of equals the lowest features).
#pragma once

#include <array>
#include <cstdint>

#include "core/wall.hpp"

namespace scree::contact {

struct WallContact {
    Vec3 normal;  // wall frame
    double gap;   // [m]
    std::uint32_t feature;
};

// A small fixed list: no allocation in the step.
struct WallContacts {
    static constexpr int kCapacity = 8;
    std::array<WallContact, kCapacity> item;
    int count = 0;

    void add(const Vec3& normal, double gap, std::uint32_t feature) {
        if (count < kCapacity) item[static_cast<std::size_t>(count++)] = {normal, gap, feature};
    }
};

// All places where the gap is at most `margin`. `centre` in the wall's frame. Overwrites `out`.
void find_contacts(const WallShape& shape, const Vec3& centre, double radius, double margin, WallContacts& out);

// Whether a sphere whose centre is within `reach` of this one may touch the wall: never false where one does, sometimes
// true where none does.
bool may_touch(const WallShape& shape, const Vec3& centre, double radius, double reach);

// Terrain may have zones of other materials than the wall's; no other wall has.
bool has_zones(const WallShape& shape);
// The material at a feature of a wall with zones; at ridges and summits that of the triangle that speaks for them.
MaterialIndex material_at(const Wall& wall, std::uint32_t feature);

// A body may pass through a thin wall (two-sided) or a solid when it moves more than its radius in a step; through a
// one-sided wall it cannot.
bool is_thin(const WallShape& shape);

// Bounds, in the wall's own frame, of where the centre of a body of no size can touch it: its surface, and everything
// behind a one-sided wall. Infinite where that is unbounded. Bodies farther away than radius + margin cannot touch it.
struct WallBounds {
    Vec3 lower, upper;
};
WallBounds bounds(const WallShape& shape);

}  // namespace scree::contact
