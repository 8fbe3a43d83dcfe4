// Hulls: against a slow hull of n^4 steps and slices of the points, with noise, duplicates, far away, and of points
// that have none.
#include "scenarios/shapes/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "tests/testing/slices.hpp"
#include "tests/testing/some_rotation.hpp"

namespace scree::scenarios {
namespace {

using testing::some_rotation;

std::vector<Vec3> cloud(std::uint64_t seed, int count) {
    Random random(seed, 1, 0);
    std::vector<Vec3> x;
    for (int k = 0; k < count; ++k) x.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    return x;
}
std::vector<Vec3> cube_corners() {
    std::vector<Vec3> x;
    for (int k = 0; k < 8; ++k) x.emplace_back(k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0);
    return x;
}
std::vector<Vec3> moved(std::vector<Vec3> x, const Quat& rotation, const Vec3& shift) {
    for (Vec3& v : x) v = rotation * v + shift;
    return x;
}

ShapeFault fault_of(const std::vector<Vec3>& points, const std::string& message) {
    try {
        convex_hull(points);
    } catch (const ShapeError& error) {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        return error.fault();
    }
    ADD_FAILURE() << "this was taken for a body";
    return {};
}

TEST(ConvexHull, RandomPointsAgreeWithTheSlowHullAndSlices) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const auto points = cloud(seed, 4 + static_cast<int>(seed));
        const auto placed = convex_hull(points);
        const auto slow = make_shape(testing::brute_hull(points));
        EXPECT_EQ(placed.shape.vertex.size(), slow.shape.vertex.size());
        EXPECT_EQ(placed.shape.face.size(), slow.shape.face.size());
        const auto oracle = testing::moments_by_slices(points);
        EXPECT_NEAR(placed.shape.volume / oracle.volume, 1.0, 1e-12);
        EXPECT_LT((placed.centre - oracle.centre).norm(), 1e-12);
        const Vec3 moments = testing::principal_moments(oracle.second);
        EXPECT_LT((placed.shape.inertia - moments).norm(), 1e-12 * moments.norm());
    }
}

void expect_order_does_not_matter(std::vector<Vec3> points) {
    const auto one = convex_hull(points);
    std::reverse(points.begin(), points.end());
    std::rotate(points.begin(), points.begin() + 41, points.end());
    const auto other = convex_hull(points);
    EXPECT_TRUE(one.shape.vertex == other.shape.vertex);
    EXPECT_EQ(one.shape.corner, other.shape.corner);
    EXPECT_EQ(one.centre, other.centre);
}

TEST(ConvexHull, TheOrderOfThePointsDoesNotMatter) {
    expect_order_does_not_matter(cloud(5, 200));
    std::vector<Vec3> grid;  // many points in each face, in every triangulation that the order makes
    for (int k = 0; k < 125; ++k) grid.emplace_back(k % 5, 2 * (k / 5 % 5), 3 * (k / 25));
    expect_order_does_not_matter(grid);
}

// A thousand points on the faces and edges of a cube, off by 1e-12, and each corner three times.
TEST(ConvexHull, NoisyCubeHasSixFaces) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        Random random(seed, 3, 0);
        auto points = cube_corners();
        for (int k = 0; k < 1000; ++k) {
            Vec3 x(random.uniform(), random.uniform(), random.uniform());
            const int axis = static_cast<int>(random.uniform(0, 3)), other = (axis + 1) % 3;
            x[axis] = std::round(x[axis]) + random.uniform(-1e-12, 1e-12);
            if (k % 4 == 0) x[other] = std::round(x[other]) + random.uniform(-1e-12, 1e-12);
            points.push_back(x);
        }
        for (int k = 0; k < 16; ++k)
            points.push_back(points[k % 8] +
                             1e-12 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
        for (const bool turned : {false, true}) {
            const auto placed = convex_hull(turned ? moved(points, some_rotation(seed), {7, 8, 9}) : points);
            EXPECT_EQ(placed.shape.vertex.size(), 8U);
            EXPECT_EQ(placed.shape.face.size(), 6U);
            EXPECT_NEAR(placed.shape.volume, 1.0, 1e-10);
        }
    }
}

// Noise just below the tolerance is merged too; the volume is right up to the noise.
TEST(ConvexHull, NoiseOfSinglePrecisionNeedsItsTolerance) {
    Random random(1, 3, 0);
    auto points = cube_corners();
    for (int k = 0; k < 200; ++k) {
        Vec3 x(random.uniform(), random.uniform(), random.uniform());
        x[k % 3] = std::round(x[k % 3]);
        points.push_back(x);
    }
    points = moved(points, some_rotation(4), {1.0, 2.0, 3.0});
    for (Vec3& x : points)
        for (int i = 0; i < 3; ++i) x[i] = static_cast<float>(x[i]);
    EXPECT_GT(convex_hull(points).shape.face.size(), 20U);
    const auto placed = convex_hull(points, kSinglePrecisionTolerance);
    EXPECT_EQ(placed.shape.face.size(), 6U);
    EXPECT_NEAR(placed.shape.volume, 1.0, 1e-6);
}

TEST(ConvexHull, FarAwayACubeIsACube) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Vec3 shift(5.4e5, 5.5e6, 2e3);
        const auto placed = convex_hull(moved(cube_corners(), some_rotation(seed), shift));
        EXPECT_EQ(placed.shape.face.size(), 6U);
        EXPECT_NEAR(placed.shape.volume, 1.0, 1e-8);
        EXPECT_LT((placed.centre - shift - some_rotation(seed) * Vec3(0.5, 0.5, 0.5)).norm(), 1e-8);
    }
}

TEST(ConvexHull, ManyPointsOnASphere) {
    Random random(2, 1, 0);
    std::vector<Vec3> points;
    for (int k = 0; k < 2000; ++k)
        points.push_back(Vec3(random.normal(), random.normal(), random.normal()).normalized());
    const auto placed = convex_hull(points);
    EXPECT_EQ(placed.shape.vertex.size(), 2000U);
    // mean volume of the hull of n random points (Miles 1971); the seed is fixed
    const double n = 2000.0, mean = (n - 1.0) * (n - 2.0) * (n - 3.0) / ((n + 1.0) * (n + 2.0) * (n + 3.0));
    EXPECT_NEAR(placed.shape.volume / (4.0 / 3.0 * std::numbers::pi * mean), 1.0, 5e-4);
}

TEST(ConvexHull, ThinNeedle) {
    std::vector<Vec3> points = cube_corners();
    for (Vec3& x : points) x = x.cwiseProduct(Vec3(1.0, 1e-6, 1e-6));
    const auto placed = convex_hull(moved(points, some_rotation(1), {1, 1, 1}));
    EXPECT_EQ(placed.shape.face.size(), 6U);
    EXPECT_NEAR(placed.shape.volume / 1e-12, 1.0, 1e-9);
}

TEST(NoHull, NamesWhatIsWrong) {
    EXPECT_EQ(fault_of({}, "0 points"), ShapeFault::too_few);
    EXPECT_EQ(fault_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "3 points, where at least 4"), ShapeFault::too_few);
    EXPECT_EQ(fault_of(std::vector<Vec3>(10, Vec3(1, 2, 3)), "only 1 of its 10 points"), ShapeFault::too_few);
    auto points = cube_corners();
    points[2].x() = INFINITY;
    EXPECT_EQ(fault_of(points, "point 2"), ShapeFault::not_finite);
    points.clear();
    for (int k = 0; k < 20; ++k) points.emplace_back(0.1 * k, 0.2 * k, 0.3 * k);
    EXPECT_EQ(fault_of(points, "its 20 points lie on one line"), ShapeFault::no_volume);
    points.clear();
    for (int k = 0; k < 20; ++k) points.emplace_back(std::cos(k), std::sin(k), 3.0 + 1e-9 * (k % 3));
    EXPECT_EQ(fault_of(points, "its 20 points lie in one plane"), ShapeFault::no_volume);
    EXPECT_EQ(fault_of(moved(points, some_rotation(3), {4, 5, 6}), "its 20 points lie in one plane"),
              ShapeFault::no_volume);
}

// No size between flat and solid is let through half way: a box of any thickness is a body of six faces or refused.
TEST(NoHull, EveryThicknessIsABodyOrRefused) {
    int bodies = 0, refused = 0;
    for (double thickness = 1e-12; thickness < 1e-3; thickness *= 1.37) {
        auto points = cube_corners();
        for (Vec3& x : points) x.z() *= thickness;
        try {
            const auto placed = convex_hull(moved(points, some_rotation(8), {0.3, 0.2, 0.1}));
            EXPECT_EQ(placed.shape.face.size(), 6U) << thickness;
            EXPECT_NEAR(placed.shape.volume / thickness, 1.0, 1e-7);
            ++bodies;
        } catch (const ShapeError& error) {
            EXPECT_EQ(error.fault(), ShapeFault::no_volume);
            EXPECT_LT(thickness, 1e-7);
            ++refused;
        }
    }
    EXPECT_GT(bodies, 20);
    EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace scree::scenarios
