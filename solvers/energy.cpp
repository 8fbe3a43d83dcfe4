#include "solvers/energy.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel/body_sums.hpp"
#include "solvers/rotation.hpp"

namespace scree::solvers {
namespace {

// Twice the kinetic energy of rotation [J].
double spin_energy_of_sphere(const Bodies& bodies, std::size_t i) {
    return Bodies::kSphereInertia * bodies.mass[i] * bodies.radius[i] * bodies.radius[i] * bodies.spin[i].squaredNorm();
}
double spin_energy_of_shape(const Bodies& bodies, std::size_t i) {
    return angular_momentum(bodies.orientation[i], bodies.inertia[i], bodies.spin[i]).dot(bodies.spin[i]);
}

Vec3 three(std::span<const ExactSum> sums) {
    return {sums[0].value(), sums[1].value(), sums[2].value()};
}

}  // namespace

void add_momentum(const Bodies& bodies, std::span<ExactSum, kMomentumSums> sums) {
    add_over_bodies(bodies, sums, [&](std::size_t i) {
        const double mass = bodies.mass[i];
        const Vec3& v = bodies.velocity[i];
        return std::array{mass * v.x(), mass * v.y(), mass * v.z(), mass * v.norm(), mass};
    });
}
Momentum read_momentum(std::span<const ExactSum, kMomentumSums> sums) {
    return {three(sums), sums[3].value(), sums[4].value()};
}
Momentum momentum_of(const Bodies& bodies, const Communicator& ranks) {
    std::array<ExactSum, kMomentumSums> sums;
    add_momentum(bodies, sums);
    ranks.sum(sums);
    return read_momentum(sums);
}

void add_energies(const Bodies& bodies, std::span<ExactSum, kEnergySums> sums) {
    const auto add = [&](auto spin_energy) {  // twice the kinetic energy comes first
        add_over_bodies(bodies, sums, [&](std::size_t i) {
            const double mass = bodies.mass[i];
            const Vec3& x = bodies.position[i];
            return std::array{mass * bodies.velocity[i].squaredNorm() + spin_energy(i), mass * x.x(), mass * x.y(),
                              mass * x.z()};
        });
    };
    if (bodies.has_shapes())
        add([&](std::size_t i) { return spin_energy_of_shape(bodies, i); });
    else if (bodies.has_spin())
        add([&](std::size_t i) { return spin_energy_of_sphere(bodies, i); });
    else
        add([](std::size_t) { return 0.0; });
}
Energies read_energies(std::span<const ExactSum, kEnergySums> sums) {
    return {0.5 * sums[0].value(), three(sums.subspan<1>())};
}
Energies energies_of(const Bodies& bodies, const Communicator& ranks) {
    std::array<ExactSum, kEnergySums> sums;
    add_energies(bodies, sums);
    ranks.sum(sums);
    return read_energies(sums);
}

void add_weighted_position(const Bodies& bodies, std::span<ExactSum, kPositionSums> sums) {
    add_over_bodies(bodies, sums, [&](std::size_t i) {
        const Vec3& x = bodies.position[i];
        return std::array{bodies.mass[i] * x.x(), bodies.mass[i] * x.y(), bodies.mass[i] * x.z()};
    });
}
Vec3 read_weighted_position(std::span<const ExactSum, kPositionSums> sums) {
    return three(sums);
}

double kinetic_energy(const Bodies& bodies, const Communicator& ranks) {
    return energies_of(bodies, ranks).kinetic;
}
double potential_energy(const Bodies& bodies, const Vec3& gravity, const Communicator& ranks) {
    return energies_of(bodies, ranks).potential(gravity);
}
Vec3 weighted_position(const Bodies& bodies, const Communicator& ranks) {
    std::array<ExactSum, kPositionSums> sums;
    add_weighted_position(bodies, sums);
    ranks.sum(sums);
    return read_weighted_position(sums);
}

double energy_of(const Bodies& bodies, std::size_t i, const Vec3& gravity) {
    double energy = 0.5 * bodies.mass[i] * bodies.velocity[i].squaredNorm();
    if (bodies.has_shapes())
        energy += 0.5 * spin_energy_of_shape(bodies, i);
    else if (bodies.has_spin())
        energy += 0.5 * spin_energy_of_sphere(bodies, i);
    return energy - bodies.mass[i] * gravity.dot(bodies.position[i]);
}

void update_energies(const Scene& scene, const Energies& energies, State& state) {
    Ledger& ledger = state.ledger;
    ledger.kinetic = energies.kinetic;
    ledger.potential = energies.potential(scene.gravity.at(state.time));
    ledger.kinetic_max = std::max(ledger.kinetic_max, ledger.kinetic);
    ledger.potential_min = std::min(ledger.potential_min, ledger.potential);
    ledger.potential_max = std::max(ledger.potential_max, ledger.potential);
}
void update_energies(const Scene& scene, State& state, const Communicator& ranks) {
    update_energies(scene, energies_of(state.bodies, ranks), state);
}

void start_ledger(const Scene& scene, State& state, const Communicator& ranks) {
    const Energies energies = energies_of(state.bodies, ranks);
    Ledger ledger;
    ledger.kinetic_0 = ledger.kinetic = ledger.kinetic_max = energies.kinetic;
    ledger.potential_0 = energies.potential(scene.gravity.at(state.time));
    ledger.potential = ledger.potential_min = ledger.potential_max = ledger.potential_0;
    state.ledger = ledger;
}

}  // namespace scree::solvers
