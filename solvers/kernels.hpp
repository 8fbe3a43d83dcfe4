// The kernels: one batch of eight contacts each.
//
// Local problem of a sphere contact, solved exactly (W_N, W_T: the diagonal Delassus block [1/kg]; c the bias):
//   p_N = max(0, p_N - (u_N + c) / W_N)
//   p_T = projection of p_T - u_T / W_T on the disc of radius mu p_N
// This is Signorini and Coulomb's law in the form of De Saxcé and Feng (1998), not its convex relaxation: with a
// diagonal block the normal impulse does not depend on the tangential one, so that the two lines are the solution. For
// solid spheres R^2/I = 5/(2m), hence W_T = 7/2 W_N.
#pragma once

#include <type_traits>

#include "core/simd_rows.hpp"
#include "solvers/batch.hpp"
#include "solvers/packs.hpp"

namespace scree::solvers {

inline constexpr double kTangentRatio = 2.0 / 7.0;  // W_N / W_T of solid spheres
inline constexpr double kTraceRatio = 3.0 / 8.0;    // rho = 3 / tr W over 1 / W_N: tr W = (1 + 2 * 7/2) W_N

// Velocities of the two bodies of each lane.
template <class Real>
struct SpinningPair {
    Pack3Of<Real> va, vb, wa, wb;
    PackOf<Real> ma, mb, ka, kb;

    SCREE_INLINE SpinningPair(const FrictionBatchOf<Real>& batch, const SpinningLineOf<Real>* line) {
        PackOf<Real> c[8];
        gather8([&](int i) { return line[batch.a[i]].v; }, c);
        va = {c[0], c[1], c[2]}, ma = c[3], wa = {c[4], c[5], c[6]}, ka = c[7];
        gather8([&](int i) { return line[batch.b[i]].v; }, c);
        vb = {c[0], c[1], c[2]}, mb = c[3], wb = {c[4], c[5], c[6]}, kb = c[7];
    }
    SCREE_INLINE Pack3Of<Real> relative(const Pack3Of<Real>& n) const { return (va - vb) - cross(wa + wb, n); }
    // Adds the impulse `d` on a, -d on b, and stores.
    SCREE_INLINE void push(const FrictionBatchOf<Real>& batch, SpinningLineOf<Real>* line, const Pack3Of<Real>& n,
                           const Pack3Of<Real>& d) {
        const Pack3Of<Real> t = cross(n, d);
        va = va + ma * d;
        vb = vb - mb * d;
        wa = wa - ka * t;
        wb = wb - kb * t;
        const PackOf<Real> a[8] = {va.x, va.y, va.z, ma, wa.x, wa.y, wa.z, ka};
        scatter8([&](int i) { return line[batch.a[i]].v; }, a);
        const PackOf<Real> b[8] = {vb.x, vb.y, vb.z, mb, wb.x, wb.y, wb.z, kb};
        scatter8([&](int i) { return line[batch.b[i]].v; }, b);
    }
};

template <class Real>
struct SlidingPair {
    Pack3Of<Real> va, vb;
    PackOf<Real> ma, mb;

    SCREE_INLINE SlidingPair(const FrictionlessBatchOf<Real>& batch, const SlidingLineOf<Real>* line) {
        gather4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, ma);
        gather4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, mb);
    }
    SCREE_INLINE PackOf<Real> normal_velocity(const Pack3Of<Real>& n) const { return dot(va - vb, n); }
    SCREE_INLINE void push(const FrictionlessBatchOf<Real>& batch, SlidingLineOf<Real>* line, const Pack3Of<Real>& n,
                           const PackOf<Real>& d) {
        va = va + (ma * d) * n;
        vb = vb - (mb * d) * n;
        scatter4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, ma);
        scatter4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, mb);
    }
};

// One update of a batch. With `kMomentum` the impulses start from y + beta (y - y_previous), where the lines already
// are. Returns sum of |W_N r|^2, r the change of impulse [m2/s2], one number a lane.
template <bool kMomentum, class Real>
SCREE_INLINE PackOf<Real> update(FrictionBatchOf<Real>& batch, SpinningLineOf<Real>* line,
                                 std::type_identity_t<Real> (*previous)[PackOf<Real>::kLanes],
                                 const PackOf<Real>& beta) {
    SpinningPair<Real> pair(batch, line);
    const auto n = load3(batch.n);
    const auto inverse_w = PackOf<Real>::load(batch.inverse_w);
    auto p = load3(batch.p);
    if constexpr (kMomentum) {
        const Pack3Of<Real> old{PackOf<Real>::load(previous[0]), PackOf<Real>::load(previous[1]),
                                PackOf<Real>::load(previous[2])};
        p.x.store(previous[0]);
        p.y.store(previous[1]);
        p.z.store(previous[2]);
        p = p + beta * (p - old);
    }
    const auto u = pair.relative(n);
    const auto un = dot(u, n);
    const auto pn_old = dot(p, n);
    const auto pn = max(pn_old - inverse_w * (un + PackOf<Real>::load(batch.bias)), PackOf<Real>::all(0));
    const auto wt = PackOf<Real>::all(static_cast<Real>(kTangentRatio)) * inverse_w;
    const auto x = (p - pn_old * n) - wt * (u - un * n);
    const auto limit = PackOf<Real>::load(batch.friction) * pn;
    const auto size = sqrt(max(dot(x, x), PackOf<Real>::all(kTiny<Real>)));
    const auto scale = min(limit / size, PackOf<Real>::all(1));
    const auto solved = pn * n + scale * x;
    const auto change = solved - p;
    store3(batch.p, solved);
    pair.push(batch, line, n, change);
    const auto w = pair.ma + pair.mb;
    return (w * w) * dot(change, change);
}

template <bool kMomentum, class Real>
SCREE_INLINE PackOf<Real> update(FrictionlessBatchOf<Real>& batch, SlidingLineOf<Real>* line,
                                 std::type_identity_t<Real> (*previous)[PackOf<Real>::kLanes],
                                 const PackOf<Real>& beta) {
    SlidingPair<Real> pair(batch, line);
    const auto n = load3(batch.n);
    auto p = PackOf<Real>::load(batch.p[0]);
    if constexpr (kMomentum) {
        const auto old = PackOf<Real>::load(previous[0]);
        p.store(previous[0]);
        p = p + beta * (p - old);
    }
    const auto un = pair.normal_velocity(n);
    const auto solved =
        max(p - PackOf<Real>::load(batch.inverse_w) * (un + PackOf<Real>::load(batch.bias)), PackOf<Real>::all(0));
    const auto change = solved - p;
    solved.store(batch.p[0]);
    pair.push(batch, line, n, change);
    const auto w = pair.ma + pair.mb;
    return (w * w) * (change * change);
}

// Adds the batch's impulses to the lines (warm start).
inline void apply(const FrictionBatch& batch, SpinningLine* line) {
    SpinningPair<double> pair(batch, line);
    pair.push(batch, line, load3(batch.n), load3(batch.p));
}
inline void apply(const FrictionlessBatch& batch, SlidingLine* line) {
    SlidingPair<double> pair(batch, line);
    pair.push(batch, line, load3(batch.n), Pack::load(batch.p[0]));
}

// |u + c n|^2 of the velocities in the lines, one number a lane: with the free velocities, |q|^2.
inline Pack drive(const FrictionBatch& batch, const SpinningLine* line) {
    const SpinningPair<double> pair(batch, line);
    const Pack3 n = load3(batch.n);
    const Pack3 q = pair.relative(n) + Pack::load(batch.bias) * n;
    return dot(q, q);
}
inline Pack drive(const FrictionlessBatch& batch, const SlidingLine* line) {
    const SlidingPair<double> pair(batch, line);
    const Pack q = pair.normal_velocity(load3(batch.n)) + Pack::load(batch.bias);
    return q * q;
}

// Puts impulses that were found in single precision into their cones: p_N >= 0, and |p_T| = mu p_N where it was so but
// for the round-off of single precision.
inline void into_cone(FrictionBatch& batch) {
    const Pack3 n = load3(batch.n), p = load3(batch.p);
    const Pack one = Pack::all(1.0), raw = dot(p, n), pn = max(raw, Pack::all(0.0));
    const Pack limit = Pack::load(batch.friction) * pn;
    const Pack3 pt = p - raw * n;
    const Pack size = sqrt(max(dot(pt, pt), Pack::all(kTiny<double>)));
    const Pack inside = limit - Pack::all(kSingleRound) * (pn + limit);
    store3(batch.p, pn * n + where_less(size, inside, one, limit / size) * pt);
}
inline void into_cone(FrictionlessBatch& batch) {
    max(Pack::load(batch.p[0]), Pack::all(0.0)).store(batch.p[0]);
}

// The natural map in units of velocity, squared:  |F|^2,  F = (p - P_K(p - rho û)) / rho,
//   û = (u_N + c + mu |u_T|) n + u_T,  rho = 3 / tr W,  P_K the projection on Coulomb's cone (Acary et al. 2018).
template <class Real>
PackOf<Real> natural_map(const FrictionBatchOf<Real>& batch, const SpinningLineOf<Real>* line) {
    const SpinningPair<Real> pair(batch, line);
    const auto n = load3(batch.n), p = load3(batch.p);
    const auto mu = PackOf<Real>::load(batch.friction), zero = PackOf<Real>::all(0), one = PackOf<Real>::all(1);
    const auto rho = PackOf<Real>::all(static_cast<Real>(kTraceRatio)) * PackOf<Real>::load(batch.inverse_w);
    const auto u = pair.relative(n);
    const auto un = dot(u, n), pn = dot(p, n);
    const auto ut = u - un * n, pt = p - pn * n;
    const auto slip = sqrt(dot(ut, ut));
    const auto xn = pn - rho * (un + PackOf<Real>::load(batch.bias) + mu * slip);
    const auto xt = pt - rho * ut;
    const auto size = sqrt(dot(xt, xt));
    // inside the cone: x; inside the polar cone: 0; else on the cone
    const auto on_cone = (xn + mu * size) / (one + mu * mu);
    const auto outside = where_less(mu * xn, size, one, zero);
    const auto pn_new = where_less(mu * size, zero - xn, zero, where_less(outside, one, xn, on_cone));
    const auto scale =
        where_less(outside, one, one, mu * max(pn_new, zero) / max(size, PackOf<Real>::all(kTiny<Real>)));
    const auto ft = pt - where_less(mu * size, zero - xn, zero, scale) * xt;
    const auto fn = pn - max(pn_new, zero);
    const auto square = (fn * fn + dot(ft, ft)) / max(rho * rho, PackOf<Real>::all(kTiny<Real>));
    return square;
}
template <class Real>
PackOf<Real> natural_map(const FrictionlessBatchOf<Real>& batch, const SlidingLineOf<Real>* line) {
    const SlidingPair<Real> pair(batch, line);
    const auto un = pair.normal_velocity(load3(batch.n)) + PackOf<Real>::load(batch.bias);
    const auto p = PackOf<Real>::load(batch.p[0]), rho = PackOf<Real>::load(batch.inverse_w);
    const auto f = (p - max(p - rho * un, PackOf<Real>::all(0))) / max(rho, PackOf<Real>::all(kTiny<Real>));
    return f * f;
}

// Work of the impulses on the mean of the velocities before and after [J].
inline WorkPacks work(const FrictionBatch& batch, const SpinningLine* mean) {
    const SpinningPair<double> pair(batch, mean);
    const Pack3 n = load3(batch.n), p = load3(batch.p);
    const Pack3 u = pair.relative(n);
    const Pack normal = dot(p, n) * dot(u, n);
    return {normal, dot(p, u) - normal};
}
inline WorkPacks work(const FrictionlessBatch& batch, const SlidingLine* mean) {
    const SlidingPair<double> pair(batch, mean);
    return {Pack::load(batch.p[0]) * pair.normal_velocity(load3(batch.n)), Pack::all(0.0)};
}

}  // namespace scree::solvers
