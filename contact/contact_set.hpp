// The contacts of one step, in order of key, as detection leaves them for the solver.
#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/vec.hpp"

namespace scree::contact {

struct Contact {
    ContactKey key;
    std::uint32_t a;  // index of body a
    std::uint32_t b;  // index of body b, or of the wall if key.is_wall()
    Vec3 normal;      // unit, from b to a
    double gap;       // [m] at the middle of the step
    double friction;  // mu
    double bias;      // [m/s] c of the normal velocity (laws/impact.hpp)

    // Middle between the two surfaces [m], given body a.
    Vec3 point(const Vec3& centre_a, double radius_a) const { return centre_a - (radius_a + 0.5 * gap) * normal; }
};

using ContactSet = std::vector<Contact>;

}  // namespace scree::contact
