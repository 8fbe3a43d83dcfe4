// The list `shapes`: sizes, where the vertices end up, and what is refused.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/named_shapes.hpp"
#include "scenarios/shapes/solids.hpp"
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::build_text;
using testing::expect_error;
using testing::kHead;

std::string one(const std::string& shape, const std::string& body = "") {
    return kHead + "shapes:\n  - {name: s, " + shape +
           "}\nbodies:\n  - {generator: polyhedron, shape: s, material: glass, position: [1, 2, 3]" + body + "}\n";
}

const ConvexShape& shape_of(const State& state, std::size_t body = 0) {
    return state.shapes[raw(state.bodies.shape[body])];
}

// Of all bodies, in the world.
std::vector<Vec3> vertices_of(const scenarios::Built& built) {
    std::vector<Vec3> points;
    const Bodies& b = built.state.bodies;
    for (std::size_t i = 0; i < b.size(); ++i)
        for (const Vec3& x : shape_of(built.state, i).vertex)
            points.push_back(built.scene.origin + b.position[i] + b.orientation[i] * x);
    return points;
}

// The same points, in any order.
void expect_points(const std::vector<Vec3>& found, const std::vector<Vec3>& expected, double tolerance = 1e-12) {
    ASSERT_EQ(found.size(), expected.size());
    for (const Vec3& x : expected) {
        double nearest = INFINITY;
        for (const Vec3& y : found) nearest = std::min(nearest, (x - y).norm());
        EXPECT_LT(nearest, tolerance) << x.transpose();
    }
}

TEST(NamedShapes, AllKindsHaveTheSizeThatWasAskedFor) {
    const std::vector<std::string> kinds{
        "kind: box, size: [1, 2, 3]",
        "kind: prism, sides: 6, radius: 1, height: 4",
        "kind: tetrahedron",
        "kind: octahedron",
        "kind: dodecahedron",
        "kind: icosahedron",
        "kind: eota",
        "kind: eota, form: EOTA211",
        "kind: eota, form: EOTA221",
        "kind: rock, points: 15",
        "kind: hull, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]",
    };
    for (const std::string& kind : kinds) {
        const State by_volume = build_good(one(kind + ", volume: 2 L")).state;
        EXPECT_NEAR(shape_of(by_volume).volume, 2e-3, 1e-15) << kind;
        EXPECT_NEAR(by_volume.bodies.mass[0], 5.0, 1e-11) << kind;
        const State by_diameter = build_good(one(kind + ", diameter: 10 cm")).state;
        EXPECT_NEAR(shape_of(by_diameter).volume, std::numbers::pi / 6e3, 1e-15) << kind;
        EXPECT_EQ(by_diameter.bodies.radius[0], shape_of(by_diameter).radius) << kind;
    }
}

TEST(NamedShapes, TheirOwnLengths) {
    EXPECT_NEAR(shape_of(build_good(one("kind: box, size: [1, 2, 3]")).state).volume, 6.0, 1e-14);
    EXPECT_NEAR(shape_of(build_good(one("kind: box, size: 20 mm")).state).volume, 8e-6, 1e-19);
    const double hexagon = 1.5 * std::sqrt(3.0);
    EXPECT_NEAR(shape_of(build_good(one("kind: prism, sides: 6, radius: 1, height: 4")).state).volume, 4.0 * hexagon,
                1e-13);
    EXPECT_NEAR(shape_of(build_good(one("kind: octahedron, edge: 2")).state).volume, 8.0 * std::numbers::sqrt2 / 3.0,
                1e-14);
    EXPECT_NEAR(shape_of(build_good(one("kind: eota, length: 2")).state).volume, 17.0 / 3.0, 1e-13);
    EXPECT_NEAR(shape_of(build_good(one("kind: eota, form: EOTA221, length: 2")).state).volume, 17.0 / 6.0, 1e-13);
    EXPECT_NEAR(shape_of(build_good(one("kind: eota, form: EOTA211, length: 2")).state).volume, 17.0 / 12.0, 1e-13);
    // A rock of length 0.5, breadth 0.3, thickness 0.06, in its own frame.
    const auto rock = build_good(one("kind: rock, length: 0.5, elongation: 0.6, flatness: 0.2"));
    const Extent extent = extent_of(vertices_of(rock));
    EXPECT_TRUE((extent.upper - extent.lower).isApprox(Vec3(0.5, 0.3, 0.06), 1e-12));
    EXPECT_EQ(shape_of(rock.state).vertex.size(), 12U);
}

TEST(NamedShapes, VerticesEndWhereTheGivenFrameAndTheOrientationPutThem) {
    // A wedge: its axes are far from its principal axes, its origin far from its centre of mass, (1, 1, 1) / 4 away.
    const std::string wedge = "kind: hull, points: [[0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 0.5]]";
    const std::vector<Vec3> given{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
    const Vec3 centre(0.5, 0.25, 0.125), position(1, 2, 3);
    const auto moved = [&](const Mat3& turn, const Vec3& about) {
        std::vector<Vec3> points;
        for (const Vec3& x : given) points.push_back(position + turn * (x - about));
        return points;
    };
    Mat3 quarter, roll_then_yaw;
    quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;       // about z
    roll_then_yaw << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // z goes to -y, then to x
    const Mat3 same = Mat3::Identity();
    expect_points(vertices_of(build_good(one(wedge))), moved(same, centre));
    expect_points(vertices_of(build_good(one(wedge, ", placed_by: origin"))), moved(same, Vec3::Zero()));
    expect_points(vertices_of(build_good(one(wedge, ", orientation: {axis: [0, 0, 2], angle: 90 deg}"))),
                  moved(quarter, centre));
    const std::string turned = ", orientation: {quaternion: [0.70710678118654752, 0, 0, 0.70710678118654752]}";
    expect_points(vertices_of(build_good(one(wedge, turned))), moved(quarter, centre));
    expect_points(vertices_of(build_good(one(wedge, turned + ", placed_by: origin"))), moved(quarter, Vec3::Zero()));
    expect_points(vertices_of(build_good(one(wedge, ", orientation: {euler: [90 deg, 0, 90 deg]}"))),
                  moved(roll_then_yaw, centre));
}

TEST(NamedShapes, ScaleAndDiameterOfOneBody) {
    const State twice = build_good(one("kind: box, size: 1", ", scale: 2")).state;
    EXPECT_NEAR(shape_of(twice).volume, 8.0, 1e-14);
    const State sized = build_good(one("kind: box, size: 1", ", diameter: 0.1")).state;
    EXPECT_NEAR(shape_of(sized).volume, scenarios::ball_volume(0.1), 1e-18);
}

TEST(NamedShapes, ARockIsOfTheSeedAndItsNameAlone) {
    const auto rock = [&](const std::string& shapes, const std::string& head) {
        return shape_of(build_good(head + kHead + "shapes:\n" + shapes +
                                   "bodies:\n  - {generator: polyhedron, shape: r, material: glass, position: [0, 0, "
                                   "0]}\n")
                            .state)
            .vertex;
    };
    const std::string r = "  - {name: r, kind: rock, diameter: 1}\n", q = "  - {name: q, kind: rock, diameter: 1}\n";
    EXPECT_EQ(rock(r, ""), rock(q + r, ""));
    EXPECT_NE(rock(r, ""), rock(r, "seed: 2\n"));
    const State both = build_good(kHead + "shapes:\n" + q + r +
                                  "bodies:\n  - {generator: polyhedron, shape: r, material: glass, position: [0, 0, "
                                  "0]}\n  - {generator: polyhedron, shape: q, material: glass, position: [0, 0, 9]}\n")
                           .state;
    EXPECT_NE(shape_of(both, 0).vertex, shape_of(both, 1).vertex);
}

TEST(NamedShapes, MeshFilesStartAtTheScenariosFolder) {
    const testing::TemporaryFolder folder;
    const std::string points = "OFF\n4 4 0\n0 0 0\n1000 0 0\n0 1000 0\n0 0 1000\n";
    folder.write("good.off", points + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    folder.write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
    folder.write("bad.off", "OFF\n4 4 0\n0 0 zero\n");
    const State state = build_good(one("kind: file, path: good.off, scale: 0.001"), folder.path()).state;
    EXPECT_NEAR(shape_of(state).volume, 1.0 / 6.0, 1e-14);
    const State hull = build_good(one("kind: file, path: open.off, hull: true, volume: 1"), folder.path()).state;
    EXPECT_NEAR(shape_of(hull).volume, 1.0, 1e-14);
    expect_error(one("kind: file, path: open.off"), {"test.yaml:7:5: error: shapes[0]: shape 's': ", "open.off: "},
                 folder.path());
    expect_error(one("kind: file, path: bad.off"), {"test.yaml:7:33: error: shapes[0].path: ", "bad.off:3: "},
                 folder.path());
    expect_error(one("kind: file, path: none.off"), {"test.yaml:7:33: error: shapes[0].path: ", "cannot be opened"},
                 folder.path());
    folder.write("good.xyz", "");
    expect_error(one("kind: file, path: good.xyz"), {"a name that ends in .off, .obj, .stl or .ply is expected"},
                 folder.path());
}

TEST(NamedShapes, WhatCannotBeIsReportedAtTheShape) {
    expect_error(one("kind: hull, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0]]"),
                 {"test.yaml:7:5: error: shapes[0]: shape 's': "});
    expect_error(one("kind: hull, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]"),
                 {"test.yaml:7:5: error: shapes[0]: shape 's': "});
    // every fault is told, and a body of a faulty shape adds none
    const auto two = build_text(kHead +
                                "shapes:\n  - {name: a, kind: hull, points: [[0, 0, 0]]}\n"
                                "  - {name: b, kind: hull, points: [[1, 0, 0]]}\nbodies:\n"
                                "  - {generator: polyhedron, shape: a, material: glass, position: [0, 0, 0]}\n"
                                "  - {generator: lattice, shape: b, material: glass, corner: [0, 0, 0], pitch: 1, "
                                "cells: [2, 2, 2]}\n");
    EXPECT_NE(two.errors.find("shapes[0]: shape 'a': "), std::string::npos);
    EXPECT_NE(two.errors.find("shapes[1]: shape 'b': "), std::string::npos);
    EXPECT_EQ(two.errors.find("bodies["), std::string::npos) << two.errors;
}

TEST(NamedShapes, WhatMakesTroubleIsWarnedOf) {
    const auto warned = [](const std::string& shape) { return build_text(one(shape)).warnings; };
    EXPECT_NE(warned("kind: box, size: [1, 0.01, 0.01]").find("shape 's' is a needle, 100 times as long as wide"),
              std::string::npos);
    EXPECT_NE(warned("kind: box, size: [1, 1, 0.01]").find("shape 's' is a plate, 100 times as wide as thick"),
              std::string::npos);
    EXPECT_NE(warned("kind: hull, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1e-6, 0, 1]]")
                  .find("shape 's' has an edge of 7.1e-07 of its length"),
              std::string::npos)
        << warned("kind: hull, points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1e-6, 0, 1]]");
    EXPECT_EQ(warned("kind: box, size: [1, 0.2, 0.1]"), "");
    EXPECT_EQ(warned("kind: rock, diameter: 1, points: 100, variants: 20"), "");
}

}  // namespace
}  // namespace scree
