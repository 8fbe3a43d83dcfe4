#include "core/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

double Ledger::drift() const {
    const double range = std::max(kinetic_max, potential_max - potential_min);
    return range > 0.0 ? std::abs(imbalance()) / range : 0.0;
}

}  // namespace scree
