#include "app/memory_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/state.hpp"
#include "scenarios/shapes/solids.hpp"
#include "solvers/energy.hpp"
#include "solvers/stepper.hpp"

namespace scree::app {
namespace {

constexpr std::size_t kEdge = 10;  // bodies along the edge of the trial cube
constexpr double kSize = 2.0;      // [m] diameter of the spheres, edge of the cubes

template <class T>
std::size_t held(const std::vector<T>& v) {
    return v.capacity() * sizeof(T);
}

std::size_t state_bytes(const State& state) {
    const Bodies& b = state.bodies;
    const WarmStart& w = state.warm_start;
    return held(b.id) + held(b.radius) + held(b.mass) + held(b.material) + held(b.position) + held(b.velocity) +
           held(b.spin) + held(b.orientation) + held(b.shape) + held(b.inertia) + held(w.key) + held(w.impulse_vector) +
           held(w.impulse_normal);
}

State trial_state(const Plan& plan, const Vec3& pitch) {
    State state;
    const std::size_t n = kEdge * kEdge * kEdge;
    Bodies& b = state.bodies;
    b.radius.assign(n, 0.5 * kSize);
    b.mass.assign(n, 1.0);
    b.material.assign(n, MaterialIndex{0});
    b.velocity.assign(n, Vec3::Zero());
    if (plan.spin) b.spin.assign(n, Vec3::Zero());
    if (plan.orientation) b.orientation.assign(n, Quat::Identity());
    if (plan.polyhedra) {
        state.shapes.push_back(scenarios::box(Vec3::Constant(kSize)).shape);
        b.shape.assign(n, ShapeIndex{0});
        b.inertia.assign(n, state.shapes[0].inertia / state.shapes[0].volume);
        b.radius.assign(n, state.shapes[0].radius);
    }
    b.id.reserve(n);
    b.position.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        b.id.push_back(BodyId{i});
        b.position.push_back(
            pitch.cwiseProduct(Vec3(static_cast<double>(i % kEdge), static_cast<double>(i / kEdge % kEdge),
                                    static_cast<double>(i / kEdge / kEdge))));
    }
    state.next_id = n;
    return state;
}

struct Trial {
    std::size_t bytes, contacts;
};

Trial trial(const Scene& scene, const Plan& plan, const Vec3& pitch) {
    State state = trial_state(plan, pitch);
    solvers::start_ledger(scene, state);
    solvers::Stepper stepper(scene, plan);
    const StepReport report = stepper.advance(state);
    return {stepper.bytes() + state_bytes(state), report.contacts};
}

}  // namespace

void measure_memory(const Scene& scene, Plan& plan) {
    Scene bare = scene;
    bare.walls.clear();
    bare.inlets.clear();
    bare.outlets.clear();
    bare.measures.clear();
    bare.gravity = TimeTable::constant(Vec3::Zero());
    const double near = kSize * (1.0 - 1e-6), far = 2.0 * kSize;
    const Trial apart = trial(bare, plan, Vec3::Constant(far));
    // cubes in rows: with neighbours on all sides they would touch at edges and corners too
    const Trial touching = trial(bare, plan, plan.polyhedra ? Vec3(near, far, far) : Vec3(Vec3::Constant(near)));
    SCREE_CHECK(apart.contacts == 0 && touching.contacts > 0);
    plan.bytes_per_body = apart.bytes / (kEdge * kEdge * kEdge);
    plan.bytes_per_contact = (std::max(touching.bytes, apart.bytes) - apart.bytes) / touching.contacts;
}

}  // namespace scree::app
