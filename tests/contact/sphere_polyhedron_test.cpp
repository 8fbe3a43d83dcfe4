// Spheres and convex polyhedra against a search through all faces, edges and vertices.
#include "contact/polyhedra/sphere_polyhedron.hpp"

#include <gtest/gtest.h>

#include "tests/testing/slow_polyhedra.hpp"

namespace scree::contact {
namespace {

using testing::Body;

// Signed distance of x from the surface, and the way from it, out of the body.
testing::SlowGap slow_point(const Placed& body, const Vec3& centre) {
    const Vec3 x = centre - body.position;
    const double outside = testing::slow_outside(body, centre);
    Vec3 best = Vec3::Constant(1e100), d;
    const auto take = [&](const Vec3& way) {
        if (way.norm() < best.norm()) best = way;
    };
    for (std::size_t f = 0; f < body.normal.size(); ++f) {
        if (testing::foot_within(body, f, x, d)) take(d);
    }
    for (const auto& e : body.shape->edge)
        take(testing::between_segments(x, x, body.vertex[e.from], body.vertex[e.to]));
    return outside > 0.0 ? testing::SlowGap{best.norm(), best.normalized()}
                         : testing::SlowGap{-best.norm(), -best.normalized()};
}

std::vector<ConvexShape> shapes() {
    Random random(5, 1, 0);
    return {testing::box_shape({1.0, 0.8, 0.5}), testing::tetrahedron_shape(1.0),
            testing::rock_shape(12, {0.7, 0.6, 0.5}, random), testing::rock_shape(30, {0.7, 0.6, 0.5}, random),
            testing::box_shape({3.0, 3.0, 0.03})};
}

TEST(SpherePolyhedron, DistanceAndDepth) {
    int inside = 0, regions[3] = {0, 0, 0};
    for (const ConvexShape& shape : shapes()) {
        for (std::uint64_t i = 0; i < 2000; ++i) {
            Random random(5, 2, i);
            const Body body(shape, 3.0 * testing::random_direction(random), testing::random_turn(random));
            const Vec3 centre =
                body.placed.position + random.uniform(0.0, 1.5) * shape.radius * testing::random_direction(random);
            const double radius = random.uniform(0.0, 0.5);
            const testing::SlowGap slow = slow_point(body, centre);
            const SpherePolyhedronGap fast = sphere_polyhedron(centre, radius, body);
            ASSERT_NEAR(fast.gap, slow.gap - radius, 1e-13);
            ASSERT_NEAR(fast.normal.norm(), 1.0, 1e-15);
            if (slow.gap > 1e-4) {
                ASSERT_LT((fast.normal - slow.normal).norm(), 1e-10);
            }
            if (slow.gap < 0.0) {
                ASSERT_NEAR(testing::slow_outside(body, centre - slow.gap * fast.normal), 0.0, 1e-13);
            }
            ++(slow.gap < 0.0 ? inside : regions[static_cast<int>(fast.region)]);
        }
    }
    EXPECT_GT(inside, 100);
    for (const int seen : regions) EXPECT_GT(seen, 100);
}

// Along a line the gap changes by at most the way, and outside the normal turns by at most way / distance.
TEST(SpherePolyhedron, ContinuousAcrossRegions) {
    for (const ConvexShape& shape : shapes()) {
        for (std::uint64_t i = 0; i < 50; ++i) {
            Random random(5, 3, i);
            const Body body(shape, Vec3::Zero(), testing::random_turn(random));
            Vec3 x = 1.2 * shape.radius * testing::random_direction(random);
            const Vec3 step = (1.2 * shape.radius * testing::random_direction(random) - x) / 1000.0;
            SpherePolyhedronGap before = sphere_polyhedron(x, 0.1, body);
            for (int k = 0; k < 1000; ++k) {
                x += step;
                const SpherePolyhedronGap now = sphere_polyhedron(x, 0.1, body);
                ASSERT_LE(std::abs(now.gap - before.gap), step.norm() + 1e-14);
                const double distance = std::min(now.gap, before.gap) + 0.1;
                if (distance > 0.0) {
                    ASSERT_LE((now.normal - before.normal).norm(), step.norm() / distance + 1e-12);
                }
                before = now;
            }
        }
    }
}

TEST(SpherePolyhedron, CentreOnAFeature) {
    const ConvexShape shape = testing::box_shape({2.0, 2.0, 2.0});
    const Body body(shape, {5.0, 0.0, 0.0}, Quat::Identity());
    const Vec3 at[] = {{6.0, 0.3, 0.2}, {6.0, 1.0, 0.2}, {6.0, 1.0, 1.0}, {5.0, 0.0, 0.0}};
    const double gap[] = {-0.25, -0.25, -0.25, -1.25};
    for (std::size_t i = 0; i < 4; ++i) {
        const SpherePolyhedronGap found = sphere_polyhedron(at[i], 0.25, body);
        EXPECT_NEAR(found.gap, gap[i], 1e-15);
        EXPECT_NEAR(found.normal.norm(), 1.0, 1e-15);
    }
    // a hair away from an edge and a corner
    EXPECT_GT(sphere_polyhedron({6.0 + 1e-15, 1.0 + 1e-15, 0.2}, 0.25, body).normal.dot(Vec3(1.0, 1.0, 0.0)), 0.9);
    EXPECT_GT(sphere_polyhedron({6.0 + 1e-15, 1.0 + 1e-15, 1.0 + 1e-15}, 0.25, body).normal.sum(), 0.9);
}

TEST(SpherePolyhedron, KeysNameRegions) {
    const ConvexShape shape = testing::box_shape({2.0, 2.0, 2.0});
    const Body body(shape, Vec3::Zero(), Quat::Identity());
    const auto key = [&](double x, double y, double z) { return sphere_polyhedron({x, y, z}, 0.5, body).key(); };
    EXPECT_EQ(key(1.2, 0.1, 0.2), key(1.3, -0.4, 0.9));
    EXPECT_EQ(key(1.2, 1.1, 0.2), key(1.1, 1.3, -0.9));
    EXPECT_EQ(key(1.2, 1.1, 1.2), key(1.3, 1.3, 1.01));
    EXPECT_NE(key(1.2, 0.1, 0.2), key(1.2, 1.1, 0.2));
    EXPECT_NE(key(1.2, 1.1, 0.2), key(1.2, 1.1, 1.2));
    EXPECT_NE(key(1.2, 0.1, 0.2), key(-1.2, 0.1, 0.2));
}

}  // namespace
}  // namespace scree::contact
