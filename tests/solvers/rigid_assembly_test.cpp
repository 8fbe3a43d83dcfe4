// A lane's numbers against the Delassus block from its definition.
#include "solvers/rigid_assembly.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/testing/rigid_contacts.hpp"

namespace scree::solvers {
namespace {

using testing::RigidContacts, testing::Shape, testing::SlowRigidContact;
using Real = SlowRigidContact::Real;
using V3 = SlowRigidContact::V3;
using M3 = SlowRigidContact::M3;
using M2 = SlowRigidContact::M2;

constexpr Real kRound = 2.2e-16L;
Real off(Real a, Real b) {
    return std::abs(a - b);
}

// W in the frame of a lane, from its six numbers.
M3 of_lane(const RigidFrictionalBatch& batch, int lane) {
    const Real wn = batch.wn[lane], k1 = batch.coupling[0][lane], k2 = batch.coupling[1][lane];
    const Real a1 = 1 / static_cast<Real>(batch.inverse_at[lane]), a2 = a1 / batch.at_ratio[lane];
    M3 w;
    w << wn, wn * k1, wn * k2, wn * k1, a1 + wn * k1 * k1, wn * k1 * k2, wn * k2, wn * k1 * k2, a2 + wn * k2 * k2;
    return w;
}
M3 frame_of(const RigidFrictionalBatch& batch, int lane) {
    M3 f;
    for (int d = 0; d < 3; ++d) f(d, 0) = batch.n[d][lane], f(d, 1) = batch.t[d][lane];
    f.col(2) = f.col(0).cross(f.col(1));
    return f;
}

TEST(RigidAssembly, SixNumbersAreTheDelassusBlock) {
    for (const Shape shape : {Shape::sphere, Shape::grain, Shape::plate, Shape::needle})
        for (int seed = 0; seed < 200; ++seed) {
            const RigidContacts c(static_cast<std::uint64_t>(seed), shape, 0.5);
            for (int i = 0; i < kLanes; ++i) {
                const SlowRigidContact slow = c.slow(i);
                const M3 f = frame_of(c.friction, i), w = f.transpose() * slow.delassus() * f;
                EXPECT_LE((f.transpose() * f - M3::Identity()).norm(), 10 * kRound);
                const Real size = slow.size_of_delassus();
                EXPECT_LE((of_lane(c.friction, i) - w).norm(), 30 * kRound * size);
                const double ratio = c.friction.at_ratio[i];
                EXPECT_GT(ratio, 0.0);
                EXPECT_LE(ratio, 1.0);
                EXPECT_LE(off(c.friction.inverse_wn[i] * c.friction.wn[i], 1.0), 2 * kRound);
                EXPECT_GT(c.frictionless.inverse_w[i], 0.0);
                EXPECT_LE(off(c.frictionless.inverse_w[i] * w(0, 0), 1.0), 30 * kRound * size / w(0, 0));
            }
        }
}

TEST(RigidAssembly, BlockIsSymmetricAndPositive) {
    const RigidContacts c(3, Shape::needle, 0.5);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const RigidLine &a = c.line[c.friction.a[i]], &b = c.line[c.friction.b[i]];
        const Mat3 w = delassus_block(c.data[i], a, b, Mat3::Identity());
        EXPECT_EQ((w - w.transpose()).norm(), 0.0);
        const double least = w.selfadjointView<Eigen::Lower>().eigenvalues()[0];
        EXPECT_GE(least, (a.inverse_mass + b.inverse_mass) - 1e-15 * w.trace());
        const double a1 = 1.0 / c.friction.inverse_at[i];
        EXPECT_GE(a1, (a.inverse_mass + b.inverse_mass) * (1.0 - 1e-15));
    }
}

// Spheres: equal eigenvalues, any normal. The tangents are orthonormal, and W_T = 7/2 W_N.
TEST(RigidAssembly, EqualEigenvaluesAndAnyNormal) {
    RigidLine a{}, b{};
    a.inverse_mass = 2.0;
    for (int d = 0; d < 3; ++d) a.j[d] = 2.5 * 2.0 / 0.25;
    std::vector<Vec3> normals{Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ()};
    normals.push_back(Vec3(1, 1, 1).normalized());
    normals.push_back(Vec3(-1, 1, 1e-9).normalized());
    for (const Vec3& n : normals) {
        RigidFrictionalBatch batch{}, again{};
        const RigidContactData contact{n, -0.5 * n, Vec3::Zero(), 0.3, 0.1};
        set_lane(batch, 2, contact, a, b);
        set_lane(again, 5, contact, a, b);
        EXPECT_LE((frame_of(batch, 2).transpose() * frame_of(batch, 2) - M3::Identity()).norm(), 10 * kRound);
        EXPECT_LE(off(batch.inverse_at[2], 1.0 / 7.0), 1e-15);
        EXPECT_LE(off(batch.at_ratio[2], 1.0), 1e-15);
        EXPECT_LE(off(batch.coupling[0][2], 0.0), 1e-15);
        EXPECT_LE(off(batch.coupling[1][2], 0.0), 1e-15);
        EXPECT_LE(off(batch.wn[2], 2.0), 1e-15);
        for (int d = 0; d < 3; ++d) EXPECT_EQ(batch.t[d][2], again.t[d][5]);
    }
}

TEST(RigidAssembly, ImpulsesGoToTheContactAndBack) {
    RigidContacts c(5, Shape::grain, 0.5);
    for (int i = 0; i < kLanes; ++i) {
        const Vec3& p = c.impulse[static_cast<std::size_t>(i)];
        EXPECT_LE((world_impulse(c.friction, i) - p).norm(), 1e-15 * p.norm());
        const Vec3& n = c.data[static_cast<std::size_t>(i)].normal;
        EXPECT_LE((world_impulse(c.frictionless, i) - p.dot(n) * n).norm(), 1e-15 * p.norm());
        EXPECT_LE(off(c.friction.p[0][i], p.dot(n)), 1e-15 * p.norm());
    }
}

}  // namespace
}  // namespace scree::solvers
