// Contacts of bodies of any shape in batches of eight (in single precision two times eight), as batch.hpp has them for
// spheres. The Delassus block W = H^T M^-1 H of such a contact is a full 3 x 3 matrix. With the normal impulse
// eliminated by u_N = 0, what is left of it is the Schur complement of the tangent plane,
//   S = W_TT - W_TN W_NT / W_NN      (2 x 2, positive definite),
// and the tangents t and s = n x t of a contact are its eigenvectors, with eigenvalues a1 <= a2: W is held by six
// numbers. Impulses are numbers along n, t, s, so that a cone is the same in every contact.
#pragma once

#include <cstdint>

#include "core/simd.hpp"
#include "solvers/rigid_lines.hpp"

namespace scree::solvers {

// With friction: 192 bytes a contact (in single precision 100).
template <class Real>
struct alignas(64) RigidFrictionalBatchOf {
    std::uint32_t a[PackOf<Real>::kLanes], b[PackOf<Real>::kLanes];   // lines
    Real n[3][PackOf<Real>::kLanes];                                  // unit normal, from b to a
    Real t[3][PackOf<Real>::kLanes];                                  // first tangent
    Real ra[3][PackOf<Real>::kLanes], rb[3][PackOf<Real>::kLanes];    // from the centres of mass to the contact [m]
    Real bias[PackOf<Real>::kLanes];                                  // c [m/s]
    Real friction[PackOf<Real>::kLanes];                              // mu
    Real wn[PackOf<Real>::kLanes], inverse_wn[PackOf<Real>::kLanes];  // W_NN [1/kg], 1 / W_NN
    Real coupling[2][PackOf<Real>::kLanes];                           // W_Nt / W_NN, W_Ns / W_NN
    Real inverse_at[PackOf<Real>::kLanes];                            // 1 / a1 [kg]
    Real at_ratio[PackOf<Real>::kLanes];                              // a1 / a2
    Real p[3][PackOf<Real>::kLanes];                                  // impulse on a along n, t, s [N s]
};
using RigidFrictionalBatch = RigidFrictionalBatchOf<double>;
static_assert(sizeof(RigidFrictionalBatch) == 192 * kLanes);
static_assert(sizeof(RigidFrictionalBatchOf<float>) == 100 * kLanesSingle);

// Without: 104 bytes a contact (56), the impulse is a number.
template <class Real>
struct alignas(64) RigidFrictionlessBatchOf {
    std::uint32_t a[PackOf<Real>::kLanes], b[PackOf<Real>::kLanes];
    Real n[3][PackOf<Real>::kLanes];
    Real ra_n[3][PackOf<Real>::kLanes], rb_n[3][PackOf<Real>::kLanes];  // r_a x n, r_b x n [m]
    Real bias[PackOf<Real>::kLanes];
    Real inverse_w[PackOf<Real>::kLanes];  // 1 / W_NN [kg]
    Real p[1][PackOf<Real>::kLanes];
};
using RigidFrictionlessBatch = RigidFrictionlessBatchOf<double>;
static_assert(sizeof(RigidFrictionlessBatch) == 104 * kLanes);
static_assert(sizeof(RigidFrictionlessBatchOf<float>) == 56 * kLanesSingle);

// What the scene's plan selects once, beside Frictional and Frictionless for spheres.
struct RigidFrictional {
    template <class Real>
    using LineOf = RigidLineOf<Real>;
    template <class Real>
    using BatchOf = RigidFrictionalBatchOf<Real>;
    static constexpr int kImpulse = 3;
    static constexpr bool kRigid = true;
};
struct RigidFrictionless {
    template <class Real>
    using LineOf = RigidLineOf<Real>;
    template <class Real>
    using BatchOf = RigidFrictionlessBatchOf<Real>;
    static constexpr int kImpulse = 1;
    static constexpr bool kRigid = true;
};

}  // namespace scree::solvers
