#include "solvers/energy.hpp"

#include <algorithm>

#include "solvers/stepper.hpp"

namespace scree::solvers {

double kinetic_energy(const Bodies& bodies) {
    double twice = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        twice += bodies.mass[i] * bodies.velocity[i].squaredNorm();
        if (bodies.has_spin()) {
            const double inertia = Bodies::kSphereInertia * bodies.mass[i] * bodies.radius[i] * bodies.radius[i];
            twice += inertia * bodies.spin[i].squaredNorm();
        }
    }
    return 0.5 * twice;
}

Vec3 weighted_position(const Bodies& bodies) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < bodies.size(); ++i) sum += bodies.mass[i] * bodies.position[i];
    return sum;
}

double potential_energy(const Bodies& bodies, const Vec3& gravity) {
    return -gravity.dot(weighted_position(bodies));
}

double energy_of(const Bodies& bodies, std::size_t i, const Vec3& gravity) {
    double energy = 0.5 * bodies.mass[i] * bodies.velocity[i].squaredNorm();
    if (bodies.has_spin())
        energy += 0.5 * Bodies::kSphereInertia * bodies.mass[i] * bodies.radius[i] * bodies.radius[i] *
                  bodies.spin[i].squaredNorm();
    return energy - bodies.mass[i] * gravity.dot(bodies.position[i]);
}

void update_energies(const Scene& scene, State& state) {
    Ledger& ledger = state.ledger;
    ledger.kinetic = kinetic_energy(state.bodies);
    ledger.potential = potential_energy(state.bodies, scene.gravity.at(state.time));
    ledger.kinetic_max = std::max(ledger.kinetic_max, ledger.kinetic);
    ledger.potential_min = std::min(ledger.potential_min, ledger.potential);
    ledger.potential_max = std::max(ledger.potential_max, ledger.potential);
}

void start_ledger(const Scene& scene, State& state) {
    Ledger ledger;
    ledger.kinetic_0 = ledger.kinetic = ledger.kinetic_max = kinetic_energy(state.bodies);
    ledger.potential_0 = potential_energy(state.bodies, scene.gravity.at(state.time));
    ledger.potential = ledger.potential_min = ledger.potential_max = ledger.potential_0;
    state.ledger = ledger;
}

}  // namespace scree::solvers
