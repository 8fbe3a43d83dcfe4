// Sums over all bodies, momentum and energies, and the ledger's entries that need no contact. Own bodies count, ghosts
// do not. Every sum is exact before it is rounded once (core/exact_sum.hpp): no split of the bodies over ranks and no
// order changes a bit. What is not finite makes the sum nan.
//
// A step needs several of these sums: add_...() makes this rank's part, Communicator::sum(std::span<ExactSum>) adds the
// parts of all ranks, many sums in one message, and the read functions turn them into numbers.
#pragma once

#include <array>
#include <span>

#include "core/exact_sum.hpp"
#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

struct Momentum {
    Vec3 sum = Vec3::Zero();  // sum m v [N s]
    double size = 0.0;        // sum m |v| [N s]
    double mass = 0.0;        // [kg]
};
inline constexpr std::size_t kMomentumSums = 5;
void add_momentum(const Bodies& bodies, std::span<ExactSum, kMomentumSums> sums);
Momentum read_momentum(std::span<const ExactSum, kMomentumSums> sums);
Momentum momentum_of(const Bodies& bodies, const Communicator& ranks = Communicator::self());  // one reduction

struct Energies {
    double kinetic = 0.0;                   // [J], rotation included
    Vec3 weighted_position = Vec3::Zero();  // sum m x [kg m]

    double potential(const Vec3& gravity) const { return -gravity.dot(weighted_position); }  // [J], -sum m g . x
};
inline constexpr std::size_t kEnergySums = 4;
void add_energies(const Bodies& bodies, std::span<ExactSum, kEnergySums> sums);
Energies read_energies(std::span<const ExactSum, kEnergySums> sums);
Energies energies_of(const Bodies& bodies, const Communicator& ranks = Communicator::self());  // one reduction

inline constexpr std::size_t kPositionSums = 3;
void add_weighted_position(const Bodies& bodies, std::span<ExactSum, kPositionSums> sums);
Vec3 read_weighted_position(std::span<const ExactSum, kPositionSums> sums);

// One of these numbers alone, each with a reduction.
double kinetic_energy(const Bodies& bodies, const Communicator& ranks = Communicator::self());
double potential_energy(const Bodies& bodies, const Vec3& gravity, const Communicator& ranks = Communicator::self());
Vec3 weighted_position(const Bodies& bodies, const Communicator& ranks = Communicator::self());

// Kinetic and potential energy of body i.
double energy_of(const Bodies& bodies, std::size_t i, const Vec3& gravity);

// Takes the energies of the state into the ledger, with their extremes.
void update_energies(const Scene& scene, State& state, const Communicator& ranks = Communicator::self());
void update_energies(const Scene& scene, const Energies& energies, State& state);  // if they are known already
// Sets the ledger's energies at the start of a run.
void start_ledger(const Scene& scene, State& state, const Communicator& ranks = Communicator::self());

}  // namespace scree::solvers
