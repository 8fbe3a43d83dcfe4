// Blocks that fill a part of space, and masonry: they fill it, stand where they should, and touch.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/polyhedron.hpp"
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::build_text;
using testing::expect_error;
using testing::kHead;

std::string one(const std::string& body) {
    return kHead + "bodies:\n  - {" + body + ", material: glass}\n";
}
const std::string kVoronoi = "generator: voronoi, region: {shape: box, lower: [1, 2, 3], upper: [3, 3, 4]}";
const std::string kRock = "generator: rock_mass, region: {shape: box, lower: [0, 0, 0], upper: [4, 4, 4]}";
const std::string kWall = "generator: wall_of_blocks, corner: [1, 2, 3], rows: 4, columns: 5, size: [0.4, 0.2, 0.1]";
const std::string kArch = "generator: arch, centre: [1, 2, 3], count: 11, radius: 5, thickness: 0.6, depth: 1";

const ConvexShape& shape_of(const State& state, std::size_t body) {
    return state.shapes[raw(state.bodies.shape[body])];
}
std::vector<Vec3> vertices_of(const scenarios::Built& built, std::size_t body) {
    const Bodies& b = built.state.bodies;
    std::vector<Vec3> points;
    for (const Vec3& x : shape_of(built.state, body).vertex)
        points.push_back(built.scene.origin + b.position[body] + b.orientation[body] * x);
    return points;
}
Extent extent_of_all(const scenarios::Built& built) {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < built.state.bodies.size(); ++i)
        for (const Vec3& x : vertices_of(built, i)) all.push_back(x);
    return extent_of(all);
}
double volume_of_all(const State& state) {
    double sum = 0.0;
    for (std::size_t i = 0; i < state.bodies.size(); ++i) sum += shape_of(state, i).volume;
    return sum;
}
// The farthest that two convex bodies reach past each other over the face normals of both: below 0 they are that far
// apart, along one of these normals.
double overlap_along_faces(const scenarios::Built& built, std::size_t a, std::size_t b) {
    double least = INFINITY;
    for (const auto& [p, q] : {std::pair{a, b}, {b, a}}) {
        const Bodies& bodies = built.state.bodies;
        const auto others = vertices_of(built, q);
        for (const ConvexShape::Face& face : shape_of(built.state, p).face) {
            const Vec3 n = bodies.orientation[p] * face.normal;
            double deepest = -INFINITY;
            for (const Vec3& x : others)
                deepest = std::max(deepest, face.offset - n.dot(x - built.scene.origin - bodies.position[p]));
            least = std::min(least, deepest);
        }
    }
    return least;
}

TEST(Voronoi, CellsFillTheBox) {
    const auto built = build_good(one(kVoronoi + ", count: 50"));
    EXPECT_EQ(built.state.bodies.size(), 50U);
    EXPECT_NEAR(volume_of_all(built.state), 2.0, 1e-13);
    const Extent extent = extent_of_all(built);
    EXPECT_TRUE(extent.lower.isApprox(Vec3(1, 2, 3), 1e-12));
    EXPECT_TRUE(extent.upper.isApprox(Vec3(3, 3, 4), 1e-12));
    double deepest = -INFINITY;
    for (std::size_t a = 0; a < 50; ++a)
        for (std::size_t b = 0; b < a; ++b) deepest = std::max(deepest, overlap_along_faces(built, a, b));
    EXPECT_LT(deepest, 1e-12);
    EXPECT_GT(deepest, -1e-12);
    EXPECT_EQ(build_good(one(kVoronoi + ", cell_size: 0.5")).state.bodies.size(), 31U);  // 2 / (pi / 48)
}

// Every cell is the same cell without a gap, less 5 mm at each of its faces.
TEST(Voronoi, AGapLiesBetweenNeighboursAndAtTheBorder) {
    const auto whole = build_good(one(kVoronoi + ", count: 50")),
               shrunk = build_good(one(kVoronoi + ", count: 50, gap: 10 mm"));
    ASSERT_EQ(shrunk.state.bodies.size(), 50U);
    std::size_t kept = 0, faces = 0;
    for (std::size_t i = 0; i < 50; ++i) {
        const std::vector<Vec3> points = vertices_of(shrunk, i);
        for (const ConvexShape::Face& face : shape_of(whole.state, i).face) {
            const Vec3 n = whole.state.bodies.orientation[i] * face.normal;
            double nearest = INFINITY;
            for (const Vec3& x : points)
                nearest =
                    std::min(nearest, face.offset - n.dot(x - whole.scene.origin - whole.state.bodies.position[i]));
            EXPECT_GT(nearest, 0.005 - 1e-12);
            kept += nearest < 0.005 + 1e-12 ? 1 : 0;
            ++faces;
        }
    }
    EXPECT_GT(kept, faces - faces / 20);  // a few small faces are cut off whole
}

TEST(Voronoi, WhatCannotBe) {
    expect_error(one(kVoronoi), {"bodies[0] (generator: voronoi) lacks one of the keys count, cell_size"});
    expect_error(one(kVoronoi + ", count: 5, cell_size: 1"), {"'count' and 'cell_size' of bodies[0]"});
    expect_error(one(kVoronoi + ", cell_size: 1 mm"),
                 {"bodies[0].cell_size: makes 3.81972e+09 cells, more than 1e+07"});
    expect_error(one(kVoronoi + ", count: 5, gap: 3"), {"bodies[0].gap: leaves nothing of 5 blocks"});
    expect_error(one("generator: voronoi, count: 3, region: {shape: sphere, centre: [0, 0, 0], radius: 1}"),
                 {"bodies[0].region.shape: 'sphere'; expected one of box"});
    EXPECT_NE(build_text(one(kVoronoi + ", count: 1000, gap: 15 cm")).warnings.find("they are left out"),
              std::string::npos);
}

TEST(RockMass, BlocksFillTheRegionAndLieBetweenTheirJoints) {
    // dips to the east by 30 degrees, and upright joints that strike east and north
    const std::string joints =
        ", joints: [{dip: 30 deg, dip_direction: 90 deg, spacing: 1}, {dip: 90 deg, spacing: 1},"
        " {dip: 90 deg, dip_direction: 90 deg, spacing: 2}]";
    const auto built = build_good(one(kRock + joints));
    EXPECT_NEAR(volume_of_all(built.state), 64.0, 1e-11);
    const Vec3 bedding(std::sin(M_PI / 6), 0.0, std::cos(M_PI / 6));
    for (std::size_t i = 0; i < built.state.bodies.size(); ++i) {
        for (const auto& [normal, spacing] : {std::pair{bedding, 1.0}, {Vec3(0, 1, 0), 1.0}, {Vec3(1, 0, 0), 2.0}}) {
            double low = INFINITY, high = -INFINITY;
            for (const Vec3& x : vertices_of(built, i)) {
                low = std::min(low, normal.dot(x));
                high = std::max(high, normal.dot(x));
            }
            EXPECT_LE(high - low, spacing + 1e-12) << i;
        }
    }
    // Another seed moves the joints.
    const auto positions = [](const scenarios::Built& b) { return b.state.bodies.position; };
    EXPECT_NE(positions(build_good("seed: 2\n" + one(kRock + joints))), positions(built));
}

TEST(RockMass, SliversCanBeLeftOut) {
    const std::string joints = ", joints: [{dip: 30 deg, spacing: 1, angle_scatter: 5 deg}, {dip: 80 deg, spacing: 1}]";
    const State all = build_good(one(kRock + joints)).state;
    const auto some = build_text(one(kRock + joints + ", smallest: 1.5"));
    const double least = std::numbers::pi / 6.0 * 1.5 * 1.5 * 1.5;
    std::size_t small = 0;
    double volume = 0.0;
    for (const ConvexShape& shape : all.shapes) {
        if (shape.volume >= least) continue;
        ++small;
        volume += shape.volume;
    }
    EXPECT_GT(small, 0U);
    EXPECT_EQ(some.built.state.bodies.size(), all.bodies.size() - small);
    EXPECT_NEAR(volume_of_all(some.built.state), 64.0 - volume, 1e-11);
    EXPECT_NE(some.warnings.find("bodies[0].smallest: leaves out " + std::to_string(small) + " of "), std::string::npos)
        << some.warnings;
    expect_error(one(kRock + joints + ", smallest: 9"), {"bodies[0].smallest: is more than the size of all "});
}

TEST(RockMass, OfTheHullOfPoints) {
    // A slope: a prism of 6 corners, half of a box of 4 x 3 x 2.
    const std::string slope =
        "generator: rock_mass, points: [[0, 0, 0], [4, 0, 0], [0, 0, 2], [0, 3, 0], [4, 3, 0], [0, "
        "3, 2]], joints: [{dip: 0 deg, spacing: 0.4}]";
    const auto built = build_good(one(slope));
    EXPECT_NEAR(volume_of_all(built.state), 12.0, 1e-12);
    EXPECT_GE(built.state.bodies.size(), 5U);
    // In the coordinates of a national grid: the same blocks.
    std::string far = slope;
    for (const char* x : {"[0,", "[4,"})
        for (std::size_t at = far.find(x); at != std::string::npos; at = far.find(x, at + 8))
            far.replace(at, 3, x[1] == '0' ? "[600000," : "[600004,");
    const auto moved = build_good(one(far));
    EXPECT_GT(moved.scene.origin.x(), 599000.0);
    ASSERT_EQ(moved.state.bodies.size(), built.state.bodies.size());
    for (std::size_t i = 0; i < built.state.bodies.size(); ++i)
        EXPECT_LT(
            (moved.scene.origin + moved.state.bodies.position[i] - built.state.bodies.position[i] - Vec3(600000, 0, 0))
                .norm(),
            1e-9);
}

TEST(RockMass, WhatCannotBe) {
    expect_error(one(kRock + ", joints: [{dip: 100 deg, spacing: 1}]"),
                 {"bodies[0].joints[0].dip: '100 deg' is out of"});
    expect_error(one(kRock + ", joints: [{dip: 10 deg}]"), {"bodies[0].joints[0] lacks the key 'spacing'"});
    expect_error(one(kRock + ", joints: [{dip: 10 deg, spacing: 1e-9}]"),
                 {"bodies[0]: joint set 0: a spacing of 1e-09"});
    expect_error(one(kRock + ", points: [[0, 0, 0]]"), {"'region' and 'points' of bodies[0]"});
    expect_error(one("generator: rock_mass, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0]]"),
                 {"test.yaml:7:5: error: bodies[0]: "});
    EXPECT_EQ(build_good(one(kRock)).state.bodies.size(), 1U);
    EXPECT_NE(build_text(one(kRock + ", joints: [{dip: 0 deg, spacing: 0.05}]"))
                  .warnings.find("81 blocks are thin or have very short edges; the first, body 0, is a plate, "),
              std::string::npos)
        << build_text(one(kRock + ", joints: [{dip: 0 deg, spacing: 0.05}]")).warnings;
}

TEST(WallOfBlocks, RunningBond) {
    const auto built = build_good(one(kWall));
    const Bodies& b = built.state.bodies;
    ASSERT_EQ(b.size(), 22U);  // 5 and 6 in turn
    EXPECT_EQ(built.state.shapes.size(), 2U);
    EXPECT_NEAR(volume_of_all(built.state), 2.0 * 0.2 * 0.4, 1e-14);
    const Extent extent = extent_of_all(built);
    EXPECT_TRUE(extent.lower.isApprox(Vec3(1, 2, 3), 1e-14));
    EXPECT_TRUE(extent.upper.isApprox(Vec3(3, 2.2, 3.4), 1e-14));
    EXPECT_TRUE(b.position[0].isApprox(Vec3(1.2, 2.1, 3.05), 1e-14));
    EXPECT_TRUE(b.position[5].isApprox(Vec3(1.1, 2.1, 3.15), 1e-14));  // a half
    EXPECT_TRUE(b.position[6].isApprox(Vec3(1.4, 2.1, 3.15), 1e-14));
    EXPECT_TRUE(b.position[10].isApprox(Vec3(2.9, 2.1, 3.15), 1e-14));
    EXPECT_NEAR(b.mass[5], 0.5 * b.mass[0], 1e-14);
    for (std::size_t p = 0; p < b.size(); ++p)
        for (std::size_t q = 0; q < p; ++q) EXPECT_LT(overlap_along_faces(built, p, q), 1e-14);
}

TEST(WallOfBlocks, StackBondAnotherDirectionAndGaps) {
    const auto built = build_good(one(kWall + ", bond: stack, direction: [0, 2, 5], gap: 10 mm"));
    EXPECT_EQ(built.state.bodies.size(), 20U);
    EXPECT_EQ(built.state.shapes.size(), 1U);
    const Extent extent = extent_of_all(built);  // along y, and its left is -x
    EXPECT_TRUE(extent.lower.isApprox(Vec3(0.8, 2, 3), 1e-14));
    EXPECT_TRUE(extent.upper.isApprox(Vec3(1, 4.04, 3.43), 1e-14));
    const auto flush = build_good(one(kWall + ", gap: 10 mm"));
    EXPECT_TRUE(extent_of_all(flush).upper.isApprox(Vec3(3.04, 2.2, 3.43), 1e-14));
    for (std::size_t p = 0; p < 22; ++p)
        for (std::size_t q = 0; q < p; ++q) EXPECT_LT(overlap_along_faces(flush, p, q), -0.01 + 1e-14);
}

TEST(Arch, VoussoirsHaveTheirJointsOnTheCircles) {
    const auto built = build_good(one(kArch));
    const Bodies& b = built.state.bodies;
    ASSERT_EQ(b.size(), 11U);
    EXPECT_EQ(built.state.shapes.size(), 1U);
    const Vec3 centre(1, 2, 3);
    std::vector<Vec3> all;
    for (std::size_t k = 0; k < 11; ++k) {
        int inner = 0, outer = 0;
        for (const Vec3& x : vertices_of(built, k)) {
            const double r = std::hypot(x.x() - 1, x.z() - 3);
            inner += std::abs(r - 4.7) < 1e-12 ? 1 : 0;
            outer += std::abs(r - 5.3) < 1e-12 ? 1 : 0;
            EXPECT_NEAR(std::abs(x.y() - 2), 0.5, 1e-12);
            // joints at whole multiples of 180 / 11 degrees
            const double joint = (std::atan2(x.x() - 1, x.z() - 3) + M_PI / 2) / (M_PI / 11);
            EXPECT_NEAR(joint, std::round(joint), 1e-12);
            EXPECT_NEAR(joint, static_cast<double>(k) + 0.5, 0.5 + 1e-12);
        }
        EXPECT_EQ(inner, 4);
        EXPECT_EQ(outer, 4);
        if (k == 0) continue;
        EXPECT_NEAR(overlap_along_faces(built, k, k - 1), 0.0, 1e-12);
    }
    EXPECT_TRUE(b.position[5].isApprox(Vec3(1, 2, b.position[5].z()), 1e-14));  // the keystone
    // Trapezia: (r2^2 - r1^2) sin a cos a, a = 90 / 11 degrees
    const double a = M_PI / 22;
    EXPECT_NEAR(shape_of(built.state, 0).volume, (5.3 * 5.3 - 4.7 * 4.7) * std::sin(a) * std::cos(a), 1e-12);
}

TEST(Arch, AnotherDirectionAndEmbrace) {
    const auto built = build_good(one(kArch + ", direction: [0, 1, 0], embrace: 120 deg"));
    const Extent extent = extent_of_all(built);
    EXPECT_NEAR(extent.lower.y(), 2 - 5.3 * std::sin(M_PI / 3), 1e-12);
    EXPECT_NEAR(extent.upper.y(), 2 + 5.3 * std::sin(M_PI / 3), 1e-12);
    EXPECT_NEAR(extent.lower.x(), 0.5, 1e-12);
    EXPECT_NEAR(extent.lower.z(), 3 + 4.7 * 0.5, 1e-12);
    EXPECT_LT(built.state.bodies.position[0].y(), 2.0);
}

TEST(Masonry, WhatCannotBe) {
    expect_error(one(kArch + ", up: [1, 0, 0]"), {"bodies[0].direction: must not be parallel to `up`"});
    expect_error(one("generator: arch, centre: [0, 0, 0], count: 1, radius: 1, thickness: 0.1, depth: 1"),
                 {"bodies[0].count: is too small: one voussoir would span half a circle"});
    expect_error(one("generator: arch, centre: [0, 0, 0], count: 9, radius: 1, thickness: 2, depth: 1"),
                 {"bodies[0].thickness: must be less than twice the radius, 2 m"});
    expect_error(one(kWall + ", gap: 0.5"), {"bodies[0].gap: must be less than a block's length, 0.4 m"});
    expect_error(one("generator: wall_of_blocks, corner: [0, 0, 0], rows: 1, columns: 1, size: [1, 0, 1]"),
                 {"bodies[0].size: lengths must be above 0"});
    expect_error(one(kArch + ", name: a, arc: 3"), {"'arc' is not a key of bodies[0] (generator: arch)"});
    EXPECT_EQ(build_good(one(kArch + ", name: bridge")).shape_name[0], "bridge");
    EXPECT_EQ(build_good(one(kArch)).shape_name[0], "bodies[0]");
}

}  // namespace
}  // namespace scree
