// Fast polyhedra on terrain of triangles: none gets through.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/testing/height_grid.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::noisy_grid;
using testing::wall_of;
using testing::World;

Quat any_turn(Random& random) {
    const double a = 2.0 * std::numbers::pi * random.uniform(), b = 2.0 * std::numbers::pi * random.uniform(),
                 share = random.uniform();
    return {std::sqrt(share) * std::cos(b), std::sqrt(1.0 - share) * std::sin(a), std::sqrt(1.0 - share) * std::cos(a),
            std::sqrt(share) * std::sin(b)};
}

// Boxes, down to plates and rods of 1 : 4, tetrahedra and octahedra, about the origin and within a ball of radius 1.
Polyhedron any_solid(Random& random) {
    const double kind = random.uniform();
    Polyhedron body;
    if (kind < 0.5) {
        const Vec3 sides(1.0, random.uniform(0.25, 1.0), random.uniform(0.25, 1.0));
        body = testing::box(2.0 / sides.norm() * sides);
    } else if (kind < 0.75) {
        body.vertex = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
        body.face = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
        for (Vec3& v : body.vertex) v /= std::sqrt(3.0);
    } else {
        body.vertex = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        body.face = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    }
    return body;
}

struct Impacts {
    int deep = 0;          // after a step the centre was below the surface
    int under_at_end = 0;  // it did not come out again
    double deepest = 0.0;  // [m] below the triangle above it
    int touched = 0;       // shots that met the ground in the last part of a step
};

// Of 0.1 to 10 cells, 1 to 100 m/s, spinning as fast as they move.
Impacts fire(std::uint64_t seed, int shots, double max_travel) {
    const double cell = 0.5;
    const WallShape shape = wall_of(noisy_grid(61, cell, 0.8 * cell, seed));
    const Terrain& terrain = *std::get<TerrainWall>(shape).terrain;
    Impacts result;
    for (int i = 0; i < shots; ++i) {
        Random random(seed, 6, static_cast<std::uint64_t>(i));
        const double radius = cell * std::pow(10.0, random.uniform(-1.0, 1.0));
        const double speed = std::pow(10.0, random.uniform(0.0, 2.0)),
                     step = std::pow(10.0, random.uniform(-3.0, -2.0));
        World w(step, random.uniform(0.0, 0.8), random.uniform(0.0, 0.9));
        w.gravity({0, 0, -9.81});
        w.scene.correction.on = true;
        w.scene.solver.tolerance = 1e-4;
        w.scene.solver.max_sweeps = 500;
        w.scene.time.max_travel = max_travel;
        w.add_wall(shape);
        const Vec3 way = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, -0.1)).normalized();
        const double h = terrain.upper.z() + radius + random.uniform(0.0, 1.0) * speed * step;
        const Vec3 at(random.uniform(-2, 2), random.uniform(-2, 2), h);
        Polyhedron body = any_solid(random);
        for (Vec3& v : body.vertex) v *= radius;
        const Vec3 axis = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        w.add(body, at, any_turn(random).normalized(), speed * way, speed / radius * axis);
        bool under = false;
        int since = 0;  // steps since it met the ground
        for (int k = 0; k < 2000 && since < 30; ++k) {
            const bool meets = w.step().contacts > 0;
            if (meets || since > 0) ++since;
            const Vec3& x = w.position();
            if (std::abs(x.x()) > 14.0 || std::abs(x.y()) > 14.0) break;
            under = terrain.under(x);
            if (!under) continue;
            ++result.deep;
            const TerrainMesh::Triangle& above = terrain.mesh.triangle[*terrain.column(x.x(), x.y())];
            result.deepest =
                std::max(result.deepest, -above.normal.dot(x - terrain.mesh.vertex[above.corner[0]]) / radius);
        }
        result.under_at_end += under ? 1 : 0;
        result.touched += since > 0 ? 1 : 0;
    }
    return result;
}

void expect_none_gets_through(std::uint64_t seed, int shots) {
    const Impacts cut = fire(seed, shots, 1.0), whole = fire(seed + 1, shots, 0.0);
    std::printf(
        "    %d and %d met the ground; steps that ended below: %d with substeps (by %.2f radii), %d without "
        "(by %.2f radii)\n",
        cut.touched, whole.touched, cut.deep, cut.deepest, whole.deep, whole.deepest);
    EXPECT_GT(cut.touched, shots * 9 / 10);
    EXPECT_EQ(cut.deep, 0);
    EXPECT_EQ(cut.under_at_end, 0);
    EXPECT_EQ(whole.under_at_end, 0);
}

// How far corners of the body lie below the triangles over them [m].
double deepest_corner(const World& w, const Terrain& terrain) {
    const ConvexShape& shape = w.state.shapes[0];
    double deepest = 0.0;
    for (const Vec3& v : shape.vertex) {
        const Vec3 x = w.state.bodies.position[0] + w.state.bodies.orientation[0] * v;
        const auto column = terrain.column(x.x(), x.y());
        if (!column || !terrain.under(x)) continue;
        const TerrainMesh::Triangle& above = terrain.mesh.triangle[*column];
        deepest = std::max(deepest, -above.normal.dot(x - terrain.mesh.vertex[above.corner[0]]));
    }
    return deepest;
}

// Dropped on noise as rough as they are, a corner comes to lie in a valley often: below it, where neither of the two
// triangles has ground along its normal, it must not sink in.
TEST(TerrainPolyhedra, CornersDoNotSinkIntoValleys) {
    const double cell = 0.5;
    const WallShape shape = wall_of(noisy_grid(61, cell, 0.8 * cell, 51));
    const Terrain& terrain = *std::get<TerrainWall>(shape).terrain;
    double deepest = 0.0;
    for (int i = 0; i < 300; ++i) {
        Random random(51, 7, static_cast<std::uint64_t>(i));
        const double radius = cell * random.uniform(0.3, 1.5);
        World w(2e-3, 0.5);
        w.gravity({0, 0, -9.81});
        w.scene.correction.on = true;
        w.scene.solver.tolerance = 1e-4;
        w.scene.solver.max_sweeps = 500;
        w.add_wall(shape);
        Polyhedron body = any_solid(random);
        for (Vec3& v : body.vertex) v *= radius;
        const Vec3 at(random.uniform(-10, 10), random.uniform(-10, 10), terrain.upper.z() + radius);
        w.add(body, at, any_turn(random).normalized());
        w.run(800);
        double worst = 0.0;
        for (int k = 0; k < 50; ++k) {
            w.step();
            worst = std::max(worst, deepest_corner(w, terrain) / radius);
        }
        EXPECT_LT(worst, 0.02) << i;
        deepest = std::max(deepest, worst);
    }
    std::printf("    deepest corner %.4f radii below the surface\n", deepest);
}

TEST(TerrainPolyhedra, FastOnesDoNotGetThrough) {
    expect_none_gets_through(41, 5000);
}

// The slow tests run it.
TEST(TerrainPolyhedra, DISABLED_AHundredThousandFastOnes) {
    expect_none_gets_through(43, 50000);
}

}  // namespace
}  // namespace scree
