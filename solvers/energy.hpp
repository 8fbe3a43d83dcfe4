// Energies of the bodies, and the ledger's entries that need no contact: gravity that changes, bodies that come and go.
#pragma once

#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

double kinetic_energy(const Bodies& bodies);                         // [J], rotation included
double potential_energy(const Bodies& bodies, const Vec3& gravity);  // [J], -sum m g . x
Vec3 weighted_position(const Bodies& bodies);                        // sum m x [kg m]
// Kinetic and potential energy of body i.
double energy_of(const Bodies& bodies, std::size_t i, const Vec3& gravity);
// Takes the energies of the state into the ledger, with their extremes.
void update_energies(const Scene& scene, State& state);

}  // namespace scree::solvers
