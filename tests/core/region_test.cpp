#include "core/region.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/random.hpp"

namespace scree {
namespace {

const Region kBox = BoxRegion{Vec3(-1, 0, 2), Vec3(1, 3, 2.5)};
const Region kCylinder = CylinderRegion{Vec3(1, 2, 3), Vec3(2, -1, 2).normalized(), 0.75, 2.0};
const Region kSphere = SphereRegion{Vec3(0.5, -0.5, 1.0), 1.25};
const Region kHalfSpace = HalfSpaceRegion{Vec3(0, 0, 1), Vec3(0, 0, 1)};

// Volume as the share of random points of the bounds that are inside: ties `contains`, `bounds` and `volume` together.
double sampled_volume(const Region& region, int samples) {
    const BoxRegion box = bounds(region);
    Random random(7, 0, 0);
    int inside = 0;
    for (int i = 0; i < samples; ++i) {
        Vec3 x;
        for (int axis = 0; axis < 3; ++axis) x[axis] = random.uniform(box.lower[axis], box.upper[axis]);
        inside += contains(region, x) ? 1 : 0;
    }
    return (box.upper - box.lower).prod() * inside / samples;
}

TEST(Region, VolumeAgreesWithMembership) {
    for (const Region& region : {kBox, kCylinder, kSphere}) {
        // 2e5 samples: standard error of the share below 1.2e-3, of the volume below 0.5 %
        EXPECT_NEAR(sampled_volume(region, 200000) / volume(region), 1.0, 0.02);
    }
    EXPECT_TRUE(std::isinf(volume(kHalfSpace)));
}

TEST(Region, BordersBelongToIt) {
    EXPECT_TRUE(contains(kBox, Vec3(1, 3, 2.5)));
    EXPECT_FALSE(contains(kBox, Vec3(1, 3, 2.5000001)));
    EXPECT_TRUE(contains(kHalfSpace, Vec3(50, -7, 1)));
    EXPECT_FALSE(contains(kHalfSpace, Vec3(0, 0, 1.0000001)));
    EXPECT_TRUE(contains(Region(SphereRegion{Vec3::Zero(), 2.0}), Vec3(0, -2, 0)));
}

TEST(Region, BoundsOfAStraightCylinderAreExact) {
    const BoxRegion box = bounds(CylinderRegion{Vec3(1, 2, 3), Vec3::UnitY(), 0.5, 4.0});
    EXPECT_EQ(box.lower, Vec3(0.5, 2.0, 2.5));
    EXPECT_EQ(box.upper, Vec3(1.5, 6.0, 3.5));
}

TEST(Region, TranslationMovesMembership) {
    const Vec3 shift(10, -20, 30);
    Random random(3, 0, 0);
    for (const Region& region : {kBox, kCylinder, kSphere, kHalfSpace}) {
        const Region moved = translated(region, shift);
        for (int i = 0; i < 200; ++i) {
            const Vec3 x(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 5));
            EXPECT_EQ(contains(region, x), contains(moved, x + shift));
        }
    }
}

}  // namespace
}  // namespace scree
