// Generators that make polyhedra: shapes and sizes shared, orientations drawn, places those of spheres.
#include "scenarios/figures.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "scenarios/named_shapes.hpp"
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;

const std::string kShapes =
    "shapes:\n"
    "  - {name: brick, kind: box, size: [3, 2, 1]}\n"
    "  - {name: stone, kind: rock, diameter: 1, variants: 4}\n"
    "bodies:\n";

std::string lattice(const std::string& more) {
    return kHead + kShapes +
           "  - {generator: lattice, material: glass, corner: [0, 0, 5], pitch: 6, cells: [6, 5, 4], jitter: 0.1, " +
           more + "}\n";
}

TEST(Figures, PlacesAndSizesAreThoseOfSpheres) {
    const std::string size = "size: {distribution: log_normal, median: 1, sigma: 0.3}";
    const Bodies spheres = build_good(lattice(size)).state.bodies;
    const State made = build_good(lattice(size + ", shape: stone, orientation: {random: true}, size_classes: 8")).state;
    ASSERT_EQ(made.bodies.size(), spheres.size());
    EXPECT_EQ(made.bodies.position, spheres.position);
    // a class of 8 over exp(-0.9) to exp(0.9) is 0.225 wide in the logarithm
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double d = scenarios::equivalent_diameter(made.shapes[raw(made.bodies.shape[i])]);
        EXPECT_LE(std::abs(std::log(d / (2.0 * spheres.radius[i]))), 0.1125 * (1 + 1e-9)) << i;
    }
    EXPECT_LE(made.shapes.size(), 32U);
    EXPECT_GE(made.shapes.size(), 20U);
}

TEST(Figures, InstancesShareTheirShapeAndUnusedOnesAreNotKept) {
    EXPECT_EQ(build_good(lattice("shape: brick")).state.shapes.size(), 1U);
    EXPECT_EQ(build_good(lattice("shape: stone")).state.shapes.size(), 4U);
    EXPECT_EQ(build_good(lattice("shape: stone, size: {distribution: fixed, diameter: 2}")).state.shapes.size(), 4U);
    // two generators take the same shape
    const State two = build_good(lattice("shape: brick") +
                                 "  - {generator: polyhedron, shape: brick, material: steel, position: [0, 0, -9]}\n"
                                 "  - {generator: polyhedron, shape: brick, scale: 2, material: steel, position: [0, "
                                 "0, -19]}\n")
                          .state;
    EXPECT_EQ(two.shapes.size(), 2U);
    EXPECT_EQ(raw(two.bodies.shape.back()), 1U);
    // 4 variants and 20 classes for 2 bodies
    const State few =
        build_good(lattice("shape: stone, count: 2, size: {distribution: uniform, lower: 1, upper: 3}")).state;
    EXPECT_LE(few.shapes.size(), 2U);
    const auto none = build_good(lattice("size: {distribution: fixed, diameter: 1}"));
    EXPECT_TRUE(none.state.shapes.empty());
    EXPECT_FALSE(none.state.bodies.has_shapes());
    EXPECT_TRUE(none.shape_name.empty());
}

TEST(Figures, SpheresAndPolyhedraTogether) {
    const auto built = build_good(lattice("shape: brick") +
                                  "  - {generator: sphere, radius: 1, material: steel, position: [0, 0, -9]}\n");
    const Bodies& b = built.state.bodies;
    EXPECT_EQ(b.shape.back(), kSphere);
    EXPECT_DOUBLE_EQ(b.inertia.back().x(), 0.4 * b.mass.back());
    EXPECT_EQ(built.shape_name, std::vector<std::string>{"brick"});
    EXPECT_NEAR(b.mass[0], 6.0 * 2500.0, 1e-9);
    EXPECT_TRUE(b.inertia[0].isApprox(2500.0 * 6.0 / 12.0 * Vec3(1 + 4, 1 + 9, 4 + 9), 1e-12));
}

// Each direction of the body frame is spread evenly: the mean of n n^T is a third of the unit matrix, that of n is 0.
TEST(Figures, RandomOrientationsAreUniform) {
    const Bodies b = build_good(kHead + kShapes +
                                "  - {generator: lattice, material: glass, shape: brick, corner: [0, 0, 0], pitch: 6, "
                                "cells: [20, 20, 20], orientation: {random: true}}\n")
                         .state.bodies;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 mean = Vec3::Zero();
        Mat3 square = Mat3::Zero();
        for (const Quat& q : b.orientation) {
            const Vec3 n = q * Vec3::Unit(axis);
            mean += n / static_cast<double>(b.size());
            square += n * n.transpose() / static_cast<double>(b.size());
        }
        EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4.0 / std::sqrt(3.0 * 8000));
        EXPECT_LT((square - Mat3::Identity() / 3.0).cwiseAbs().maxCoeff(), 4.0 * 0.298 / std::sqrt(8000.0));
    }
    double turned = 0.0;  // the angle of rotation has the density (1 - cos t) / pi: mean pi / 2 + 2 / pi
    for (const Quat& q : b.orientation) turned += 2.0 * std::acos(std::min(1.0, std::abs(q.w()))) / 8000.0;
    EXPECT_NEAR(turned, M_PI / 2 + 2 / M_PI, 4.0 * 0.646 / std::sqrt(8000.0));
}

TEST(Figures, AFixedOrientationIsThatOfAllBodies) {
    const State state = build_good(lattice("shape: brick, orientation: {axis: [0, 0, 1], angle: 90 deg}")).state;
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        Vec3 reach = Vec3::Zero();
        for (const Vec3& x : state.shapes[0].vertex)
            reach = reach.cwiseMax((state.bodies.orientation[i] * x).cwiseAbs());
        EXPECT_TRUE(reach.isApprox(Vec3(1, 1.5, 0.5), 1e-14));
    }
}

std::string random(const std::string& more) {
    return kHead + kShapes +
           "  - {generator: random, material: glass, region: {shape: box, lower: [0, 0, 0], upper: [40, 40, 40]}, "
           "orientation: {random: true}, " +
           more + "}\nwalls:\n  - {shape: plane, name: p, material: steel, point: [0, 0, 5], normal: [0, 0, 1]}\n";
}

TEST(Figures, RandomInsertionKeepsBoundingBallsApart) {
    const State state = build_good(random("shape: brick, packing_fraction: 0.03")).state;
    const Bodies& b = state.bodies;
    EXPECT_EQ(b.size(), 320U);  // 0.03 * 64000 / 6
    const double radius = std::sqrt(14.0) / 2.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        EXPECT_NEAR(b.radius[i], radius, 1e-14);
        EXPECT_GE(b.position[i].z(), 5.0 + radius - 1e-12);
        EXPECT_LE(b.position[i].z(), 40.0 - radius + 1e-12);
        for (std::size_t j = 0; j < i; ++j) EXPECT_GE((b.position[i] - b.position[j]).norm(), 2.0 * radius - 1e-12);
    }
}

TEST(Figures, RandomInsertionByMass) {
    const State state =
        build_good(random("shape: stone, size: {distribution: uniform, lower: 1, upper: 3}, mass: 1e6")).state;
    double mass = 0.0;
    for (const double m : state.bodies.mass) mass += m;
    EXPECT_GE(mass, 1e6);
    EXPECT_LT(mass, 1e6 + 2500 * 15);
    expect_error(random("shape: brick, count: 1000000, attempts: 10"), {"polyhedron in a ball of 3.74166 m diameter"});
}

TEST(Figures, WrongKeysAreErrors) {
    const std::string size = "size: {distribution: fixed, diameter: 1}";
    expect_error(lattice("count: 3"),
                 {"test.yaml:10:5: error: bodies[0] (generator: lattice) lacks one of the keys size, shape"});
    expect_error(lattice("shape: brik"), {"bodies[0].shape: 'brik' is not one of the shapes (did you mean 'brick'?); "
                                          "there are brick, stone"});
    expect_error(lattice(size + ", orientation: {random: true}"), {"bodies[0].orientation: needs a `shape`"});
    expect_error(lattice(size + ", size_classes: 3"), {"bodies[0].size_classes: needs a `shape`"});
    expect_error(lattice("shape: brick, orientation: {}"),
                 {"bodies[0].orientation lacks one of the keys quaternion, axis, euler, random"});
    expect_error(lattice("shape: brick, orientation: {axis: [0, 0, 1], euler: [0, 0, 1]}"),
                 {"'axis' and 'euler' of bodies[0].orientation exclude each other; keep one"});
    expect_error(lattice("shape: brick, orientation: {axis: [0, 0, 1]}"),
                 {"bodies[0].orientation.axis: needs an `angle`"});
    expect_error(lattice("shape: brick, orientation: {euler: [0, 0, 1], angle: 3}"),
                 {"bodies[0].orientation.angle: is the angle about an `axis`, which is not given"});
    expect_error(lattice("shape: brick, orientation: {quaternion: [1, 0, 0]}"),
                 {"bodies[0].orientation.quaternion: a list of 3; expected a list of 4 numbers"});
    expect_error(lattice("shape: brick, orientation: {quaternion: [1, 1, 0, 0]}"),
                 {"bodies[0].orientation.quaternion: is no unit quaternion [w, x, y, z]: its length is 1.41421"});
}

TEST(Figures, PolyhedraAreMeasuredInFlatRegions) {
    const auto measured = [](const std::string& measure) {
        return lattice("shape: brick") + "measures:\n  - {name: m, " + measure + "}\n";
    };
    const std::string tube = "region: {shape: cylinder, base: [0, 0, 0], radius: 1, length: 1}",
                      box = "region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}";
    build_good(measured("measure: packing_fraction, " + box));
    build_good(measured("measure: mass_in, " + tube));
    expect_error(measured("measure: packing_fraction, " + tube),
                 {"measures[0].region.shape: the volume of polyhedra is measured in regions with flat sides, not in a "
                  "cylinder: use a box"});
    expect_error(measured("measure: profile, lower: 0, upper: 1, bins: 3, " + tube), {"not in a cylinder: use a box"});
    build_good(measured("measure: profile, lower: 0, upper: 1, bins: 3, " + box));
}

std::string from_file(const std::string& more) {
    return kHead + kShapes + "  - {generator: file, material: glass, path: bodies.txt, " + more + "}\n";
}

TEST(Figures, BodiesOfAFile) {
    const testing::TemporaryFolder folder;
    folder.write("bodies.txt",
                 "0 0 0 brick 2  1 0 0 0\n"
                 "9 0 0 stone 4  0.70710678 0 0 0.70710678  # a remark\n"
                 "0 9 0 brick 4  0.70710678 0.70710678 0 0\n"
                 "0 0 9 brick 4  1 0 0 0\n");
    const std::string columns = "columns: [x, y, z, shape, d, qw, qx, qy, qz]";
    const State state = build_good(from_file(columns), folder.path()).state;
    const Bodies& b = state.bodies;
    ASSERT_EQ(b.size(), 4U);
    EXPECT_EQ(state.shapes.size(), 3U);
    EXPECT_EQ(b.shape[2], b.shape[3]);
    EXPECT_NEAR(scenarios::equivalent_diameter(state.shapes[raw(b.shape[0])]), 2.0, 1e-13);
    for (const std::size_t i : {1U, 2U, 3U})
        EXPECT_NEAR(scenarios::equivalent_diameter(state.shapes[raw(b.shape[i])]), 4.0, 1e-13);
    Vec3 reach = Vec3::Zero();
    for (const Vec3& x : state.shapes[raw(b.shape[2])].vertex)
        reach = reach.cwiseMax((b.orientation[2] * x).cwiseAbs());
    EXPECT_TRUE(reach.isApprox(reach.x() * Vec3(1, 1.0 / 3, 2.0 / 3), 1e-8));  // turned about x by 90 degrees
    EXPECT_NEAR(b.orientation[2].norm(), 1.0, 1e-15);
    // without a diameter: the shape's own size
    const std::string no_size = "columns: [x, y, z, shape, skip, qw, qx, qy, qz], scale: 0.5";
    const State own = build_good(from_file(no_size), folder.path()).state;
    EXPECT_NEAR(own.shapes[raw(own.bodies.shape[0])].volume, 6.0, 1e-13);
    EXPECT_EQ(own.bodies.position[1], Vec3(4.5, 0, 0));
}

TEST(Figures, WrongLinesAndColumnsOfAFileAreErrors) {
    const testing::TemporaryFolder folder;
    folder.write("bodies.txt", "0 0 0 brik 1 1 0 0 0\n0 0 0 brick 1 1 1 0 0\n");
    expect_error(from_file("columns: [x, y, z, shape, d, qw, qx, qy, qz]"),
                 {"bodies.txt:1:7: error: there is no shape 'brik' (did you mean 'brick'?)",
                  "bodies.txt:2:1: error: qw qx qy qz are no unit quaternion: its length is 1.41421"},
                 folder.path());
    const auto columns = [&](const std::string& list, const std::string& message) {
        expect_error(from_file("columns: [" + list), {message}, folder.path());
    };
    columns("x, y, z]", "must name one of r (radius) and d (diameter)");
    columns("x, y, z, r, d], shape: brick", "must name one of r (radius) and d (diameter), not both");
    columns("x, y, z, qw, qx, qy], shape: brick", "must name all of qw, qx, qy and qz, or none");
    columns("x, y, z, r, qw, qx, qy, qz]", "qw, qx, qy and qz are for polyhedra: give a `shape`");
    columns("x, y, z, shape], shape: brick", "names a shape, and so does the key `shape`");
    columns("x, y, z, qw, qx, qy, qz], shape: brick, orientation: {random: true}",
            "bodies[0].orientation: columns qw, qx, qy and qz say it already");
    columns("x, y, z, r], orientation: {random: true}", "bodies[0].orientation: needs a `shape`");
}

}  // namespace
}  // namespace scree
