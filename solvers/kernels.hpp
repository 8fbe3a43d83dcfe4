// The kernels: one batch of eight contacts each.
//
// Local problem of a sphere contact, solved exactly (W_N, W_T: the diagonal Delassus block [1/kg]; c the bias):
//   p_N = max(0, p_N - (u_N + c) / W_N)
//   p_T = projection of p_T - u_T / W_T on the disc of radius mu p_N
// This is Signorini and Coulomb's law in the form of De Saxcé and Feng (1998), not its convex relaxation: with a
// diagonal block the normal impulse does not depend on the tangential one, so that the two lines are the solution. For
// solid spheres R^2/I = 5/(2m), hence W_T = 7/2 W_N.
#pragma once

#include "core/simd.hpp"
#include "solvers/batch.hpp"

namespace scree::solvers {

inline constexpr double kTangentRatio = 2.0 / 7.0;  // W_N / W_T of solid spheres
inline constexpr double kTraceRatio = 3.0 / 8.0;    // rho = 3 / tr W over 1 / W_N: tr W = (1 + 2 * 7/2) W_N
inline constexpr double kTiny = 1e-300;             // keeps 0/0 away; no quantity of a scene is that small

inline Pack3 load3(const double (&x)[3][kLanes]) {
    return {Pack::load(x[0]), Pack::load(x[1]), Pack::load(x[2])};
}
inline void store3(double (&x)[3][kLanes], const Pack3& a) {
    a.x.store(x[0]);
    a.y.store(x[1]);
    a.z.store(x[2]);
}

// Velocities of the two bodies of each lane.
struct SpinningPair {
    Pack3 va, vb, wa, wb;
    Pack ma, mb, ka, kb;

    SCREE_INLINE SpinningPair(const FrictionBatch& batch, const SpinningLine* line) {
        gather4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, ma);
        gather4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, mb);
        gather4([&](int i) { return line[batch.a[i]].w; }, wa.x, wa.y, wa.z, ka);
        gather4([&](int i) { return line[batch.b[i]].w; }, wb.x, wb.y, wb.z, kb);
    }
    SCREE_INLINE Pack3 relative(const Pack3& n) const { return (va - vb) - cross(wa + wb, n); }
    // Adds the impulse `d` on a, -d on b, and stores.
    SCREE_INLINE void push(const FrictionBatch& batch, SpinningLine* line, const Pack3& n, const Pack3& d) {
        const Pack3 t = cross(n, d);
        va = va + ma * d;
        vb = vb - mb * d;
        wa = wa - ka * t;
        wb = wb - kb * t;
        scatter4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, ma);
        scatter4([&](int i) { return line[batch.a[i]].w; }, wa.x, wa.y, wa.z, ka);
        scatter4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, mb);
        scatter4([&](int i) { return line[batch.b[i]].w; }, wb.x, wb.y, wb.z, kb);
    }
};

struct SlidingPair {
    Pack3 va, vb;
    Pack ma, mb;

    template <class Batch>
    SCREE_INLINE SlidingPair(const Batch& batch, const SlidingLine* line) {
        gather4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, ma);
        gather4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, mb);
    }
    SCREE_INLINE Pack normal_velocity(const Pack3& n) const { return dot(va - vb, n); }
    template <class Batch>
    SCREE_INLINE void push(const Batch& batch, SlidingLine* line, const Pack3& n, const Pack& d) {
        va = va + (ma * d) * n;
        vb = vb - (mb * d) * n;
        scatter4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, ma);
        scatter4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, mb);
    }
};

// One update of a batch. With `kMomentum` the impulses start from y + beta (y - y_previous), where the lines already
// are. Returns sum of |W_N r|^2, r the change of impulse [m2/s2], one number a lane.
template <bool kMomentum>
SCREE_INLINE Pack update(FrictionBatch& batch, SpinningLine* line, double (*previous)[kLanes], const Pack& beta) {
    SpinningPair pair(batch, line);
    const Pack3 n = load3(batch.n);
    const Pack inverse_w = Pack::load(batch.inverse_w);
    Pack3 p = load3(batch.p);
    if constexpr (kMomentum) {
        const Pack3 old{Pack::load(previous[0]), Pack::load(previous[1]), Pack::load(previous[2])};
        p.x.store(previous[0]);
        p.y.store(previous[1]);
        p.z.store(previous[2]);
        p = p + beta * (p - old);
    }
    const Pack3 u = pair.relative(n);
    const Pack un = dot(u, n);
    const Pack pn_old = dot(p, n);
    const Pack pn = max(pn_old - inverse_w * (un + Pack::load(batch.bias)), Pack::all(0.0));
    const Pack wt = Pack::all(kTangentRatio) * inverse_w;
    const Pack3 x = (p - pn_old * n) - wt * (u - un * n);
    const Pack limit = Pack::load(batch.friction) * pn;
    const Pack size = sqrt(max(dot(x, x), Pack::all(kTiny)));
    const Pack scale = min(limit / size, Pack::all(1.0));
    const Pack3 solved = pn * n + scale * x;
    const Pack3 change = solved - p;
    store3(batch.p, solved);
    pair.push(batch, line, n, change);
    const Pack w = pair.ma + pair.mb;
    return (w * w) * dot(change, change);
}

template <bool kMomentum>
SCREE_INLINE Pack update(FrictionlessBatch& batch, SlidingLine* line, double (*previous)[kLanes], const Pack& beta) {
    SlidingPair pair(batch, line);
    const Pack3 n = load3(batch.n);
    Pack p = Pack::load(batch.p[0]);
    if constexpr (kMomentum) {
        const Pack old = Pack::load(previous[0]);
        p.store(previous[0]);
        p = p + beta * (p - old);
    }
    const Pack un = pair.normal_velocity(n);
    const Pack solved = max(p - Pack::load(batch.inverse_w) * (un + Pack::load(batch.bias)), Pack::all(0.0));
    const Pack change = solved - p;
    solved.store(batch.p[0]);
    pair.push(batch, line, n, change);
    const Pack w = pair.ma + pair.mb;
    return (w * w) * (change * change);
}

// Adds the batch's impulses to the lines (warm start).
inline void apply(const FrictionBatch& batch, SpinningLine* line) {
    SpinningPair pair(batch, line);
    pair.push(batch, line, load3(batch.n), load3(batch.p));
}
inline void apply(const FrictionlessBatch& batch, SlidingLine* line) {
    SlidingPair pair(batch, line);
    pair.push(batch, line, load3(batch.n), Pack::load(batch.p[0]));
}

// |u + c n|^2 of the velocities in the lines, one number a lane: with the free velocities, |q|^2.
inline Pack drive(const FrictionBatch& batch, const SpinningLine* line) {
    const SpinningPair pair(batch, line);
    const Pack3 n = load3(batch.n);
    const Pack3 q = pair.relative(n) + Pack::load(batch.bias) * n;
    return dot(q, q);
}
inline Pack drive(const FrictionlessBatch& batch, const SlidingLine* line) {
    const SlidingPair pair(batch, line);
    const Pack q = pair.normal_velocity(load3(batch.n)) + Pack::load(batch.bias);
    return q * q;
}

// The natural map in units of velocity, squared:  |F|^2,  F = (p - P_K(p - rho û)) / rho,
//   û = (u_N + c + mu |u_T|) n + u_T,  rho = 3 / tr W,  P_K the projection on Coulomb's cone (Acary et al. 2018).
inline Pack natural_map(const FrictionBatch& batch, const SpinningLine* line) {
    const SpinningPair pair(batch, line);
    const Pack3 n = load3(batch.n), p = load3(batch.p);
    const Pack mu = Pack::load(batch.friction), zero = Pack::all(0.0), one = Pack::all(1.0);
    const Pack rho = Pack::all(kTraceRatio) * Pack::load(batch.inverse_w);
    const Pack3 u = pair.relative(n);
    const Pack un = dot(u, n), pn = dot(p, n);
    const Pack3 ut = u - un * n, pt = p - pn * n;
    const Pack slip = sqrt(dot(ut, ut));
    const Pack xn = pn - rho * (un + Pack::load(batch.bias) + mu * slip);
    const Pack3 xt = pt - rho * ut;
    const Pack size = sqrt(dot(xt, xt));
    // inside the cone: x; inside the polar cone: 0; else on the cone
    const Pack on_cone = (xn + mu * size) / (one + mu * mu);
    const Pack outside = where_less(mu * xn, size, one, zero);
    const Pack pn_new = where_less(mu * size, zero - xn, zero, where_less(outside, one, xn, on_cone));
    const Pack scale = where_less(outside, one, one, mu * max(pn_new, zero) / max(size, Pack::all(kTiny)));
    const Pack3 ft = pt - where_less(mu * size, zero - xn, zero, scale) * xt;
    const Pack fn = pn - max(pn_new, zero);
    const Pack square = (fn * fn + dot(ft, ft)) / max(rho * rho, Pack::all(kTiny));
    return square;
}
inline Pack natural_map(const FrictionlessBatch& batch, const SlidingLine* line) {
    const SlidingPair pair(batch, line);
    const Pack un = pair.normal_velocity(load3(batch.n)) + Pack::load(batch.bias);
    const Pack p = Pack::load(batch.p[0]), rho = Pack::load(batch.inverse_w);
    const Pack f = (p - max(p - rho * un, Pack::all(0.0))) / max(rho, Pack::all(kTiny));
    return f * f;
}

// Work of the impulses on the mean of the velocities before and after [J], normal and tangential.
struct WorkPacks {
    Pack normal, tangential;
};
inline WorkPacks work(const FrictionBatch& batch, const SpinningLine* mean) {
    const SpinningPair pair(batch, mean);
    const Pack3 n = load3(batch.n), p = load3(batch.p);
    const Pack3 u = pair.relative(n);
    const Pack normal = dot(p, n) * dot(u, n);
    return {normal, dot(p, u) - normal};
}
inline WorkPacks work(const FrictionlessBatch& batch, const SlidingLine* mean) {
    const SlidingPair pair(batch, mean);
    return {Pack::load(batch.p[0]) * pair.normal_velocity(load3(batch.n)), Pack::all(0.0)};
}

}  // namespace scree::solvers
