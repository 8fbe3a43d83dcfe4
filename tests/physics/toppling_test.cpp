// When blocks and stacks of blocks fall over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::box;
using testing::kGravity;
using testing::World;

constexpr double kDegree = std::numbers::pi / 180.0;

// `count` blocks on each other on a floor.
void stack(World& w, int count, const Vec3& sides) {
    for (int i = 0; i < count; ++i) w.add(box(sides), Vec3(0, 0, sides.z() * (i + 0.5)));
    w.add_floor();
}
Vec3 leaning(double angle) {
    return kGravity * Vec3(std::sin(angle), 0.0, -std::cos(angle));
}

// A stack of n blocks b x H with mu > b / nH falls as one at atan(b / nH). 0.05 degrees off, growing as cosh(p t) with
// p^2 = 3 g / 4R, p > 3.5 / s, are 8.7e-4 cosh(10.5) = 16 rad after three seconds: it lies.
TEST(Toppling, AStackFallsAsOneAtTheAngleOfItsDiagonal) {
    for (const int count : {1, 2, 4})
        for (const double off : {-0.05, 0.05}) {
            SCOPED_TRACE(count);
            SCOPED_TRACE(off);
            const Vec3 sides(0.2, 0.2, 0.8 / count);
            World w(1e-3, 0.9);
            w.standard_settings();
            stack(w, count, sides);
            w.gravity(leaning(std::atan(0.2 / 0.8) + off * kDegree));
            w.run(3000);
            if (off < 0.0)
                EXPECT_LT(w.fastest(), 1e-4);
            else
                EXPECT_LT(w.state.bodies.position.back().z(), 0.3);
        }
}

// Below b / H it is friction that fails first, at atan(mu).
TEST(Toppling, AStackSlidesIfFrictionIsLess) {
    for (const double off : {-0.05, 0.05}) {
        World w(1e-3, 0.2);
        w.standard_settings();
        stack(w, 2, Vec3(0.2, 0.2, 0.4));
        w.gravity(leaning(std::atan(0.2) + off * kDegree));
        w.run(3000);
        if (off < 0.0) {
            EXPECT_LT(w.fastest(), 1e-4);
        } else {
            // g (sin - mu cos) = g sin(off) / cos(atan mu) for 3 s
            const double speed = 3.0 * kGravity * std::sin(off * kDegree) * std::hypot(1.0, 0.2);
            EXPECT_NEAR(w.velocity(0).x(), speed, 0.05 * speed);
        }
    }
}

// Gravity leans more and more, 0.5 degrees a second, from 0.5 degrees below the angle of fall on. What is then over
// drives th'' = p^2 (th + rate t), th = rate / p (sinh(p t) - p t): with p = 4.2 / s, 1e-3 rad take 0.33 s, 0.17
// degrees.
TEST(Toppling, ATiltedBlockFallsOnTime) {
    const double rate = 0.5 * kDegree, first = std::atan(0.25) - 0.5 * kDegree;
    World w(1e-3, 0.9);
    w.standard_settings();
    stack(w, 1, Vec3(0.2, 0.2, 0.8));
    TimeTable tilt;
    for (int k = 0; k <= 300; ++k) {
        tilt.time.push_back(0.01 * k);
        tilt.value.push_back(leaning(first + rate * tilt.time.back()));
    }
    w.scene.gravity = tilt;
    w.start();
    const Quat start = w.state.bodies.orientation[0];
    while (w.state.time < 3.0 && w.state.bodies.orientation[0].angularDistance(start) < 1e-3) w.step();
    const double over = w.state.time - 1.0;
    EXPECT_NEAR(over, 0.33, 0.1);
}

// Blocks of length L, each beyond the one below by L / 2k, k from the top: 1.0417 L beyond the edge of the table with
// four.
TEST(Overhang, TheHarmonicStackStandsBelowItsLimitAndFallsAbove) {
    const double length = 1.0, height = 0.1;
    const int count = 4;
    for (const double share : {0.99, 1.01}) {
        World w(1e-3, 0.6);
        w.standard_settings();
        double end = 0.0;  // of the block [m], from the edge of the table
        for (int k = count; k >= 1; --k) {
            end += share * length / (2 * k);
            w.add(box(Vec3(length, 0.3, height)), Vec3(end - 0.5 * length, 0.0, height * (count - k + 0.5)));
        }
        w.add(box(Vec3(4, 1, 1)), Vec3(-2, 0, -0.5));  // the table
        w.add_wall(PlaneWall{Vec3(0, 0, -1), Vec3::UnitZ()});
        const double top = w.position(3).z();
        w.start();
        if (share < 1.0) {
            w.run(2000);
            double fastest = 0.0;
            for (int k = 2000; k < 10000; ++k) {
                w.step();
                fastest = std::max(fastest, w.fastest());
            }
            EXPECT_LT(fastest, 1e-4);
            EXPECT_NEAR(w.position(3).z(), top, 1e-4);
        } else {
            w.run(4000);
            EXPECT_LT(w.position(3).z(), top - 0.2);
        }
    }
}

}  // namespace
}  // namespace scree
