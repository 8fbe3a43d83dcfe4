// Convex polyhedra in the positions that geometry likes least: parallel faces and edges, vertices on vertices, equal
// places, needles and plates.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <set>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "tests/testing/polyhedra_pair.hpp"
#include "tests/testing/slow_polyhedra.hpp"

namespace scree::contact {
namespace {

using testing::about;
using testing::Body;
using testing::touch;

constexpr double kPi = std::numbers::pi;

std::set<FeatureKey> keys(const Manifold& m) {
    std::set<FeatureKey> all;
    for (const ManifoldPoint& p : m.points()) all.insert(p.key);
    return all;
}

void expect_sound(const Manifold& m) {
    for (const ManifoldPoint& p : m.points()) {
        EXPECT_TRUE(p.point.allFinite());
        EXPECT_TRUE(std::isfinite(p.gap));
        EXPECT_NEAR(p.normal.norm(), 1.0, 1e-14);
    }
    EXPECT_EQ(keys(m).size(), static_cast<std::size_t>(m.count));
}

class Cubes : public ::testing::Test {
  protected:
    ConvexShape cube = testing::box_shape({1.0, 1.0, 1.0});
};

// A cube on an equal one, tilted a little about any axis, above it or sunk in: four points, the same four all the time.
TEST_F(Cubes, NearlyParallelFaces) {
    const Body lower(cube, Vec3::Zero(), Quat::Identity());
    for (const double angle : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
        for (const double gap : {-1e-4, 0.0, 1e-6, 1e-4}) {
            for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0.3, -1, 0.2), Vec3(0, 0, 1)}) {
                const Body upper(cube, {0.2, 0.1, 1.0 + gap}, about(axis, angle));
                const Manifold m = touch(upper, lower, 2e-3);
                expect_sound(m);
                ASSERT_EQ(m.count, 4) << angle << " " << gap << " " << axis.transpose();
                for (const ManifoldPoint& p : m.points()) {
                    EXPECT_LT((p.normal - Vec3::UnitZ()).norm(), angle + 1e-14);
                    EXPECT_NEAR(p.gap, gap, 0.8 * angle + 1e-14);
                }
                EXPECT_NEAR(m.area, 0.8 * 0.9, 3.0 * angle + 1e-12);
                const Body level(cube, {0.2, 0.1, 1.0 + gap}, Quat::Identity());
                EXPECT_EQ(keys(m), keys(touch(level, lower, 2e-3))) << angle << " " << gap << " " << axis.transpose();
            }
        }
    }
}

// Exactly one above the other, and that up to round-off: corners on corners keep their keys.
TEST_F(Cubes, AlignedStackKeepsItsKeys) {
    const Body lower(cube, Vec3::Zero(), Quat::Identity());
    const std::set<FeatureKey> level = keys(touch(Body(cube, {0.0, 0.0, 1.0}, Quat::Identity()), lower, 1e-3));
    EXPECT_EQ(level.size(), 4U);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        Random random(31, 1, i);
        const double noise = std::pow(10.0, random.uniform(-17.0, -5.5));
        const Vec3 shift = noise * testing::random_direction(random);
        const Body upper(cube, Vec3(0.0, 0.0, 1.0) + shift, about(testing::random_direction(random), noise));
        const Manifold m = touch(upper, lower, 1e-3);
        ASSERT_EQ(keys(m), level) << noise;
        EXPECT_NEAR(m.area, 1.0, 5e-5);
    }
}

TEST_F(Cubes, TiltingChangesPointsOneByOne) {
    const ConvexShape plate = testing::box_shape({3.0, 3.0, 1.0});
    const Body lower(plate, Vec3::Zero(), Quat::Identity());
    const double margin = 0.01;
    Manifold before;
    for (int k = -4000; k <= 4000; ++k) {  // through level, on an edge on either side
        const double angle = 1e-5 * k, high = 0.5 * (std::cos(angle) + std::sin(std::abs(angle)));
        const Manifold m = touch(Body(cube, {0.3, 0.0, 0.5 + high - 1e-3}, about({0, 1, 0}, angle)), lower, margin);
        expect_sound(m);
        ASSERT_GE(m.count, 2);
        for (const ManifoldPoint& p : before.points()) {  // none is lost but at the margin
            if (k == -4000 || p.gap > margin - 2e-5) continue;
            double nearest = 1.0;
            for (const ManifoldPoint& q : m.points()) nearest = std::min(nearest, (q.point - p.point).norm());
            ASSERT_LT(nearest, 3e-5) << k;
        }
        before = m;
    }
}

TEST_F(Cubes, CrossedEdges) {
    // both on edge, turned about the vertical against one another
    for (const double gap : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3}) {
        for (const double turn : {0.25 * kPi, 0.5 * kPi, 0.1, 1e-3}) {
            const Quat on_edge = about({1, 0, 0}, 0.25 * kPi);
            const Body upper(cube, {0, 0, std::sqrt(2.0) + gap}, about({0, 0, 1}, turn) * on_edge);
            const Body lower(cube, Vec3::Zero(), on_edge);
            const Manifold m = touch(upper, lower, 1.5e-3);
            expect_sound(m);
            ASSERT_GE(m.count, 1);
            EXPECT_LT((m.item[0].normal - Vec3::UnitZ()).norm(), 1e-9) << gap << " " << turn;
            bool middle = false;
            for (const ManifoldPoint& p : m.points()) {
                middle = middle || ((p.point - Vec3(0, 0, 0.5 * std::sqrt(2.0) + 0.5 * gap)).norm() < 1e-9 &&
                                    std::abs(p.gap - gap) < 1e-12);
            }
            EXPECT_TRUE(middle) << gap << " " << turn;
            if (turn > 0.05) {
                EXPECT_EQ(m.count, 1);
            }
        }
    }
}

TEST_F(Cubes, ParallelEdges) {
    const Quat on_edge = about({1, 0, 0}, 0.25 * kPi);
    for (const double turn : {0.0, 1e-16, 1e-13, 1e-11, 1e-9, 1e-8}) {
        for (const double gap : {1e-3, 1e-6, 1e-9}) {
            const Body upper(cube, {0.3, 0, std::sqrt(2.0) + gap}, about({0, 0, 1}, turn) * on_edge);
            const Body lower(cube, Vec3::Zero(), on_edge);
            const Manifold m = touch(upper, lower, 2e-3);
            expect_sound(m);
            ASSERT_GE(m.count, 2) << turn << " " << gap;
            double least = 1.0, most = -1.0;  // the ends of the common edge
            for (const ManifoldPoint& p : m.points()) {
                least = std::min(least, p.point.x()), most = std::max(most, p.point.x());
            }
            EXPECT_NEAR(least, -0.2, 1e-5);
            EXPECT_NEAR(most, 0.5, 1e-5);
            EXPECT_GT(m.item[0].normal.z(), gap > 1e-8 * 100 ? 0.999 : 0.7) << turn << " " << gap;
        }
        // sunk in there is no normal of edges: that of a face, or of the edges where they cross
        const Body sunk(cube, {0.3, 0, std::sqrt(2.0) - 1e-3}, about({0, 0, 1}, turn) * on_edge);
        const Manifold m = touch(sunk, Body(cube, Vec3::Zero(), on_edge), 2e-3);
        expect_sound(m);
        ASSERT_GE(m.count, 2);
        EXPECT_GT(m.item[0].normal.z(), 0.7);
    }
}

TEST_F(Cubes, VertexOnVertexAndOnEdge) {
    const Vec3 across = Vec3(1, 1, 1).cross(Vec3::UnitZ());  // a turn about it puts the cube on a corner
    const Quat on_corner = about(across, std::acos(std::sqrt(1.0 / 3.0)));
    const double half_diagonal = 0.5 * std::sqrt(3.0);
    for (const double gap : {-1e-3, -1e-12, 0.0, 1e-15, 1e-12, 1e-6, 1e-3}) {
        const Body upper(cube, {0, 0, 2.0 * half_diagonal + gap}, about(across, std::acos(-std::sqrt(1.0 / 3.0))));
        const Manifold vertices = touch(upper, Body(cube, Vec3::Zero(), on_corner), 2e-3);
        expect_sound(vertices);
        ASSERT_GE(vertices.count, 1) << gap;
        for (const ManifoldPoint& p : vertices.points()) {
            EXPECT_LT((p.point - Vec3(0, 0, half_diagonal + 0.5 * gap)).norm(), 6e-3);
            EXPECT_GT(p.normal.z(), 0.3);  // in the cone of the normals
        }
        const Body edge(cube, {0, 0, half_diagonal + std::sqrt(0.5) + gap}, about({1, 0, 0}, 0.25 * kPi));
        const Manifold on_edge = touch(edge, Body(cube, Vec3::Zero(), on_corner), 2e-3);
        expect_sound(on_edge);
        ASSERT_GE(on_edge.count, 1) << gap;
        for (const ManifoldPoint& p : on_edge.points()) EXPECT_GT(p.normal.z(), 0.3);
    }
}

TEST_F(Cubes, EqualPlaces) {
    const ConvexShape small = testing::box_shape({0.1, 0.2, 0.3}), needle = testing::box_shape({10.0, 0.1, 0.1});
    for (const ConvexShape* other : std::initializer_list<const ConvexShape*>{&cube, &small, &needle}) {
        for (const double turn : {0.0, 1e-9, 0.3}) {
            const Body a(*other, {3, 4, 5}, about({1, 2, 3}, turn)), b(cube, {3, 4, 5}, Quat::Identity());
            const Manifold m = touch(a, b, 0.0);
            expect_sound(m);
            ASSERT_GE(m.count, 1);
            double least = 0.0;
            for (const ManifoldPoint& p : m.points()) least = std::min(least, p.gap);
            EXPECT_NEAR(least, testing::slow_gap(a, b).gap, 1e-12);
        }
    }
}

TEST(PolyhedraDegenerate, NeedlesAndPlates) {
    const std::vector<ConvexShape> shapes = {testing::box_shape({100.0, 1.0, 1.0}),
                                             testing::box_shape({100.0, 100.0, 1.0}),
                                             testing::box_shape({1.0, 1.0, 1e-6}), testing::box_shape({1.0, 1.0, 1.0})};
    for (std::uint64_t i = 0; i < 2000; ++i) {
        Random random(31, 2, i);
        const auto pick = [&]() -> const ConvexShape& {
            return shapes[static_cast<std::size_t>(4.0 * random.uniform())];
        };
        const ConvexShape &sa = pick(), &sb = pick();
        Body a(sa, Vec3::Zero(), testing::random_turn(random));
        const Body b(sb, Vec3::Zero(), testing::random_turn(random));
        a.placed.position = random.uniform(0.0, 0.2) * (sa.radius + sb.radius) * testing::random_direction(random);
        const double size = sa.radius + sb.radius, exact = testing::slow_gap(a, b).gap;
        const Manifold m = touch(a, b, 0.1 * size);
        expect_sound(m);
        ASSERT_EQ(m.count > 0, exact <= 0.1 * size) << i;
        double least = 1e300;
        for (const ManifoldPoint& p : m.points()) least = std::min(least, p.gap);
        if (m.count > 0) {
            ASSERT_NEAR(least, exact, 1e-12 * size) << i;
        }
    }
}

// A guess of the separating axis, good or bad, changes no bit.
TEST(PolyhedraDegenerate, GuessesLeaveNoTrace) {
    const ConvexShape cube = testing::box_shape({1.0, 1.0, 1.0});
    PolyhedraScratch scratch;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        Random random(31, 3, i);
        const Body a(cube, 1.3 * testing::random_direction(random), testing::random_turn(random));
        const Body b(cube, Vec3::Zero(), testing::random_turn(random));
        Manifold one, two;
        Vec3 none = Vec3::Zero(),
             guess = i % 2 == 0 ? testing::random_direction(random) : a.placed.position.normalized();
        const bool first = polyhedron_polyhedron(a, b, 0.05, none, scratch, one);
        ASSERT_EQ(first, polyhedron_polyhedron(a, b, 0.05, guess, scratch, two));
        ASSERT_EQ(one.count, two.count);
        for (std::size_t k = 0; k < static_cast<std::size_t>(one.count); ++k) {
            ASSERT_EQ(one.item[k].point, two.item[k].point);
            ASSERT_EQ(one.item[k].key, two.item[k].key);
        }
    }
}

}  // namespace
}  // namespace scree::contact
