// Materials, walls, flows, measures, settings: what becomes of the sections, and what is refused.
#include "scenarios/build.hpp"

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;

const std::string kBall = "bodies:\n  - {generator: sphere, material: glass, position: [0, 0, 1], radius: 0.1}\n";

PairLaw law(const Scene& scene, const std::string& a, const std::string& b) {
    MaterialIndex index[2]{};
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == a) index[0] = MaterialIndex{static_cast<std::uint16_t>(i)};
        if (scene.materials[i].name == b) index[1] = MaterialIndex{static_cast<std::uint16_t>(i)};
    }
    return scene.pairs(index[0], index[1]);
}

TEST(Materials, PairsThatAreNotListedTakeTheSmallerOfBoth) {
    const Scene scene = build_good(kHead).scene;
    EXPECT_EQ(law(scene, "glass", "glass").friction, 0.5);
    EXPECT_EQ(law(scene, "steel", "steel").restitution, 0.6);
    EXPECT_EQ(law(scene, "glass", "steel").friction, 0.3);
    EXPECT_EQ(law(scene, "steel", "glass").restitution, 0.2);
}

TEST(Materials, ListedPairsHoldForBothOrders) {
    const Scene scene = build_good(kHead + "pairs:\n  - {materials: [steel, glass], friction: 0.9}\n").scene;
    EXPECT_EQ(law(scene, "glass", "steel").friction, 0.9);
    EXPECT_EQ(law(scene, "steel", "glass").friction, 0.9);
    EXPECT_DOUBLE_EQ(law(scene, "glass", "steel").restitution, 0.4);
    EXPECT_EQ(law(scene, "glass", "glass").friction, 0.5);
}

TEST(Materials, RepeatedAndUnknownPairsAreErrors) {
    expect_error(kHead +
                     "pairs:\n  - {materials: [steel, glass], friction: 0.9}\n"
                     "  - {materials: [glass, steel], friction: 0.8}\n",
                 {"test.yaml:8", "already on line 7"});
    expect_error(kHead + "pairs:\n  - {materials: [stel, glass], friction: 0.9}\n", {"stel", "did you mean 'steel'"});
    expect_error(kHead + "bodies:\n  - {generator: sphere, material: gloss, position: [0, 0, 0], radius: 1}\n",
                 {"gloss", "did you mean 'glass'"});
}

TEST(Walls, AreBuiltWithUnitVectors) {
    const Scene scene =
        build_good(kHead +
                   "walls:\n"
                   "  - {shape: plane, name: p, material: steel, point: [0, 0, 1], normal: [0, 0, -5]}\n"
                   "  - {shape: cylinder, name: c, material: glass, base: [1, 2, 3], axis: [3, 0, 4], radius: 2}\n"
                   "  - {shape: slot_floor, name: s, material: glass, centre: [0, 0, 0], normal: [0, 0, 2],\n"
                   "     along: [1, 0, 1], width: 0.1, length: 0.3}\n"
                   "  - {shape: orifice_floor, name: o, material: glass, centre: [0, 0, 0], hole_diameter: 0.5,\n"
                   "     goes: 0.25}\n")
            .scene;
    ASSERT_EQ(scene.walls.size(), 4U);
    EXPECT_EQ(std::get<PlaneWall>(scene.walls[0].shape).normal, Vec3(0, 0, -1));
    EXPECT_EQ(scene.materials[raw(scene.walls[0].material)].name, "steel");
    const auto& cylinder = std::get<CylinderWall>(scene.walls[1].shape);
    EXPECT_TRUE(cylinder.axis.isApprox(Vec3(0.6, 0, 0.8)));
    EXPECT_TRUE(std::isinf(cylinder.length));
    EXPECT_TRUE(cylinder.inside);
    EXPECT_EQ(std::get<SlotFloor>(scene.walls[2].shape).along, Vec3(1, 0, 0));
    EXPECT_EQ(std::get<OrificeFloor>(scene.walls[3].shape).hole_radius, 0.25);
    EXPECT_EQ(scene.walls[3].goes, 0.25);
    EXPECT_EQ(scene.walls[0].goes, kForever);
}

TEST(Walls, MotionIsInSi) {
    const Scene scene = build_good(kHead +
                                   "walls:\n"
                                   "  - {shape: plane, name: p, material: steel, point: [0, 0, 0], normal: [0, 0, 1],\n"
                                   "     motion: {rate: 30 rpm, axis: [0, 2, 0], centre: [0, 0, 1], start: 0.5}}\n")
                            .scene;
    const WallMotion& m = scene.walls[0].motion;
    EXPECT_NEAR(m.rate, 3.14159265358979, 1e-13);
    EXPECT_EQ(m.axis, Vec3(0, 1, 0));
    EXPECT_EQ(m.centre, Vec3(0, 0, 1));
    EXPECT_EQ(m.start, 0.5);
    EXPECT_EQ(m.end, kForever);
}

TEST(Walls, WhatMakesNoSenseIsRefused) {
    const auto refused = [](const std::string& wall, const std::vector<std::string>& parts) {
        expect_error(kHead + "walls:\n  - {name: w, material: glass, " + wall + "}\n", parts);
    };
    refused("shape: plane, point: [0, 0, 0], normal: [0, 0, 0]", {"test.yaml:7", "normal"});
    refused("shape: box, lower: [0, 0, 0], upper: [1, 0, 1]", {"upper"});
    refused("shape: box, lower: [0, 0, 0], upper: [1, 1, 1], keeps: outside, open_top: true", {"open_top", "inside"});
    refused("shape: cone, base: [0, 0, 0], radius_base: 0, radius_end: 0, length: 1", {"radius_end"});
    refused("shape: slot_floor, centre: [0, 0, 0], normal: [0, 1, 1], along: [0, 2, 2], width: 1",
            {"along", "parallel"});
    refused("shape: plane, point: [0, 0, 0], normal: [0, 0, 1], appears: 2, goes: 1", {"goes"});
    refused("shape: plane, point: [0, 0, 0], normal: [0, 0, 1], motion: {amplitude: [0, 0, 1]}", {"frequency"});
    expect_error(kHead +
                     "walls:\n  - {shape: plane, name: w, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n"
                     "  - {shape: plane, name: w, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n",
                 {"test.yaml:8", "w"});
}

TEST(Walls, PolyhedraAreRefusedWhereNothingWouldHoldThem) {
    const auto scenario = [](const std::string& wall) {
        return kHead +
               "shapes:\n  - {name: cube, kind: box, size: 0.1}\nbodies:\n"
               "  - {generator: polyhedron, shape: cube, material: glass, position: [0, 0, 5]}\n"
               "walls:\n  - {name: w, material: glass, " +
               wall + "}\n";
    };
    for (const char* wall : {"shape: cylinder, base: [0, 0, 0], radius: 1, length: 2, keeps: outside",
                             "shape: orifice_floor, centre: [0, 0, 0], hole_diameter: 1"})
        expect_error(scenario(wall), {"test.yaml:11", "polyhedra do not feel this wall; expected a plane, a box"});
    for (const char* wall : {"shape: box, lower: [0, 0, 0], upper: [1, 1, 1], keeps: outside",
                             "shape: cylinder, base: [0, 0, 0], radius: 1, length: 2"})
        EXPECT_EQ(testing::build_text(scenario(wall)).errors, "");
}

TEST(Measures, FindTheirWallAndWindow) {
    const Scene scene =
        build_good(kHead +
                   "walls:\n"
                   "  - {shape: plane, name: a, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n"
                   "  - {shape: plane, name: b, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n"
                   "measures:\n"
                   "  - {measure: wall_force, name: f, wall: b, from: 0.25}\n"
                   "  - {measure: flow_rate, name: q, point: [0, 0, 1], normal: [0, 0, -2], radius: 0.5, until: 0.5}\n")
            .scene;
    ASSERT_EQ(scene.measures.size(), 2U);
    EXPECT_EQ(raw(scene.measures[0].wall), 1U);
    EXPECT_EQ(scene.measures[0].from, 0.25);
    EXPECT_EQ(scene.measures[0].until, 1.0);  // time.end
    EXPECT_EQ(scene.measures[1].surface.normal, Vec3(0, 0, -1));
    EXPECT_EQ(*scene.measures[1].surface.radius, 0.5);
}

TEST(Measures, UnknownWallsAndEmptyWindowsAreErrors) {
    expect_error(kHead +
                     "walls:\n  - {shape: plane, name: floor, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n"
                     "measures:\n  - {measure: wall_force, name: f, wall: flor}\n",
                 {"test.yaml:9", "flor", "did you mean 'floor'"});
    expect_error(kHead + "measures:\n  - {measure: extent, name: f, from: 2}\n",
                 {"from 2 s until 1 s (time.end) is empty"});
    expect_error(kHead + "measures:\n  - {measure: profile, name: f, lower: 2, upper: 1, bins: 3}\n", {"upper"});
}

TEST(Flows, AreBuiltAndCounted) {
    const scenarios::Built built =
        build_good(kHead +
                   "inlets:\n"
                   "  - {name: i, material: steel, size: {distribution: fixed, diameter: 0.1}, mass_rate: 3.6 t/h,\n"
                   "     region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}, velocity: [0, 0, -1], max_mass: 5}\n"
                   "outlets:\n"
                   "  - {name: o, region: {shape: half_space, point: [0, 0, -1], normal: [0, 0, 3]}, until: 0.5}\n");
    ASSERT_EQ(built.scene.inlets.size(), 1U);
    EXPECT_DOUBLE_EQ(built.scene.inlets[0].mass_rate, 1.0);
    EXPECT_EQ(built.scene.inlets[0].max_mass, 5.0);
    EXPECT_EQ(std::get<HalfSpaceRegion>(built.scene.outlets[0].region).normal, Vec3(0, 0, 1));
    EXPECT_EQ(built.state.inlets.size(), 1U);
    EXPECT_EQ(built.state.outlets.size(), 1U);
    expect_error(kHead +
                     "inlets:\n"
                     "  - {name: i, material: steel, size: {distribution: fixed, diameter: 2}, mass_rate: 1,\n"
                     "     region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}}\n",
                 {"does not fit"});
}

TEST(Settings, TimeMustBeCountable) {
    const std::string tail = "materials: {glass: {density: 1}}\n";
    expect_error("scenario_version: 1\ntime: {end: 1, step: 2}\n" + tail, {"test.yaml:2", "step", "time.end"});
    expect_error("scenario_version: 1\ntime: {end: 1e10, step: 1e-10}\n" + tail, {"more than can be counted"});
}

TEST(Settings, GravityTablesAreInOrderOfTime) {
    const Scene scene = build_good(kHead + "gravity_table: [[0, 0, 0, -10], [1, 5, 0, -10]]\n").scene;
    EXPECT_TRUE(scene.gravity.at(0.5).isApprox(Vec3(2.5, 0, -10)));
    expect_error(kHead + "gravity_table: [[1, 0, 0, -10], [1, 5, 0, -10]]\n", {"times must increase"});
    expect_error(kHead + "gravity: [0, 0, -1]\ngravity_table: [[1, 0, 0, -10]]\n", {"gravity"});
}

TEST(Settings, SizesMustBePossible) {
    const auto refused = [](const std::string& size, const std::string& part) {
        expect_error(kHead +
                         "bodies:\n  - {generator: lattice, material: glass, corner: [0, 0, 0], pitch: 1, cells: [1, "
                         "1, 1], size: {" +
                         size + "}}\n",
                     {part});
    };
    refused("distribution: uniform, lower: 2, upper: 1", "upper");
    refused("distribution: normal, mean: 1, deviation: 0.1, lower: 2", "lower");
    refused("distribution: table, rows: [[1, 0], [2, 0.5]]", "ends at 0.5");
    refused("distribution: table, rows: [[2, 0], [1, 1]]", "diameters must increase");
    refused("distribution: table, rows: [[1, 0.5], [2, 0.2], [3, 1]]", "must not fall");
}

TEST(State, HoldsSpinAndOrientationOnlyIfThePlanNeedsThem) {
    EXPECT_TRUE(build_good(kHead + kBall).state.bodies.spin.empty());  // one ball meets nothing
    const std::string plane =
        "walls:\n  - {shape: plane, name: w, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n";
    const Bodies rough = build_good(kHead + kBall + plane + "output: {fields: [orientation]}\n").state.bodies;
    ASSERT_EQ(rough.spin.size(), 1U);
    EXPECT_EQ(rough.orientation[0].w(), 1.0);

    const testing::Result smooth = testing::build_text(
        "scenario_version: 1\ntime: {end: 1, step: 1e-3}\nmaterials: {ice: {density: 900, friction: 0}}\n"
        "bodies:\n  - {generator: sphere, material: ice, position: [0, 0, 1], radius: 0.1, spin: [1, 0, 0]}\n");
    EXPECT_EQ(smooth.errors, "");
    EXPECT_TRUE(smooth.built.state.bodies.spin.empty());
    EXPECT_NE(smooth.warnings.find("spin"), std::string::npos);
}

TEST(State, SceneAloneIsTheSameScene) {
    const std::string text =
        kHead + kBall +
        "walls:\n  - {shape: plane, name: w, material: glass, point: [0, 0, 7], normal: [0, 0, 1]}\n"
        "measures:\n  - {measure: wall_force, name: f, wall: w}\n";
    io::Diagnostics diagnostics;
    const io::ReadResult read = io::read_scenario_text(text, "test.yaml", {}, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors());
    const Scene scene = scenarios::build_scene(read.root, ".", diagnostics);
    EXPECT_EQ(diagnostics.report(), "");
    EXPECT_EQ(std::get<PlaneWall>(scene.walls.at(0).shape).point, Vec3(0, 0, 7));
    EXPECT_EQ(scene.measures.size(), 1U);
    EXPECT_EQ(scene.pairs.materials(), 2U);
}

}  // namespace
}  // namespace scree
