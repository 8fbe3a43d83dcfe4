// Lines and batches from double into single precision, in units in which their numbers are of order 1 (powers of two:
// scaled without round-off).
#pragma once

#include <algorithm>
#include <cstddef>

#include "solvers/batch.hpp"
#include "solvers/rigid_batch.hpp"

namespace scree::solvers {

struct SingleUnits {
    double velocity = 1.0;      // [m/s]
    double inverse_mass = 1.0;  // [1/kg]
    double length = 1.0;        // [m], of bodies that are not spheres

    double impulse() const { return velocity / inverse_mass; }  // [N s]
};

namespace detail {
template <std::size_t kRows>
void put(float (&to)[kRows][kLanesSingle], const double (&from)[kRows][kLanes], int lane, double unit) {
    for (std::size_t d = 0; d < kRows; ++d)
        for (int i = 0; i < kLanes; ++i) to[d][lane + i] = static_cast<float>(from[d][i] * (1.0 / unit));
}
inline void put(float (&to)[kLanesSingle], const double (&from)[kLanes], int lane, double unit) {
    for (int i = 0; i < kLanes; ++i) to[lane + i] = static_cast<float>(from[i] * (1.0 / unit));
}
template <std::size_t kNumbers>
void put(float (&to)[kNumbers], const double (&from)[kNumbers], double unit) {
    for (std::size_t d = 0; d < kNumbers; ++d) to[d] = static_cast<float>(from[d] * (1.0 / unit));
}
// What every batch has.
template <class Single, class Double>
void put_contact(Single& to, const Double& from, int lane, const SingleUnits& unit) {
    std::copy(from.a, from.a + kLanes, to.a + lane);
    std::copy(from.b, from.b + kLanes, to.b + lane);
    put(to.n, from.n, lane, 1.0);
    put(to.bias, from.bias, lane, unit.velocity);
    put(to.p, from.p, lane, unit.impulse());
}
template <class Single, class Double>
void put_body(Single& to, const Double& from, const SingleUnits& unit) {
    put(to.v, from.v, unit.velocity);
    to.inverse_mass = static_cast<float>(from.inverse_mass * (1.0 / unit.inverse_mass));
}
}  // namespace detail

inline void to_single(SlidingLineOf<float>& to, const SlidingLine& from, const SingleUnits& unit) {
    detail::put_body(to, from, unit);
}
inline void to_single(SpinningLineOf<float>& to, const SpinningLine& from, const SingleUnits& unit) {
    detail::put_body(to, from, unit);
    detail::put(to.w, from.w, unit.velocity);
    to.inverse_inertia = static_cast<float>(from.inverse_inertia * (1.0 / unit.inverse_mass));
}
inline void to_single(RigidLineOf<float>& to, const RigidLine& from, const SingleUnits& unit) {
    detail::put_body(to, from, unit);
    detail::put(to.w, from.w, unit.velocity / unit.length);
    detail::put(to.j, from.j, unit.inverse_mass / (unit.length * unit.length));
}

// Eight contacts into the lanes from `lane` on.
inline void to_single(FrictionlessBatchOf<float>& to, const FrictionlessBatch& from, int lane,
                      const SingleUnits& unit) {
    detail::put_contact(to, from, lane, unit);
    detail::put(to.inverse_w, from.inverse_w, lane, 1.0 / unit.inverse_mass);
}
inline void to_single(FrictionBatchOf<float>& to, const FrictionBatch& from, int lane, const SingleUnits& unit) {
    detail::put_contact(to, from, lane, unit);
    detail::put(to.inverse_w, from.inverse_w, lane, 1.0 / unit.inverse_mass);
    detail::put(to.friction, from.friction, lane, 1.0);
}
inline void to_single(RigidFrictionlessBatchOf<float>& to, const RigidFrictionlessBatch& from, int lane,
                      const SingleUnits& unit) {
    detail::put_contact(to, from, lane, unit);
    detail::put(to.ra_n, from.ra_n, lane, unit.length);
    detail::put(to.rb_n, from.rb_n, lane, unit.length);
    detail::put(to.inverse_w, from.inverse_w, lane, 1.0 / unit.inverse_mass);
}
inline void to_single(RigidFrictionalBatchOf<float>& to, const RigidFrictionalBatch& from, int lane,
                      const SingleUnits& unit) {
    detail::put_contact(to, from, lane, unit);
    detail::put(to.t, from.t, lane, 1.0);
    detail::put(to.ra, from.ra, lane, unit.length);
    detail::put(to.rb, from.rb, lane, unit.length);
    detail::put(to.friction, from.friction, lane, 1.0);
    detail::put(to.wn, from.wn, lane, unit.inverse_mass);
    detail::put(to.inverse_wn, from.inverse_wn, lane, 1.0 / unit.inverse_mass);
    detail::put(to.coupling, from.coupling, lane, 1.0);
    detail::put(to.inverse_at, from.inverse_at, lane, 1.0 / unit.inverse_mass);
    detail::put(to.at_ratio, from.at_ratio, lane, 1.0);
}

}  // namespace scree::solvers
