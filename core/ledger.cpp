#include "core/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

// What the rounding of the energies themselves can make of the imbalance is none: in a scene at rest the range of
// energies is itself nothing but such round-off.
double Ledger::drift() const {
    const double round_off = 16.0 * std::numeric_limits<double>::epsilon() *
                             (std::abs(kinetic) + std::abs(potential) + std::abs(kinetic_0) + std::abs(potential_0));
    if (std::abs(imbalance()) <= round_off) return 0.0;
    const double range = std::max(kinetic_max, potential_max - potential_min);
    return range > 0.0 ? std::abs(imbalance()) / range : 0.0;
}

}  // namespace scree
