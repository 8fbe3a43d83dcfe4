// Energies of bodies, by hand.
#include "solvers/energy.hpp"

#include <gtest/gtest.h>

#include "tests/testing/small_scene.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;

void two(SmallScene& w) {
    w.gravity(Vec3(0, 0, -10));
    w.add(Vec3(1, 2, 3), 0.5, Vec3(3, 4, 0), Vec3(0, 0, 2), 2.0);
    w.add(Vec3(0, 0, -1), 1.0, Vec3(0, 0, 1), Vec3(1, 0, 0), 4.0);
}

TEST(Energy, WithoutSpin) {
    SmallScene w(1.0);
    two(w);
    EXPECT_DOUBLE_EQ(kinetic_energy(w.state.bodies), 25.0 + 2.0);
    EXPECT_DOUBLE_EQ(potential_energy(w.state.bodies, Vec3(0, 0, -10)), 60.0 - 40.0);
    EXPECT_EQ(weighted_position(w.state.bodies), Vec3(2, 4, 2));
    EXPECT_DOUBLE_EQ(energy_of(w.state.bodies, 0, Vec3(0, 0, -10)), 85.0);
}

TEST(Energy, WithSpin) {
    SmallScene w(1.0, 0.3);
    two(w);
    w.state.bodies.spin = w.given_spins;
    // 2/5 m R^2 / 2 w^2: 0.2 * 2 * 0.25 * 4 = 0.4 and 0.2 * 4 * 1 * 1 = 0.8
    EXPECT_DOUBLE_EQ(kinetic_energy(w.state.bodies), 27.0 + 1.2);
    EXPECT_DOUBLE_EQ(energy_of(w.state.bodies, 1, Vec3::Zero()), 2.8);
}

TEST(Energy, TheLedgerStartsAndFollows) {
    SmallScene w(1.0);
    two(w);
    start_ledger(w.scene, w.state);
    EXPECT_DOUBLE_EQ(w.state.ledger.kinetic_0, 27.0);
    EXPECT_DOUBLE_EQ(w.state.ledger.potential_0, 20.0);
    EXPECT_EQ(w.state.ledger.imbalance(), 0.0);
    w.velocity(0) = Vec3::Zero();
    w.position(0).z() = 13.0;
    update_energies(w.scene, w.state);
    EXPECT_DOUBLE_EQ(w.state.ledger.kinetic, 2.0);
    EXPECT_DOUBLE_EQ(w.state.ledger.kinetic_max, 27.0);
    EXPECT_DOUBLE_EQ(w.state.ledger.potential_max, 220.0);
    EXPECT_DOUBLE_EQ(w.state.ledger.potential_min, 20.0);
    EXPECT_DOUBLE_EQ(w.state.ledger.imbalance(), 175.0);
}

TEST(Energy, PotentialUsesGravityOfTheTime) {
    SmallScene w(1.0);
    two(w);
    w.scene.gravity = TimeTable{{0.0, 1.0}, {Vec3(0, 0, -10), Vec3(0, 0, -20)}};
    w.state.time = 0.5;
    update_energies(w.scene, w.state);
    EXPECT_DOUBLE_EQ(w.state.ledger.potential, 30.0);
}

}  // namespace
}  // namespace scree::solvers
