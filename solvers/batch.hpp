// Contacts in batches of eight (in single precision two times eight) that share no moving body: one batch is one call
// of a kernel. Lanes without a contact join the ground to the ground and do nothing.
#pragma once

#include <cstdint>

#include "core/simd.hpp"
#include "solvers/lines.hpp"

namespace scree::solvers {

// With friction: 96 bytes a contact (in single precision 48). The impulse is a vector in the world frame; no tangent
// frame is stored, because for spheres the Delassus block is diagonal with one value for both tangents.
template <class Real>
struct alignas(64) FrictionBatchOf {
    std::uint32_t a[PackOf<Real>::kLanes], b[PackOf<Real>::kLanes];  // lines
    Real n[3][PackOf<Real>::kLanes];                                 // unit normal, from b to a
    Real bias[PackOf<Real>::kLanes];                                 // c [m/s]
    Real inverse_w[PackOf<Real>::kLanes];                            // 1 / W_N [kg]
    Real friction[PackOf<Real>::kLanes];                             // mu
    Real p[3][PackOf<Real>::kLanes];                                 // impulse on a [N s]
};
using FrictionBatch = FrictionBatchOf<double>;

// Without: 56 bytes a contact (32), the impulse is a number.
template <class Real>
struct alignas(64) FrictionlessBatchOf {
    std::uint32_t a[PackOf<Real>::kLanes], b[PackOf<Real>::kLanes];
    Real n[3][PackOf<Real>::kLanes];
    Real bias[PackOf<Real>::kLanes];
    Real inverse_w[PackOf<Real>::kLanes];
    Real p[1][PackOf<Real>::kLanes];
};
using FrictionlessBatch = FrictionlessBatchOf<double>;

// What the scene's plan selects once.
struct Frictional {
    template <class Real>
    using LineOf = SpinningLineOf<Real>;
    template <class Real>
    using BatchOf = FrictionBatchOf<Real>;
    static constexpr int kImpulse = 3;     // numbers an impulse
    static constexpr bool kRigid = false;  // bodies of any shape (rigid_batch.hpp)
};
struct Frictionless {
    template <class Real>
    using LineOf = SlidingLineOf<Real>;
    template <class Real>
    using BatchOf = FrictionlessBatchOf<Real>;
    static constexpr int kImpulse = 1;
    static constexpr bool kRigid = false;
};

// A run of batches whose contacts lie in one block of space; blocks of one colour share no moving body.
struct Block {
    std::uint32_t begin, end;  // batches
};

}  // namespace scree::solvers
