// A ball dropped on a plane. Where an impact falls inside a step changes the error of a single run by its whole size,
// so the order is that of the mean over many heights.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::bouncing_end;
using testing::bouncing_height;
using testing::kGravity;
using testing::World;

constexpr double kRadius = 0.1;

void drop(World& w, double height) {
    w.add(Vec3(0, 0, height + kRadius), kRadius);
    w.add_floor();
}

// (1/T) integral over T = 2 s of |q - q_exact|, by the midpoints of the steps, where the ball is at the mean of its
// ends; the deepest penetration over v h in `deepest`, v the largest speed so far.
double mean_error(double height, double e, double step, double& deepest) {
    World w(step, 0.0, e);
    drop(w, height);
    const int steps = static_cast<int>(std::round(2.0 / step));
    double sum = 0.0, speed = 0.0;
    for (int k = 0; k < steps; ++k) {
        speed = std::max(speed, std::abs(w.velocity().z()));
        w.step();
        const double q = w.position().z() - kRadius;
        sum += std::abs(q - bouncing_height(height, e, w.state.time)) * step;
        deepest = std::max(deepest, -q / ((speed + kGravity * step) * step));
    }
    return sum / 2.0;
}

class BouncingBall : public ::testing::TestWithParam<double> {};

TEST_P(BouncingBall, FirstOrderInTheStepOnAverageOverPhases) {
    const double e = GetParam();
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, deepest = 0.0;
    int n = 0;
    for (double h = 1.6e-2; h > 0.9e-3; h /= 2.0, ++n) {  // five step sizes
        double error = 0.0;
        for (int phase = 0; phase < 64; ++phase) error += mean_error(1.0 + 0.2 * phase / 64.0, e, h, deepest) / 64.0;
        const double x = std::log(h), y = std::log(error);
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
        // the error itself: half a step of the speed of impact, summed over at most T of flight
        EXPECT_LT(error, 5.0 * h);
    }
    ASSERT_EQ(n, 5);
    const double order = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_GE(order, 0.85);
    EXPECT_LE(order, 1.15);
    // half a step at the speed of the approach: the contact is looked for at the middle of the step
    EXPECT_LE(deepest, 0.5);
}
INSTANTIATE_TEST_SUITE_P(Restitution, BouncingBall, ::testing::Values(0.0, 0.5, 0.9));

TEST(BouncingBallRest, RestsAfterInfinitelyManyBounces) {
    for (const double e : {0.0, 0.5, 0.9})
        for (const double h : {1e-3, 7.3e-3}) {
            World w(h, 0.0, e);
            drop(w, 1.0);
            // each of the ln(2 g h / v1) / ln e bounces can be late by a step
            const double late = 2.0 * h * std::max(1.0, std::log(2.0 * h) / std::log(std::max(e, 0.1)));
            while (w.state.time < bouncing_end(1.0, e) + late) w.step();
            // what is left of the last impact's speed dies out by e a step
            double speed = kGravity * h;
            for (int k = 0; k < 400; ++k) {
                w.step();
                ASSERT_LE(std::abs(w.velocity().z()), speed * (1.0 + 1e-9)) << "e " << e << " h " << h;
                speed = std::max(std::abs(w.velocity().z()), 1e-14);
            }
            EXPECT_LE(speed, 1e-14);
            const double q = w.position().z();
            // on the floor, but for the penetration of the last impact
            EXPECT_LE(std::abs(q - kRadius), 0.5 * h * std::sqrt(2.0 * kGravity));
            EXPECT_LT(w.state.ledger.drift(), 1e-12);
        }
}

// The middle of the step is at rest in the ball's parabola: E is conserved by each flight and each impact.
TEST(BouncingBallElastic, KeepsItsEnergyOverAHundredBounces) {
    for (const double h : {1e-2, 1e-3}) {
        World w(h, 0.0, 1.0);
        drop(w, 1.0);
        w.start();
        const double start = w.energy();
        int bounces = 0;
        for (int k = 0; bounces < 100 && k < 200000; ++k) {
            const double before = w.velocity().z();
            w.step();
            if (before < 0.0 && w.velocity().z() > 0.0) ++bounces;
        }
        EXPECT_EQ(bounces, 100);
        EXPECT_NEAR(w.energy() / start, 1.0, 1e-12);
    }
}

// e = 1 is never held back, however slow: a ball that hops less than a step's fall high goes on hopping.
TEST(BouncingBallElastic, SmallHopsKeepTheirEnergyToo) {
    World w(1e-2, 0.0, 1.0);
    drop(w, 1e-3);  // falls with 0.14 m/s; gravity gives 0.098 m/s in a step
    w.start();
    const double start = w.energy();
    w.run(1000);
    EXPECT_NEAR(w.energy() / start, 1.0, 1e-12);
}

TEST(BouncingBallCorrection, PenetrationIsGivenBackWithoutSpeed) {
    World w(1e-2, 0.0, 0.0);
    w.scene.correction.on = true;
    drop(w, 1.0);
    w.run(46);
    ASSERT_LT(w.position().z(), kRadius - 1e-4) << "the impact must leave some penetration for this test";
    w.run(100);
    EXPECT_NEAR(w.position().z(), kRadius, 1e-12 * kRadius + 2e-13);  // below 1e-12 of the diameter it is left
    EXPECT_NEAR(w.velocity().z(), 0.0, 1e-15);
    EXPECT_GT(w.state.ledger[Work::correction], 0.0);
    EXPECT_LT(w.state.ledger.drift(), 1e-12);
}

}  // namespace
}  // namespace scree
