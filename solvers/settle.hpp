// Sweeps over displacements until none moves a contact any more: the inner loop of the corrections of positions.
#pragma once

#include <array>
#include <cmath>

#include "core/parallel/communicator.hpp"
#include "solvers/sweeps.hpp"

namespace scree::solvers {

// Sweeps end when none moves a contact by more than this share of the smallest diameter.
inline constexpr double kSettled = 1e-4;
inline constexpr int kSweepsALook = 4;  // a look is a maximum over all ranks
// Deep overlaps are those of impacts: all of them goes at once, but for this share of the diameter.
inline constexpr double kMostLeft = 3e-3;

// The gap [m] that a displacement has to close, c = share * gap where bodies overlap.
inline double correction_bias(double gap, double share, double diameter) {
    return gap < 0.0 ? std::min(share * gap, gap + kMostLeft * diameter) : gap;
}

// `settled` [m], of this rank's contacts; `unit` [m] of the lines. Returns the number of sweeps. Collective.
template <class Law, class Real, class Order>
int sweep_until_settled(Sweeps<Law, Real>& sweeps, const Order& order, LineExchange& exchange, double settled,
                        double unit, int most, const Communicator& ranks) {
    using Numbers = PackOf<Real>;
    const Numbers none = Numbers::all(0);
    for (int sweep = 1; sweep <= most; ++sweep) {
        Numbers farthest = none;
        sweeps.over_blocks(order, &exchange, [&](std::uint32_t k) {
            farthest = max(farthest, update<false>(sweeps.batch[k], sweeps.line.data(), nullptr, none));
        });
        std::array<double, 2> of_all{max_lanes(farthest), -settled};
        const bool look = sweep % kSweepsALook == 0;
        if (look) ranks.max(of_all);
        sweeps.complete(&exchange);
        if (look && unit * std::sqrt(of_all[0]) <= -of_all[1]) return sweep;
    }
    return most;
}

}  // namespace scree::solvers
