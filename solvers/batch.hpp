// Contacts in batches of eight that share no moving body: one batch is one call of a kernel. Lanes without a contact
// join the ground to the ground and do nothing.
#pragma once

#include <cstdint>

#include "core/simd.hpp"
#include "solvers/lines.hpp"

namespace scree::solvers {

// With friction: 96 bytes a contact. The impulse is a vector in the world frame; no tangent frame is stored, because
// for spheres the Delassus block is diagonal with one value for both tangents.
struct alignas(64) FrictionBatch {
    std::uint32_t a[kLanes], b[kLanes];  // lines
    double n[3][kLanes];                 // unit normal, from b to a
    double bias[kLanes];                 // c [m/s]
    double inverse_w[kLanes];            // 1 / W_N [kg]
    double friction[kLanes];             // mu
    double p[3][kLanes];                 // impulse on a [N s]
};

// Without: 56 bytes a contact, the impulse is a number.
struct alignas(64) FrictionlessBatch {
    std::uint32_t a[kLanes], b[kLanes];
    double n[3][kLanes];
    double bias[kLanes];
    double inverse_w[kLanes];
    double p[1][kLanes];
};

// What the scene's plan selects once.
struct Frictional {
    using Line = SpinningLine;
    using Batch = FrictionBatch;
    static constexpr int kImpulse = 3;  // numbers an impulse
};
struct Frictionless {
    using Line = SlidingLine;
    using Batch = FrictionlessBatch;
    static constexpr int kImpulse = 1;
};

// A run of batches whose contacts lie in one block of space; blocks of one colour share no moving body.
struct Block {
    std::uint32_t begin, end;  // batches
};

}  // namespace scree::solvers
