// A bed of spheres at rest under gravity, made by the engine itself: 8,000 spheres poured into a box, settled, and
// copied side by side for larger beds.
#pragma once

#include "contact/contact_set.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::benchmarks {

struct Bed {
    Scene scene;
    Plan plan;
    State state;
};

// `tiles` x `tiles` copies of the settled box; friction 0 makes the frictionless scene.
Bed settled_bed(int tiles, double friction);

// The contacts of the bed's next step; positions in `bed` are moved to the middle of that step.
contact::ContactSet next_contacts(Bed& bed);

}  // namespace scree::benchmarks
