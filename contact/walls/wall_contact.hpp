// Contacts of a sphere with one wall, exactly, in the wall's frame.
//   gap = distance from the sphere's surface to the wall's surface [m], negative when they overlap
//   normal = unit vector from the wall to the sphere's centre (contact frame: a = sphere, b = wall)
// A wall can touch a sphere at several places (a box's corner: three faces). Each place has a `feature` number that stays
// the same as the sphere moves along, for warm start.
#pragma once

#include <array>
#include <cstdint>

#include "core/wall.hpp"

namespace scree::contact {

struct WallContact {
    Vec3 normal;             // wall frame
    double gap;              // [m]
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

// All places where the gap is at most `margin`. `centre` in the wall's frame.
void find_contacts(const WallShape& shape, const Vec3& centre, double radius, double margin, WallContacts& out);

// A body may pass through a thin wall (two-sided) when it moves more than its radius in a step; through a one-sided
// plane it cannot.
bool is_thin(const WallShape& shape);

// Bounds of the wall's surface in its own frame, infinite where it is unbounded: bodies farther away than
// radius + margin cannot touch it.
struct WallBounds {
    Vec3 lower, upper;
};
WallBounds bounds(const WallShape& shape);

}  // namespace scree::contact
