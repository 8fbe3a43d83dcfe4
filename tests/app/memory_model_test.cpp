#include "app/memory_model.hpp"

#include <gtest/gtest.h>

namespace scree::app {
namespace {

Plan plan_of(double friction, bool polyhedra = false) {
    Scene scene;
    scene.time.step = 1e-3;
    scene.time.end = 1.0;
    scene.materials = {{"stone", 2600.0}};
    scene.pairs = PairTable(1);
    scene.pairs.set(MaterialIndex{0}, MaterialIndex{0}, {friction, 0.0});
    Bodies bodies;
    bodies.material.assign(2, MaterialIndex{0});
    if (polyhedra) bodies.shape.assign(2, ShapeIndex{0});
    Plan plan = make_plan(scene, bodies);
    measure_memory(scene, plan);
    return plan;
}

// At least the state itself: id, radius, mass, material, position, velocity; key and impulse of the warm start.
TEST(MemoryModel, HoldsAtLeastTheState) {
    const Plan plan = plan_of(0.5);
    EXPECT_TRUE(plan.friction);
    EXPECT_GE(plan.bytes_per_body, 98U);
    EXPECT_LT(plan.bytes_per_body, 2000U);
    EXPECT_GE(plan.bytes_per_contact, 48U);
    EXPECT_LT(plan.bytes_per_contact, 2000U);
}

TEST(MemoryModel, SpinsAndTangentsAreNotHeldWithoutFriction) {
    const Plan with = plan_of(0.5), without = plan_of(0.0);
    EXPECT_FALSE(without.friction);
    EXPECT_LE(without.bytes_per_body + 24U, with.bytes_per_body);
    EXPECT_LE(without.bytes_per_contact + 16U, with.bytes_per_contact);
}

// Beside what spheres have: orientation, shape, inertia.
TEST(MemoryModel, PolyhedraTakeMore) {
    for (const double friction : {0.0, 0.5}) {
        const Plan spheres = plan_of(friction), polyhedra = plan_of(friction, true);
        EXPECT_TRUE(polyhedra.polyhedra);
        EXPECT_GE(polyhedra.bytes_per_body, spheres.bytes_per_body + 32U + 4U + 24U);
        EXPECT_LT(polyhedra.bytes_per_body, 5000U);
        EXPECT_GE(polyhedra.bytes_per_contact, 48U);
        EXPECT_LT(polyhedra.bytes_per_contact, 5000U);
    }
}

}  // namespace
}  // namespace scree::app
