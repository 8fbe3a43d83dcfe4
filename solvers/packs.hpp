// What the kernels of all laws share.
#pragma once

#include <type_traits>

#include "core/simd_rows.hpp"

namespace scree::solvers {

// Keeps 0/0 away: no square of a scene is that small, nor one in the units of single precision.
template <class Real>
inline constexpr Real kTiny = std::is_same_v<Real, float> ? Real(1e-36) : Real(1e-300);
inline constexpr double kSingleRound = 1e-6;  // more than single precision makes of an impulse, relative

template <class Real>
Pack3Of<Real> load3(const Real (&x)[3][PackOf<Real>::kLanes]) {
    return {PackOf<Real>::load(x[0]), PackOf<Real>::load(x[1]), PackOf<Real>::load(x[2])};
}
template <class Real>
void store3(Real (&x)[3][PackOf<Real>::kLanes], const Pack3Of<Real>& a) {
    a.x.store(x[0]);
    a.y.store(x[1]);
    a.z.store(x[2]);
}

// Work of impulses [J], normal and tangential.
struct WorkPacks {
    Pack normal, tangential;
};

}  // namespace scree::solvers
