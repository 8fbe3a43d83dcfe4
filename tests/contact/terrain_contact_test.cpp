// Spheres on terrain: against the distance to all its triangles, behind it, at its border, and what near means.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact/polyhedra/sphere_triangle.hpp"
#include "contact/walls/nearest_place.hpp"
#include "contact/walls/wall_contact.hpp"
#include "core/terrain.hpp"
#include "tests/testing/height_grid.hpp"

namespace scree::contact {
namespace {

using testing::flat_grid;
using testing::kNoData;
using testing::noisy_grid;
using testing::wall_of;

const Terrain& terrain_of(const WallShape& shape) {
    return *std::get<TerrainWall>(shape).terrain;
}

WallContacts touch(const WallShape& shape, const Vec3& centre, double radius, double margin = 0.0) {
    WallContacts found;
    find_contacts(shape, centre, radius, margin, found);
    return found;
}

double least_gap(const WallContacts& found) {
    double least = kForever;
    for (int k = 0; k < found.count; ++k) least = std::min(least, found.item[static_cast<std::size_t>(k)].gap);
    return least;
}

double slow_distance(const Terrain& terrain, const Vec3& x) {
    double least = kForever;
    for (std::uint32_t t = 0; t < terrain.mesh.triangle.size(); ++t)
        least = std::min(least, (x - detail::nearest_place(terrain.mesh, t, x).foot).norm());
    return least;
}

double ground(const Terrain& terrain, double x, double y) {
    const auto t = terrain.column(x, y);
    const auto& tri = terrain.mesh.triangle[*t];
    const Vec3& p = terrain.mesh.vertex[tri.corner[0]];
    return p.z() - (tri.normal.x() * (x - p.x()) + tri.normal.y() * (y - p.y())) / tri.normal.z();
}

TEST(TerrainContact, TheDistanceToAllTriangles) {
    for (const bool closed : {false, true}) {
        HeightGrid grid = noisy_grid(13, 0.5, 0.6, 5);
        for (std::size_t k : {20U, 21U, 77U, 90U}) grid.height[k] = kNoData;
        const WallShape shape = wall_of(grid, closed ? TerrainBorder::closed : TerrainBorder::open);
        const Terrain& terrain = terrain_of(shape);
        int outside = 0, behind = 0;
        for (std::uint64_t i = 0; i < 6000; ++i) {
            Random random(41, closed, i);
            const Vec3 x(random.uniform(-3.4, 3.4), random.uniform(-3.4, 3.4), random.uniform(-1.0, 1.6));
            const double radius = random.uniform(0.02, 1.0), margin = random.uniform(0.0, 0.3);
            if (terrain.outside(x)) continue;
            const double distance = slow_distance(terrain, x);
            const WallContacts found = touch(shape, x, radius, margin);
            const bool over_hole = !terrain.column(x.x(), x.y());
            if (terrain.under(x)) {
                ++behind;
                ASSERT_EQ(found.count, 1);
                ASSERT_LE(found.item[0].gap, -distance - radius + 1e-12);
                if (distance < 2.0 * radius) {
                    ASSERT_NEAR(found.item[0].gap, -distance - radius, 1e-12);
                }
                if (distance < 2.0 * radius) {  // as far as that is on the surface
                    const Vec3 out = x - (found.item[0].gap + radius) * found.item[0].normal;
                    ASSERT_LT(slow_distance(terrain, out), 1e-12) << i;
                }
                continue;
            }
            if (over_hole && closed) continue;  // behind its walls
            ++outside;
            if (distance - radius > margin) {
                ASSERT_EQ(found.count, 0) << i;
            } else if (distance - radius < margin - 1e-12) {
                ASSERT_NEAR(least_gap(found), distance - radius, 1e-12) << i;
            }
            for (int k = 1; k < found.count; ++k) {
                const auto n = static_cast<std::size_t>(k);
                ASSERT_LT(found.item[n - 1].feature, found.item[n].feature);
            }
        }
        EXPECT_GT(outside, 1000);
        EXPECT_GT(behind, 500);
    }
}

// A sphere of many cells on noise touches at more places than are kept.
TEST(TerrainContact, TheDeepestStay) {
    const WallShape shape = wall_of(noisy_grid(41, 0.1, 0.08, 9));
    const Terrain& terrain = terrain_of(shape);
    int full = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        Random random(46, 1, i);
        const Vec3 x(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), random.uniform(0.8, 1.0));
        std::vector<double> slow;
        for (std::uint32_t t = 0; t < terrain.mesh.triangle.size(); ++t)
            if (const auto gap = sphere_triangle(x, 1.0, terrain.mesh, t, 0.0, 0.05)) slow.push_back(gap->gap);
        std::sort(slow.begin(), slow.end());
        const WallContacts found = touch(shape, x, 1.0, 0.05);
        std::vector<double> kept;
        for (int k = 0; k < found.count; ++k) kept.push_back(found.item[static_cast<std::size_t>(k)].gap);
        std::sort(kept.begin(), kept.end());
        ASSERT_EQ(kept.size(), std::min<std::size_t>(slow.size(), WallContacts::kCapacity));
        slow.resize(kept.size());
        ASSERT_EQ(kept, slow);
        full += found.count == WallContacts::kCapacity ? 1 : 0;
    }
    EXPECT_GT(full, 50);
}

// Where a list says that nothing is near, nothing is touched as far as it says.
TEST(TerrainContact, NearIsNeverMissed) {
    std::vector<WallShape> shapes;
    for (const TerrainBorder border : {TerrainBorder::open, TerrainBorder::closed}) {
        HeightGrid grid = noisy_grid(9, 0.5, 0.6, 6);
        shapes.push_back(wall_of(grid, border));
        grid.height[40] = grid.height[41] = kNoData;
        shapes.push_back(wall_of(grid, border));
        Terrain sheet = terrain_of(shapes.back());  // as a mesh: nothing is solid
        std::vector<TriangleCorners> corners;
        for (std::uint32_t t = 0; t < sheet.ground; ++t) corners.push_back(sheet.mesh.triangle[t].corner);
        shapes.push_back(
            TerrainWall{std::make_shared<const Terrain>(make_terrain(sheet.mesh.vertex, corners, border))});
    }
    int near = 0, far = 0, touched = 0;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const Terrain& terrain = terrain_of(shapes[s]);
        for (std::uint64_t i = 0; i < 20000; ++i) {
            Random random(42, s, i);
            Vec3 x(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(-1.0, 1.5));
            if (i % 3 == 0) x.z() = (i % 2 == 0 ? terrain.bottom : terrain.top) + random.uniform(-0.5, 0.5);
            const double radius = random.uniform(0.01, 0.5), reach = random.uniform(0.0, 0.5);
            const WallBounds box = bounds(shapes[s]);
            const bool in_bounds =
                (x - box.lower).minCoeff() >= -radius - reach && (box.upper - x).minCoeff() >= -radius - reach;
            const bool listed = in_bounds && may_touch(shapes[s], x, radius, reach);
            (listed ? near : far) += 1;
            const Vec3 way = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
            const double moved = random.uniform(0.0, reach);
            const WallContacts found = touch(shapes[s], x + moved * way, radius, (reach - moved) * (1.0 - 1e-9));
            touched += found.count > 0 ? 1 : 0;
            if (!listed) {
                ASSERT_EQ(found.count, 0) << s << ' ' << i;
            }
        }
    }
    EXPECT_GT(touched, 10000);
    EXPECT_GT(far, 20000);
    EXPECT_LT(near, 3 * touched);
}

TEST(TerrainContact, AnyDepthIsPushedUp) {
    const WallShape shape = wall_of(noisy_grid(9, 1.0, 0.5, 7));
    for (const double depth : {1e-9, 0.01, 0.1, 1.0, 5.0, 7.9}) {
        for (std::uint64_t i = 0; i < 200; ++i) {
            Random random(43, 1, i);
            const double x = random.uniform(-3.5, 3.5), y = random.uniform(-3.5, 3.5);
            const double z = ground(terrain_of(shape), x, y) - depth;
            const WallContacts found = touch(shape, {x, y, z}, 0.1);
            ASSERT_EQ(found.count, 1);
            EXPECT_LE(found.item[0].gap, -0.1);
            EXPECT_GE(found.item[0].gap, -0.1 - depth - 1e-12);
            EXPECT_GT(found.item[0].normal.z(), depth > 0.3 ? 0.5 : 0.0);
        }
    }
    EXPECT_EQ(touch(shape, {0.1, 0.1, terrain_of(shape).bottom - 1.0}, 0.1).count, 0);
}

TEST(TerrainContact, OpenBorderIsTheSideOfSolidGround) {
    const WallShape shape = wall_of(flat_grid(5, 1.0));  // 4 m x 4 m
    WallContacts found = touch(shape, {2.2, 0.3, -1.0}, 0.3);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, -0.1, 1e-15);
    EXPECT_EQ(found.item[0].normal, Vec3::UnitX());
    found = touch(shape, {2.1, 0.3, 0.1}, 0.3);  // over the edge
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, std::sqrt(0.02) - 0.3, 1e-15);
    EXPECT_LT((found.item[0].normal - Vec3(1, 0, 1).normalized()).norm(), 1e-14);
    found = touch(shape, {2.1, 2.1, 0.1}, 0.3);  // and the corner
    ASSERT_EQ(found.count, 1);
    EXPECT_LT((found.item[0].normal - Vec3(1, 1, 1).normalized()).norm(), 1e-14);
    EXPECT_EQ(touch(shape, {2.2, 0.3, -5.0}, 0.3).count, 0);  // below the side
}

TEST(TerrainContact, ClosedBorderKeepsBodiesIn) {
    const WallShape shape = wall_of(flat_grid(5, 1.0), TerrainBorder::closed);
    WallContacts found = touch(shape, {1.8, 0.3, 1.0}, 0.3);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, -0.1, 1e-15);
    EXPECT_EQ(found.item[0].normal, Vec3(-Vec3::UnitX()));
    EXPECT_EQ(touch(shape, {1.8, 1.8, 0.2}, 0.3).count, 3);  // a corner and the ground
    for (const double beyond : {1e-9, 0.1, 10.0}) {
        found = touch(shape, {2.0 + beyond, 0.3, 1.0}, 0.3);
        ASSERT_EQ(found.count, 1);
        EXPECT_NEAR(found.item[0].gap, -beyond - 0.3, 1e-12);
        EXPECT_EQ(found.item[0].normal, Vec3(-Vec3::UnitX()));
    }
}

TEST(TerrainContact, WallsAroundHoles) {
    HeightGrid grid = flat_grid(9, 1.0);
    grid.height[4 * 9 + 4] = kNoData;  // a hole like a diamond, |x| + |y| < 1
    WallShape shape = wall_of(grid, TerrainBorder::closed);
    const Vec3 away = Vec3(1, 1, 0).normalized();
    WallContacts found = touch(shape, Vec3(0.5, 0.5, 1.0) + 0.2 * away, 0.3);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, -0.1, 1e-15);
    EXPECT_LT((found.item[0].normal - away).norm(), 1e-14);
    found = touch(shape, Vec3(0.5, 0.5, 1.0) - 0.1 * away, 0.3);  // behind the wall
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, -0.4, 1e-15);
    shape = wall_of(grid, TerrainBorder::open);
    found = touch(shape, Vec3(0.5, 0.5, -1.0) - 0.2 * away, 0.3);  // in the shaft
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, -0.1, 1e-15);
    EXPECT_LT((found.item[0].normal + away).norm(), 1e-14);
}

// A sheet of a mesh that hangs over: one-sided, and behind it only as far as a radius.
TEST(TerrainContact, Sheets) {
    const std::vector<Vec3> v = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};  // seen from below
    const WallShape shape =
        TerrainWall{std::make_shared<const Terrain>(make_terrain(v, {{0, 1, 2}, {0, 2, 3}}, TerrainBorder::open))};
    EXPECT_EQ(terrain_of(shape).mesh.triangle.size(), 2U);
    WallContacts found = touch(shape, {0.5, 0.4, -0.15}, 0.2);
    ASSERT_EQ(found.count, 1);
    EXPECT_EQ(found.item[0].normal, Vec3(-Vec3::UnitZ()));
    EXPECT_NEAR(found.item[0].gap, -0.05, 1e-15);
    found = touch(shape, {0.5, 0.4, 0.15}, 0.2);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.item[0].gap, -0.35, 1e-15);
    EXPECT_EQ(touch(shape, {0.5, 0.4, 0.21}, 0.2).count, 0);
    EXPECT_EQ(touch(shape, {1.05, 0.4, 0.05}, 0.2).count, 0);  // beyond its edge nothing is behind
}

// A mesh that is a surface over the plane has the sides of a grid.
TEST(TerrainContact, MeshAndGridAlike) {
    const WallShape shape = wall_of(noisy_grid(9, 0.5, 0.4, 8));
    const Terrain& grid = terrain_of(shape);
    std::vector<TriangleCorners> corners;
    for (std::uint32_t t = 0; t < grid.ground; ++t) corners.push_back(grid.mesh.triangle[t].corner);
    const WallShape mesh =
        TerrainWall{std::make_shared<const Terrain>(make_terrain(grid.mesh.vertex, corners, TerrainBorder::open))};
    EXPECT_EQ(terrain_of(mesh).mesh.triangle.size(), grid.mesh.triangle.size());
    for (std::uint64_t i = 0; i < 3000; ++i) {
        Random random(44, 1, i);
        const Vec3 x(random.uniform(-2.3, 2.3), random.uniform(-2.3, 2.3), random.uniform(-0.2, 1.0));
        const double radius = random.uniform(0.05, 0.4);
        const WallContacts a = touch(shape, x, radius), b = touch(mesh, x, radius);
        const bool deep = grid.under(x) && slow_distance(grid, x) > radius;
        ASSERT_EQ(b.count, deep ? 0 : a.count) << i;
        if (!deep && a.count > 0) {
            ASSERT_NEAR(least_gap(a), least_gap(b), 1e-14);
        }
    }
}

}  // namespace
}  // namespace scree::contact
