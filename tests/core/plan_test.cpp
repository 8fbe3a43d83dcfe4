#include "core/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace scree {
namespace {

const MaterialIndex kRough{0}, kSmooth{1}, kSteel{2};

// rough-rough 0.5 / 0.1; everything else without friction and restitution
Scene scene_of_three_materials() {
    Scene scene;
    scene.materials = {{"rough", 1000.0}, {"smooth", 1000.0}, {"steel", 7800.0}};
    scene.pairs = PairTable(3);
    scene.pairs.set(kRough, kRough, {0.5, 0.1});
    return scene;
}

Bodies bodies_of(const std::vector<MaterialIndex>& materials) {
    Bodies b;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        b.id.push_back(BodyId{i});
        b.material.push_back(materials[i]);
    }
    return b;
}

Wall wall_of(MaterialIndex material) {
    Wall wall;
    wall.name = "ground";
    wall.material = material;
    wall.shape = PlaneWall{Vec3::Zero(), Vec3::UnitZ()};
    return wall;
}

const PlanLine& line(const Plan& plan, const std::string& feature) {
    const auto found =
        std::find_if(plan.lines.begin(), plan.lines.end(), [&](const PlanLine& l) { return l.feature == feature; });
    if (found == plan.lines.end()) throw std::runtime_error("no line for " + feature);
    return *found;
}

TEST(Plan, FrictionCountsOnlyBetweenMaterialsThatMeet) {
    Scene scene = scene_of_three_materials();
    EXPECT_TRUE(make_plan(scene, bodies_of({kRough, kRough})).friction);
    EXPECT_FALSE(make_plan(scene, bodies_of({kSmooth, kSmooth})).friction);
    EXPECT_FALSE(make_plan(scene, bodies_of({kRough, kSmooth})).friction);  // one rough body meets no other
    EXPECT_FALSE(make_plan(scene, bodies_of({kRough})).friction);
    scene.walls = {wall_of(kRough)};
    EXPECT_TRUE(make_plan(scene, bodies_of({kRough})).friction);
    EXPECT_FALSE(make_plan(scene, bodies_of({kSmooth})).friction);
}

TEST(Plan, RestitutionLikewise) {
    Scene scene = scene_of_three_materials();
    EXPECT_TRUE(make_plan(scene, bodies_of({kRough, kRough})).restitution);
    EXPECT_FALSE(make_plan(scene, bodies_of({kRough, kSmooth})).restitution);
}

TEST(Plan, MaterialsOfInletsCount) {
    Scene scene = scene_of_three_materials();
    Inlet inlet;
    inlet.material = kRough;
    scene.inlets = {inlet};
    const Plan plan = make_plan(scene, Bodies{});
    EXPECT_TRUE(plan.friction);
    EXPECT_TRUE(plan.inlets);
}

TEST(Plan, ReasonsNameWhatIsBehindThem) {
    Scene scene = scene_of_three_materials();
    const Plan smooth = make_plan(scene, bodies_of({kSmooth, kSmooth}));
    EXPECT_FALSE(line(smooth, "friction").on);
    EXPECT_EQ(line(smooth, "friction").reason, "no tangential impulse, no spin: every friction coefficient is 0");
    const Plan rough = make_plan(scene, bodies_of({kRough, kRough}));
    EXPECT_TRUE(line(rough, "friction").on);
    EXPECT_NE(line(rough, "friction").reason.find("0.5 (rough with rough)"), std::string::npos);
    for (const char* absent : {"polyhedra", "terrain", "cohesion", "rolling friction"}) {
        EXPECT_FALSE(line(rough, absent).on);
        EXPECT_FALSE(line(rough, absent).reason.empty());
    }
}

// The bodies with friction may have left through an outlet when a run is resumed; it goes on as it began.
TEST(Plan, BodiesThatCarrySpinsKeepFriction) {
    const Scene scene = scene_of_three_materials();
    Bodies bodies = bodies_of({kSmooth});
    bodies.spin = {Vec3::Zero()};
    EXPECT_TRUE(make_plan(scene, bodies).friction);
}

TEST(Plan, FollowsTheSettings) {
    Scene scene = scene_of_three_materials();
    Plan plan = make_plan(scene, Bodies{});
    EXPECT_TRUE(plan.correction && plan.warm_start && plan.acceleration);
    EXPECT_FALSE(plan.orientation || plan.moving_walls || plan.inlets || plan.outlets || plan.changing_gravity ||
                 plan.contact_records);

    scene.correction.on = false;
    scene.solver.warm_start = false;
    scene.solver.method = SolverMethod::gauss_seidel;
    scene.output.fields = {"velocity", "orientation"};
    scene.walls = {wall_of(kSteel)};
    scene.walls[0].motion.rate = 1.0;
    scene.outlets.resize(1);
    scene.gravity = {{0.0, 1.0}, {Vec3::Zero(), Vec3::UnitX()}};
    plan = make_plan(scene, Bodies{});
    EXPECT_FALSE(plan.correction || plan.warm_start || plan.acceleration);
    EXPECT_TRUE(plan.orientation && plan.moving_walls && plan.outlets && plan.changing_gravity);
}

TEST(Plan, ContactRecordsAreMadeForThoseWhoReadThem) {
    Scene scene = scene_of_three_materials();
    Measure measure;
    measure.kind = MeasureKind::wall_force;
    scene.measures = {measure};
    EXPECT_FALSE(make_plan(scene, Bodies{}).contact_records);
    scene.measures[0].kind = MeasureKind::coordination;
    EXPECT_TRUE(make_plan(scene, Bodies{}).contact_records);
    scene.measures.clear();
    scene.output.contacts = true;
    EXPECT_TRUE(make_plan(scene, Bodies{}).contact_records);
}

}  // namespace
}  // namespace scree
