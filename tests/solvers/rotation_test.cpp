#include "solvers/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scree::solvers {
namespace {

// Free rotation for `steps` steps of length h from the identity; calls look(k, spin, energy) after each.
template <class Look>
void run(const Vec3& inertia, const Vec3& spin, double h, int steps, const Look& look) {
    Bodies bodies;
    bodies.id = {BodyId{0}};
    bodies.radius = {1.0};
    bodies.mass = {1.0};
    bodies.material = {MaterialIndex{0}};
    bodies.position = {Vec3::Zero()};
    bodies.velocity = {Vec3::Zero()};
    bodies.spin = {spin};
    bodies.orientation = {Quat::Identity()};
    bodies.shape = {ShapeIndex{0}};
    bodies.inertia = {inertia};
    ExactSum gain;
    for (int k = 1; k <= steps; ++k) {
        move_freely(bodies, 0.5 * h, gain);
        move_freely(bodies, 0.5 * h, gain);
        look(k, bodies, gain.value());
    }
}

double energy_of(const Bodies& b) {
    return 0.5 * angular_momentum(b.orientation[0], b.inertia[0], b.spin[0]).dot(b.spin[0]);
}

// validation of Dzhanibekov's flips: I = (1, 2, 3), w = (delta, 1, 0); sign changes of w_2 in the body frame every
// 2 K(m) / lambda, from the elliptic integral.
double flip_time(double delta, double h, int flips, double& momentum_error, double& energy_error) {
    const Vec3 inertia(1.0, 2.0, 3.0), spin(delta, 1.0, 0.0);
    const Vec3 momentum = inertia.cwiseProduct(spin);
    const double energy = 0.5 * momentum.dot(spin);
    double before = 1.0, first = 0.0, last = 0.0;
    int seen = 0;
    momentum_error = energy_error = 0.0;
    run(inertia, spin, h, static_cast<int>(40.0 * flips / h), [&](int k, const Bodies& b, double) {
        const double now = (b.orientation[0].conjugate() * b.spin[0]).y();
        if (now * before < 0.0 && seen < flips + 1) {
            const double t = h * (k - now / (now - before));
            if (seen++ == 0) first = t;
            last = t;
        }
        before = now;
        const Vec3 l = angular_momentum(b.orientation[0], inertia, b.spin[0]);
        momentum_error = std::max(momentum_error, (l - momentum).norm() / momentum.norm());
        energy_error = std::max(energy_error, std::abs(energy_of(b) - energy) / energy);
    });
    EXPECT_EQ(seen, flips + 1);
    return (last - first) / flips;
}

TEST(Rotation, FlipsOfAnAsymmetricBodyComeAtTheRightTimes) {
    for (const auto& [delta, exact] : {std::pair(1e-2, 20.7546097647), std::pair(1e-4, 36.7078194233)}) {
        double error[3], momentum, energy;
        const double h[3] = {0.2, 0.1, 0.05};
        for (int k = 0; k < 3; ++k) {
            error[k] = std::abs(flip_time(delta, h[k], 10, momentum, energy) - exact) / exact;
            EXPECT_LT(momentum, 1e-12 * 40.0 * 10.0 / h[k] / 10.0);
            EXPECT_LT(energy, 0.5 * h[k] * h[k]);
        }
        // order 2
        EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.2) << delta;
        EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.2) << delta;
        EXPECT_LT(error[2], 2e-3);
    }
}

TEST(Rotation, EnergyOscillatesWithoutATrend) {
    const Vec3 inertia(1.0, 2.0, 3.0), spin(0.1, 1.0, 0.05);
    const double energy = 0.5 * inertia.cwiseProduct(spin).dot(spin);
    double first = 0.0, second = 0.0;
    constexpr int kSteps = 200000;
    run(inertia, spin, 0.05, kSteps, [&](int k, const Bodies& b, double gain) {
        const double error = energy_of(b) - energy;
        EXPECT_NEAR(gain, error, 2e-15 * k);  // the ledger's entry, to the round-off of k steps
        (k <= kSteps / 2 ? first : second) += error / (kSteps / 2);
    });
    EXPECT_LT(std::abs(first - second), 1e-6 * energy);
}

TEST(Rotation, ThinPlatesAndNeedlesAtLargeStepsDoNotBlowUp) {
    for (const Vec3& inertia : {Vec3(1.0, 1.0 + 1e-3, 2.0), Vec3(1e-4, 1.0, 1.00005), Vec3(1.0, 1.7, 2.6)})
        for (const double angle : {0.3, 1.0, 3.0, 30.0}) {  // |w| h
            const Vec3 spin = Vec3(0.3, 0.8, 0.5).normalized();
            const Vec3 momentum = inertia.cwiseProduct(spin);
            const double least = 0.5 * momentum.squaredNorm() / inertia[2],
                         most = 0.5 * momentum.squaredNorm() / inertia[0];
            run(inertia, spin, angle, 20000, [&](int, const Bodies& b, double) {
                const double energy = energy_of(b);
                ASSERT_GE(energy, least * (1.0 - 1e-9));
                ASSERT_LE(energy, most * (1.0 + 1e-9));
                ASSERT_NEAR(b.orientation[0].norm(), 1.0, 1e-14);
                ASSERT_LT((angular_momentum(b.orientation[0], inertia, b.spin[0]) - momentum).norm(),
                          1e-8 * momentum.norm());
            });
        }
}

// A symmetric body precesses about L at |L| / I_1 and spins about its axis: no error of the step.
TEST(Rotation, SymmetricBodiesTurnExactly) {
    const Vec3 inertia(1.0, 1.0, 1.6), spin(0.4, 0.0, 2.0);
    const Vec3 momentum = inertia.cwiseProduct(spin);
    const double h = 0.7;
    const int steps = 50;
    run(inertia, spin, h, steps, [&](int k, const Bodies& b, double gain) {
        const Quat precession = turned(Quat::Identity(), k * h / inertia[0] * momentum);
        const Quat own = turned(Quat::Identity(), Vec3(0.0, 0.0, k * h * momentum.z() * (1.0 / 1.6 - 1.0)));
        EXPECT_LT(b.orientation[0].angularDistance(precession * own), 1e-12);
        EXPECT_LT(std::abs(gain), 1e-12);
    });
    // equal moments: a turn about the spin itself
    run(Vec3::Constant(2.0), spin, h, steps, [&](int k, const Bodies& b, double) {
        EXPECT_LT(b.orientation[0].angularDistance(turned(Quat::Identity(), k * h * spin)), 1e-12);
        EXPECT_EQ(b.spin[0], spin);
    });
}

TEST(Rotation, ForthAndBackIsWhereItBegan) {
    const Vec3 inertia(0.2, 1.0, 1.1), momentum(0.3, -0.5, 0.9);
    const Quat q = Quat(0.1, 0.5, -0.7, 0.3).normalized();
    const Quat there = rotated_freely(q, inertia, momentum, 0.37);
    EXPECT_GT(there.angularDistance(q), 0.1);
    EXPECT_LT(rotated_freely(there, inertia, momentum, -0.37).angularDistance(q), 1e-14);
    EXPECT_LT((inverse_inertia(q, inertia) * momentum - spin_of(q, inertia, momentum)).norm(), 1e-14);
}

}  // namespace
}  // namespace scree::solvers
