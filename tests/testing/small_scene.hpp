// A small scene built in C++, with its state: what the tests of contacts, of the solver and of the physics start from.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/make_shape.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::testing {

// One material of 2500 kg/m3 that meets itself with `friction` and `restitution`. Solved to round-off and without the
// correction of positions unless a test says otherwise: then the closed forms hold to the last digits.
struct SmallScene {
    Scene scene;
    State state;

    explicit SmallScene(double step, double friction = 0.0, double restitution = 0.0) {
        scene.materials = {{"grain", 2500.0}};
        scene.pairs = PairTable(1);
        scene.pairs.set(MaterialIndex{0}, MaterialIndex{0}, {friction, restitution});
        scene.time.step = step;
        scene.solver.tolerance = 1e-13;
        scene.solver.max_sweeps = 5000;
        scene.correction.on = false;
    }

    // The solver and the correction of positions as a run has them that sets nothing.
    void standard_settings() {
        scene.solver = {};
        scene.correction = {};
    }
    void gravity(const Vec3& g) { scene.gravity = TimeTable::constant(g); }
    // `mass` 0: by the material's density.
    std::size_t add(const Vec3& position, double radius, const Vec3& velocity = Vec3::Zero(),
                    const Vec3& spin = Vec3::Zero(), double mass = 0.0) {
        Bodies& b = state.bodies;
        b.id.push_back(BodyId{state.next_id++});
        b.radius.push_back(radius);
        b.mass.push_back(mass > 0.0 ? mass : Bodies::sphere_mass(radius, scene.materials[0].density));
        b.material.push_back(MaterialIndex{0});
        b.position.push_back(position);
        b.velocity.push_back(velocity);
        given_spins.push_back(spin);
        if (!state.shapes.empty()) know_shapes();
        return b.size() - 1;
    }
    // A polyhedron in a frame of its own, turned about the origin and moved: one shape a call.
    std::size_t add(const Polyhedron& polyhedron, const Vec3& position, const Quat& turn = Quat::Identity(),
                    const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
        const PlacedShape placed = make_shape(polyhedron);
        const double density = scene.materials[0].density;
        state.shapes.push_back(placed.shape);
        const std::size_t i =
            add(position + turn * placed.centre, placed.shape.radius, velocity, spin, density * placed.shape.volume);
        Bodies& b = state.bodies;
        b.shape[i] = ShapeIndex{static_cast<std::uint32_t>(state.shapes.size() - 1)};
        b.orientation[i] = (turn * placed.rotation).normalized();
        b.inertia[i] = density * placed.shape.inertia;
        return i;
    }
    std::size_t add_wall(const WallShape& shape, const WallMotion& motion = {}) {
        scene.walls.push_back({"wall" + std::to_string(scene.walls.size()), MaterialIndex{0}, shape, motion});
        return scene.walls.size() - 1;
    }
    std::size_t add_floor() { return add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}); }

    Vec3& position(std::size_t i = 0) { return state.bodies.position[i]; }
    Vec3& velocity(std::size_t i = 0) { return state.bodies.velocity[i]; }
    Vec3& spin(std::size_t i = 0) { return state.bodies.spin[i]; }
    double radius(std::size_t i = 0) const { return state.bodies.radius[i]; }
    double mass(std::size_t i = 0) const { return state.bodies.mass[i]; }
    double energy() const { return state.ledger.kinetic + state.ledger.potential; }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < state.bodies.size(); ++i) sum += state.bodies.mass[i] * state.bodies.velocity[i];
        return sum;
    }
    double fastest() const {
        double v = 0.0;
        for (const Vec3& u : state.bodies.velocity) v = std::max(v, u.norm());
        return v;
    }

    std::vector<Vec3> given_spins;  // used by scenes with friction or polyhedra

  private:
    // The arrays that scenes of spheres do not have, as long as the others.
    void know_shapes() {
        Bodies& b = state.bodies;
        for (std::size_t i = b.shape.size(); i < b.size(); ++i) {
            b.shape.push_back(kSphere);
            b.orientation.push_back(Quat::Identity());
            b.inertia.push_back(Vec3::Constant(Bodies::kSphereInertia * b.mass[i] * b.radius[i] * b.radius[i]));
        }
    }
};

}  // namespace scree::testing
