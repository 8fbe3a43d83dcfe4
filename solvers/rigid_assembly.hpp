// A contact of two bodies of any shape, into a lane of a batch: its Delassus block
//   W = H^T M^-1 H,   H d = (d, r_a x d; -d, -r_b x d),   W = (1/m_a + 1/m_b) 1 + R_a^T J_a R_a + R_b^T J_b R_b,
// R d = r x d, and the tangents in which its Schur complement is diagonal (rigid_batch.hpp).
#pragma once

#include "core/vec.hpp"
#include "solvers/rigid_batch.hpp"

namespace scree::solvers {

struct RigidContactData {
    Vec3 normal;  // unit, from b to a
    Vec3 ra, rb;  // from the centres of mass to the contact [m]; rb is ignored where b has no inverse inertia
    double friction = 0.0, bias = 0.0;
};

// W [1/kg] in the axes that are the columns of `frame`.
Mat3 delassus_block(const RigidContactData& contact, const RigidLine& a, const RigidLine& b, const Mat3& frame);

// All of the lane but the lines' numbers; the impulse is set to zero.
void set_lane(RigidFrictionalBatch& batch, int lane, const RigidContactData& contact, const RigidLine& a,
              const RigidLine& b);
void set_lane(RigidFrictionlessBatch& batch, int lane, const RigidContactData& contact, const RigidLine& a,
              const RigidLine& b);

// The impulse on a of one lane in world axes [N s]: to report it, and to start from one. Without friction what is not
// along the normal is left out.
Vec3 world_impulse(const RigidFrictionalBatch& batch, int lane);
Vec3 world_impulse(const RigidFrictionlessBatch& batch, int lane);
void set_world_impulse(RigidFrictionalBatch& batch, int lane, const Vec3& impulse);
void set_world_impulse(RigidFrictionlessBatch& batch, int lane, const Vec3& impulse);

}  // namespace scree::solvers
