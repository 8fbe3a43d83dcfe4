// The energy ledger: every way in which energy enters or leaves, summed since the start [J].
//   kinetic + potential - (kinetic + potential)_0 = sum of the entries,   to round-off at theta = 1/2,
// because a step changes the kinetic energy by exactly  sum_c p_c . (u_c- + u_c+)/2 + h F . (v- + v+)/2.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "core/vec.hpp"

namespace scree {

enum class Work : std::size_t {
    restitution,  // normal impulses between bodies and with walls, on the relative velocity (<= 0 for one impact)
    friction,     // tangential impulses on the slip
    walls,        // by moving walls: impulse . velocity of the wall
    correction,   // potential energy given by the correction of positions
    gravity,      // potential energy given by a change of gravity in time
    inlets,       // kinetic and potential energy of bodies that came
    outlets,      // and that went (negative)
    rotation,     // kinetic energy of free rotation that the time step does not keep exactly (asymmetric bodies only)
    count_
};
inline constexpr std::size_t kWorkCount = static_cast<std::size_t>(Work::count_);
inline constexpr std::array<std::string_view, kWorkCount> kWorkNames = {
    "restitution", "friction", "walls", "correction", "gravity", "inlets", "outlets", "rotation"};

struct Ledger {
    double kinetic_0 = 0.0, potential_0 = 0.0;  // [J] at the start
    double kinetic = 0.0, potential = 0.0;      // [J] now; potential = -sum m g . x, relative to the scene's origin
    std::array<double, kWorkCount> work{};      // [J] since the start
    double kinetic_max = 0.0;                   // [J] largest so far
    double potential_min = 0.0, potential_max = 0.0;  // [J]
    // Energy that single contacts added (restitution with friction can): sum and the largest with its contact.
    double gained = 0.0;

    double& operator[](Work w) { return work[static_cast<std::size_t>(w)]; }
    double operator[](Work w) const { return work[static_cast<std::size_t>(w)]; }
    double total_work() const {
        double sum = 0.0;
        for (double w : work) sum += w;
        return sum;
    }
    double imbalance() const { return kinetic + potential - kinetic_0 - potential_0 - total_work(); }
    // |imbalance| over the range of energies met so far; 0 when there was none, or within the energies' own round-off.
    double drift() const;
};

}  // namespace scree
