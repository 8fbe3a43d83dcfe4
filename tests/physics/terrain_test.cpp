// Spheres on terrain of triangles: a tilted grid is a plane, nothing catches on its edges, nothing gets through.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/walls/wall_contact.hpp"
#include "tests/testing/height_grid.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::height_grid;
using testing::kNoData;
using testing::noisy_grid;
using testing::wall_of;
using testing::World;

constexpr double kSlope = 0.4;  // rise over run along x

// Nodes and cuts lie askew to the way, so that edges and nodes are crossed in every manner.
HeightGrid tilted_grid(double spacing) {
    const auto n = static_cast<std::uint32_t>(24.0 / spacing) + 1;
    return height_grid(
        n, n, spacing, spacing, [](double x, double) { return -kSlope * x; }, -3.0, -12.0);
}

struct Pair {
    World terrain, plane;

    Pair(double friction, double restitution, double spacing, const Vec3& velocity, double height)
        : terrain(1e-3, friction, restitution), plane(1e-3, friction, restitution) {
        const Vec3 normal = Vec3(kSlope, 0.0, 1.0).normalized();
        for (World* w : {&terrain, &plane}) w->add((0.1 + height) * normal, 0.1, velocity);
        terrain.add_wall(wall_of(tilted_grid(spacing)));
        plane.add_wall(PlaneWall{Vec3::Zero(), normal});
    }
    void expect_alike(int steps, double tolerance) {
        for (int k = 0; k < steps; ++k) {
            terrain.step(), plane.step();
            ASSERT_LT((terrain.position() - plane.position()).norm(), tolerance) << k;
            ASSERT_LT((terrain.velocity() - plane.velocity()).norm(), tolerance) << k;
            if (!terrain.plan.friction) continue;
            ASSERT_LT((terrain.spin() - plane.spin()).norm(), tolerance / 0.1) << k;
        }
    }
};

TEST(TerrainPhysics, ATiltedGridIsAPlane) {
    for (const double spacing : {0.05, 0.5, 3.0}) {
        const Vec3 across(0.3, 0.7, -0.3 * kSlope);
        Pair(0.0, 0.0, spacing, across, 0.0).expect_alike(1500, 1e-9);  // slides
        Pair(0.3, 0.0, spacing, across, 0.0).expect_alike(1500, 1e-9);  // rolls
        Pair(0.1, 0.0, spacing, across, 0.0).expect_alike(1500, 1e-9);  // slides and turns
        Pair(0.3, 0.6, spacing, across, 0.3).expect_alike(1000, 1e-9);  // hops
    }
}

TEST(TerrainPhysics, RestsInAPit) {
    World w(1e-3, 0.6);
    w.scene.correction.on = true;
    w.add_wall(wall_of(height_grid(
        9, 9, 0.5, 0.5, [](double x, double y) { return std::abs(x) + std::abs(y); }, -2.0, -2.0)));
    w.add({0.3, -0.2, 1.2}, 0.25);
    w.run(3000);
    const Vec3 at = w.position();
    w.run(2000);
    EXPECT_LT(w.fastest(), 1e-9);
    EXPECT_LT((w.position() - at).norm(), 1e-9);
    EXPECT_LT((w.position() - Vec3(0, 0, 0.25 * std::sqrt(3.0))).norm(), 1e-3);
    const solvers::WallLoad load = w.stepper->wall_loads()[0];
    EXPECT_LT((load.impulse + Vec3(0, 0, 9.81e-3 * w.mass())).norm(), 1e-9 * w.mass());
}

// Over a flat mesh of cells far smaller than the way of a step, straight along edges and askew.
TEST(TerrainPhysics, NothingCatchesOnInnerEdges) {
    for (const double slope : {0.0, 0.25}) {
        const WallShape flat = wall_of(height_grid(
            401, 401, 0.05, 0.05, [slope](double x, double y) { return slope * (x - y); }, -10.0, -10.0));
        const Vec3 normal = Vec3(-slope, slope, 1.0).normalized();
        for (const Vec3& way : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0.83, -0.31, 0)}) {
            World w(1e-3);
            w.gravity(-9.81 * normal);
            const Vec3 along = (way - way.dot(normal) * normal).normalized();
            w.add(0.2 * normal - 5.0 * along, 0.2, 3.0 * along);
            w.add_wall(flat);
            for (int k = 0; k < 3000; ++k) {
                w.step();
                ASSERT_NEAR(w.velocity().dot(along), 3.0, 3e-12) << k;
                ASSERT_LT((w.velocity() - 3.0 * along).norm(), 1e-11) << k;
            }
            EXPECT_NEAR((w.position() - 0.2 * normal).dot(along), 4.0, 1e-9);
        }
    }
}

// A sphere in a straight valley touches both sides: N = m g / (2 cos beta), as in a groove of two planes.
TEST(TerrainPhysics, ValleyAndRidge) {
    const WallShape valley = wall_of(height_grid(
        21, 21, 0.25, 0.25, [](double x, double) { return std::abs(x); }, -2.5, -2.5));
    World w(1e-3);
    w.gravity({0, 0, -9.81});
    w.add({0.0, 0.03, 0.3 * std::sqrt(2.0)}, 0.3, {0, 0.5, 0});
    w.add_wall(valley);
    w.run(1000);
    EXPECT_EQ(w.report.contacts, 2U);
    EXPECT_LT(std::abs(w.position().x()), 1e-12);
    EXPECT_NEAR(w.position().y(), 0.53, 1e-12);
    EXPECT_NEAR(w.position().z(), 0.3 * std::sqrt(2.0), 1e-10);
    const solvers::WallLoad load = w.stepper->wall_loads()[0];
    EXPECT_NEAR(load.impulse.norm() / 1e-3, w.mass() * 9.81, 1e-9 * w.mass() * 9.81);

    World over(1e-4);  // over the ridge it leaves the ground and comes down on the other side
    over.gravity({0, 0, -9.81});
    over.add_wall(wall_of(height_grid(
        21, 21, 0.25, 0.25, [](double x, double) { return -std::abs(x); }, -2.5, -2.5)));
    const Vec3 uphill = Vec3(1, 0, 1).normalized();
    over.add(-2.0 * uphill + 0.1 * Vec3(-1, 0, 1).normalized(), 0.1, 8.0 * uphill);
    double highest = -10.0;
    for (int k = 0; k < 10000; ++k) {
        over.step();
        highest = std::max(highest, over.position().z());
        const double x = over.position().x(), z = over.position().z();
        ASSERT_GT((z + std::abs(x)) / std::sqrt(2.0), 0.1 - 2e-3) << k;
        if (x > 2.0) break;
    }
    EXPECT_GT(highest, 0.3);
    EXPECT_GT(over.position().x(), 1.5);
}

TEST(TerrainPhysics, AClosedBorderKeepsAGasIn) {
    World w(1e-3, 0.0, 1.0);
    w.gravity(Vec3::Zero());
    HeightGrid grid = noisy_grid(9, 0.5, 0.2, 21);
    grid.height[40] = kNoData;
    w.add_wall(wall_of(grid, TerrainBorder::closed));
    const Terrain& terrain = *std::get<TerrainWall>(w.scene.walls[0].shape).terrain;
    w.add_wall(PlaneWall{{0, 0, 1.5}, -Vec3::UnitZ()});
    for (std::uint64_t i = 0; i < 60; ++i) {
        Random random(22, 1, i);
        const double a = 2 * M_PI * static_cast<double>(i) / 60.0, r = i % 2 == 0 ? 1.2 : 1.6;
        w.add({r * std::cos(a), r * std::sin(a), random.uniform(0.5, 1.2)}, 0.06,
              {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)});
    }
    w.start();
    const double energy = w.energy();
    for (int k = 0; k < 4000; ++k) {
        w.step();
        for (std::size_t i = 0; i < 60; ++i) {
            const Vec3& x = w.position(i);
            ASSERT_TRUE(terrain.column(x.x(), x.y())) << i << ' ' << k;
            ASSERT_FALSE(terrain.under(x));
        }
    }
    EXPECT_NEAR(w.energy(), energy, 1e-9 * energy);
}

TEST(TerrainPhysics, BodiesFallOffTheOpenBorderAndThroughHoles) {
    HeightGrid grid = height_grid(
        9, 9, 1.0, 1.0, [](double, double) { return 0.0; }, -4.0, -4.0);
    grid.height[40] = kNoData;
    World w(2e-3, 0.3, 0.2);
    w.gravity({0, 0, -9.81});
    w.add_wall(wall_of(grid));
    w.add({2.0, 0.0, 0.2}, 0.2, {3, 0.1, 0});     // over the border
    w.add({-2.0, 0.0, 0.2}, 0.2, {1.0, 0.0, 0});  // into the hole
    w.add({0.0, 2.5, 0.2}, 0.2);                  // stays
    for (int k = 0; k < 3000; ++k) {
        w.step();
        if (w.position(1).z() < -0.5 && w.position(1).z() > -7.5) {
            ASSERT_LT(w.position(1).cwiseAbs().head<2>().sum(), 1.0 - 0.19 * std::sqrt(2.0));
        }
    }
    EXPECT_LT(w.position(0).z(), -10.0);
    EXPECT_LT(w.position(1).z(), -10.0);
    EXPECT_GT(w.position(0).x(), 4.0);
    EXPECT_NEAR(w.position(2).z(), 0.2, 1e-3);
}

// Friction acts in a zone only, over its faces, edges and nodes; the plan knows that it does.
TEST(TerrainPhysics, ZonesHaveTheirOwnLaw) {
    Terrain terrain = make_terrain(height_grid(
                                       41, 21, 0.25, 0.25, [](double, double) { return 0.0; }, -2.0, -2.5),
                                   TerrainBorder::open);
    terrain.material.assign(terrain.mesh.triangle.size(), MaterialIndex{0});
    for (std::uint32_t t = 0; t < terrain.ground; ++t)
        if (terrain.mesh.vertex[terrain.mesh.triangle[t].corner[0]].x() >= 0.99) terrain.material[t] = MaterialIndex{1};
    for (const double y : {0.0, 0.11}) {
        World w(1e-3);
        w.scene.materials.push_back({"rough", 2500.0});
        w.scene.pairs = PairTable(2);
        w.scene.pairs.set(MaterialIndex{0}, MaterialIndex{1}, {0.3, 0.0});
        w.add({-1.0, y, 0.2}, 0.2, {3, 0, 0});
        w.add_wall(TerrainWall{std::make_shared<const Terrain>(terrain)});
        while (w.position().x() < 0.97) {
            w.step();
            ASSERT_NEAR(w.velocity().x(), 3.0, 1e-12);
        }
        EXPECT_TRUE(w.plan.friction);
        w.run(1000);
        EXPECT_NEAR(w.velocity().x(), 3.0 * 5.0 / 7.0, 1e-9);  // it has come to roll
    }
}

// Fast spheres of 0.1 to 10 cells on noise, with substeps and without.
struct Impacts {
    int deep = 0;          // after a step the centre was below the surface
    int under_at_end = 0;  // it did not come out again
    double deepest = 0.0;  // [travel of a step]
};

Impacts fire(std::uint64_t seed, int shots, double max_travel) {
    const double cell = 0.5;
    const WallShape shape = wall_of(noisy_grid(61, cell, 0.8 * cell, seed));
    const Terrain& terrain = *std::get<TerrainWall>(shape).terrain;
    Impacts result;
    for (int i = 0; i < shots; ++i) {
        Random random(seed, 5, static_cast<std::uint64_t>(i));
        const double radius = cell * std::pow(10.0, random.uniform(-1.0, 1.0));
        const double speed = std::pow(10.0, random.uniform(0.0, 2.0)),
                     step = std::pow(10.0, random.uniform(-3.0, -2.0));
        World w(step, random.uniform(0.0, 0.8), random.uniform(0.0, 0.9));
        w.gravity({0, 0, -9.81});
        w.scene.correction.on = true;
        w.scene.solver.tolerance = 1e-6;
        w.scene.time.max_travel = max_travel;
        w.add_wall(shape);
        const Vec3 way = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, -0.1)).normalized();
        const double h = terrain.upper.z() + radius + random.uniform(0.0, 1.0) * speed * step;
        w.add(Vec3(random.uniform(-2, 2), random.uniform(-2, 2), h), radius, speed * way);
        bool under = false;
        for (int k = 0; k < 40; ++k) {
            w.step();
            const Vec3& x = w.position();
            if (std::abs(x.x()) > 14.0 || std::abs(x.y()) > 14.0) break;
            under = terrain.under(x);
            if (!under) continue;
            ++result.deep;
            const double height = terrain.mesh.triangle[*terrain.column(x.x(), x.y())].normal.dot(
                x - terrain.mesh.vertex[terrain.mesh.triangle[*terrain.column(x.x(), x.y())].corner[0]]);
            result.deepest = std::max(result.deepest, -height / (speed * step));
        }
        result.under_at_end += under ? 1 : 0;
    }
    return result;
}

void expect_none_gets_through(std::uint64_t seed, int shots) {
    const Impacts cut = fire(seed, shots, 1.0), whole = fire(seed + 1, shots, 0.0);
    std::printf("    steps that ended below: %d with substeps, %d without (by %.2f of a step's way)\n", cut.deep,
                whole.deep, whole.deepest);
    EXPECT_EQ(cut.deep, 0);
    EXPECT_EQ(cut.under_at_end, 0);
    EXPECT_EQ(whole.under_at_end, 0);
    EXPECT_LT(whole.deepest, 1.0);
}

TEST(TerrainPhysics, FastSpheresDoNotGetThrough) {
    expect_none_gets_through(31, 5000);
}

// The slow tests run it.
TEST(TerrainPhysics, DISABLED_AHundredThousandFastSpheres) {
    expect_none_gets_through(33, 50000);
}

}  // namespace
}  // namespace scree
