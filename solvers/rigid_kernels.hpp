// The kernels of contacts of bodies of any shape: one batch of eight each, the same set as kernels.hpp has for spheres,
// with the same units and the same meaning of what they return. The local problem is solved exactly
// (local_problem.hpp).
#pragma once

#include <type_traits>

#include "solvers/local_problem.hpp"
#include "solvers/packs.hpp"
#include "solvers/rigid_batch.hpp"

namespace scree::solvers {

// The velocities of one of the two bodies of each lane; `side` holds its lines.
template <class Real>
struct RigidSide {
    using Numbers = PackOf<Real>;
    Pack3Of<Real> v, w;
    Numbers m, spare;

    SCREE_INLINE RigidSide(const std::uint32_t* side, const RigidLineOf<Real>* line) {
        Numbers c[8];
        gather8([&](int i) { return line[side[i]].v; }, c);
        v = {c[0], c[1], c[2]}, m = c[3], w = {c[4], c[5], c[6]}, spare = c[7];
    }
    SCREE_INLINE void store(const std::uint32_t* side, RigidLineOf<Real>* line) const {
        const Numbers c[8] = {v.x, v.y, v.z, m, w.x, w.y, w.z, spare};
        scatter8([&](int i) { return line[side[i]].v; }, c);
    }
};
// J times a vector. The inertia is read where it is needed, not held in registers while a contact is solved.
template <class Real>
struct RigidInertia {
    PackOf<Real> c[8];  // xx, yy, zz, xy, xz, yz

    SCREE_INLINE RigidInertia(const std::uint32_t* side, const RigidLineOf<Real>* line) {
        gather8([&](int i) { return line[side[i]].j; }, c);
    }
    SCREE_INLINE Pack3Of<Real> operator*(const Pack3Of<Real>& r) const {
        return {(c[0] * r.x + c[3] * r.y) + c[4] * r.z, (c[3] * r.x + c[1] * r.y) + c[5] * r.z,
                (c[4] * r.x + c[5] * r.y) + c[2] * r.z};
    }
};

// Two bodies a lane, velocities and impulses in the contact's frame: x along n, y along t, z along s.
template <class Real>
struct RigidPair {
    using Numbers = PackOf<Real>;
    using Vector = Pack3Of<Real>;
    RigidSide<Real> a, b;
    Vector n, t, s;

    SCREE_INLINE RigidPair(const RigidFrictionalBatchOf<Real>& batch, const RigidLineOf<Real>* line)
        : a(batch.a, line), b(batch.b, line), n(load3(batch.n)), t(load3(batch.t)), s(cross(n, t)) {}
    SCREE_INLINE Vector relative(const RigidFrictionalBatchOf<Real>& batch) const {
        const Vector u = (a.v + cross(a.w, load3(batch.ra))) - (b.v + cross(b.w, load3(batch.rb)));
        return {dot(u, n), dot(u, t), dot(u, s)};
    }
    // Adds the impulse `d` on a, -d on b, and stores.
    SCREE_INLINE void push(const RigidFrictionalBatchOf<Real>& batch, RigidLineOf<Real>* line, const Vector& d) {
        const Vector world = (d.x * n + d.y * t) + d.z * s;
        a.v = a.v + a.m * world;
        b.v = b.v - b.m * world;
        a.w = a.w + RigidInertia<Real>(batch.a, line) * cross(load3(batch.ra), world);
        b.w = b.w - RigidInertia<Real>(batch.b, line) * cross(load3(batch.rb), world);
        a.store(batch.a, line);
        b.store(batch.b, line);
    }
};

template <class Real>
struct RigidNormalPair {
    using Numbers = PackOf<Real>;
    RigidSide<Real> a, b;
    Pack3Of<Real> n, ra_n, rb_n;

    SCREE_INLINE RigidNormalPair(const RigidFrictionlessBatchOf<Real>& batch, const RigidLineOf<Real>* line)
        : a(batch.a, line), b(batch.b, line), n(load3(batch.n)), ra_n(load3(batch.ra_n)), rb_n(load3(batch.rb_n)) {}
    SCREE_INLINE Numbers normal_velocity() const { return dot(a.v - b.v, n) + (dot(a.w, ra_n) - dot(b.w, rb_n)); }
    // Adds the impulse d n on a, and stores; returns W_NN.
    SCREE_INLINE Numbers push(const RigidFrictionlessBatchOf<Real>& batch, RigidLineOf<Real>* line, const Numbers& d) {
        const auto turn_a = RigidInertia<Real>(batch.a, line) * ra_n, turn_b = RigidInertia<Real>(batch.b, line) * rb_n;
        a.v = a.v + (a.m * d) * n;
        b.v = b.v - (b.m * d) * n;
        a.w = a.w + d * turn_a;
        b.w = b.w - d * turn_b;
        a.store(batch.a, line);
        b.store(batch.b, line);
        return (a.m + b.m) + (dot(ra_n, turn_a) + dot(rb_n, turn_b));
    }
};

// One update of a batch. With `kMomentum` the impulses start from y + beta (y - y_previous), where the lines already
// are. Returns sum of |W_NN r|^2, r the change of impulse [m2/s2], one number a lane.
template <bool kMomentum, class Real>
SCREE_INLINE PackOf<Real> update(RigidFrictionalBatchOf<Real>& batch, RigidLineOf<Real>* line,
                                 std::type_identity_t<Real> (*previous)[PackOf<Real>::kLanes],
                                 const PackOf<Real>& beta) {
    using Numbers = PackOf<Real>;
    RigidPair<Real> pair(batch, line);
    auto p = load3(batch.p);
    if constexpr (kMomentum) {
        const Pack3Of<Real> old{Numbers::load(previous[0]), Numbers::load(previous[1]), Numbers::load(previous[2])};
        p.x.store(previous[0]);
        p.y.store(previous[1]);
        p.z.store(previous[2]);
        p = p + beta * (p - old);
    }
    const auto u = pair.relative(batch);
    const auto un = u.x + Numbers::load(batch.bias);
    const auto k1 = Numbers::load(batch.coupling[0]), k2 = Numbers::load(batch.coupling[1]);
    const auto rho = Numbers::load(batch.at_ratio), inverse_a1 = Numbers::load(batch.inverse_at);
    // u_T where u_N + c is made zero by p_N alone; S takes it to zero from there
    const auto slip1 = u.y - k1 * un, slip2 = u.z - k2 * un;
    const auto solved = solve(LocalProblem<Real>{(p.x + (k1 * p.y + k2 * p.z)) - Numbers::load(batch.inverse_wn) * un,
                                                 p.y - inverse_a1 * slip1, p.z - (rho * inverse_a1) * slip2,
                                                 Numbers::load(batch.friction), k1, k2, rho});
    const auto change = solved - p;
    store3(batch.p, solved);
    pair.push(batch, line, change);
    const auto wn = Numbers::load(batch.wn);
    return (wn * wn) * dot(change, change);
}

template <bool kMomentum, class Real>
SCREE_INLINE PackOf<Real> update(RigidFrictionlessBatchOf<Real>& batch, RigidLineOf<Real>* line,
                                 std::type_identity_t<Real> (*previous)[PackOf<Real>::kLanes],
                                 const PackOf<Real>& beta) {
    using Numbers = PackOf<Real>;
    RigidNormalPair<Real> pair(batch, line);
    auto p = Numbers::load(batch.p[0]);
    if constexpr (kMomentum) {
        const auto old = Numbers::load(previous[0]);
        p.store(previous[0]);
        p = p + beta * (p - old);
    }
    const auto un = pair.normal_velocity() + Numbers::load(batch.bias);
    const auto solved = max(p - Numbers::load(batch.inverse_w) * un, Numbers::all(0));
    const auto change = solved - p;
    solved.store(batch.p[0]);
    const auto w = pair.push(batch, line, change);
    return (w * w) * (change * change);
}

// Adds the batch's impulses to the lines (warm start).
inline void apply(const RigidFrictionalBatch& batch, RigidLine* line) {
    RigidPair<double> pair(batch, line);
    pair.push(batch, line, load3(batch.p));
}
inline void apply(const RigidFrictionlessBatch& batch, RigidLine* line) {
    RigidNormalPair<double> pair(batch, line);
    pair.push(batch, line, Pack::load(batch.p[0]));
}

// |u + c n|^2 of the velocities in the lines, one number a lane: with the free velocities, |q|^2.
inline Pack drive(const RigidFrictionalBatch& batch, const RigidLine* line) {
    Pack3 q = RigidPair<double>(batch, line).relative(batch);
    q.x = q.x + Pack::load(batch.bias);
    return dot(q, q);
}
inline Pack drive(const RigidFrictionlessBatch& batch, const RigidLine* line) {
    const Pack q = RigidNormalPair<double>(batch, line).normal_velocity() + Pack::load(batch.bias);
    return q * q;
}

// Puts impulses that were found in single precision into their cones: p_N >= 0, and |p_T| = mu p_N where it was so but
// for the round-off of single precision.
inline void into_cone(RigidFrictionalBatch& batch) {
    const Pack3 p = load3(batch.p);
    const Pack one = Pack::all(1.0), pn = max(p.x, Pack::all(0.0)), limit = Pack::load(batch.friction) * pn;
    const Pack size = sqrt(max(p.y * p.y + p.z * p.z, Pack::all(kTiny<double>)));
    const Pack inside = limit - Pack::all(kSingleRound) * (pn + limit);
    const Pack scale = where_less(size, inside, one, limit / size);
    store3(batch.p, Pack3{pn, scale * p.y, scale * p.z});
}
inline void into_cone(RigidFrictionlessBatch& batch) {
    max(Pack::load(batch.p[0]), Pack::all(0.0)).store(batch.p[0]);
}

// 1 / rho = tr W / 3 [1/kg]. The trace of W_TT is that of S and of what was taken off it.
template <class Real>
SCREE_INLINE PackOf<Real> third_of_trace(const RigidFrictionalBatchOf<Real>& batch) {
    using Numbers = PackOf<Real>;
    const auto one = Numbers::all(1), k1 = Numbers::load(batch.coupling[0]), k2 = Numbers::load(batch.coupling[1]);
    const auto ratio = Numbers::load(batch.at_ratio);
    const auto inverse_a2 = max(ratio * Numbers::load(batch.inverse_at), Numbers::all(kTiny<Real>));
    const auto trace = Numbers::load(batch.wn) * (one + (k1 * k1 + k2 * k2)) + (one + ratio) / inverse_a2;
    return Numbers::all(static_cast<Real>(1.0 / 3.0)) * trace;
}

// The natural map in units of velocity, squared:  |F|^2,  F = (p - P_K(p - rho û)) / rho,
//   û = (u_N + c + mu |u_T|) n + u_T,  rho = 3 / tr W,  P_K the projection on Coulomb's cone (Acary et al. 2018).
template <class Real>
PackOf<Real> natural_map(const RigidFrictionalBatchOf<Real>& batch, const RigidLineOf<Real>* line) {
    using Numbers = PackOf<Real>;
    const auto u = RigidPair<Real>(batch, line).relative(batch), p = load3(batch.p);
    const auto mu = Numbers::load(batch.friction), zero = Numbers::all(0), one = Numbers::all(1);
    const auto rho = one / third_of_trace(batch);
    const auto slip = sqrt(u.y * u.y + u.z * u.z);
    const auto xn = p.x - rho * (u.x + Numbers::load(batch.bias) + mu * slip);
    const auto x1 = p.y - rho * u.y, x2 = p.z - rho * u.z;
    const auto size = sqrt(x1 * x1 + x2 * x2);
    // inside the cone: x; inside the polar cone: 0; else on the cone
    const auto on_cone = (xn + mu * size) / (one + mu * mu);
    const auto outside = where_less(mu * xn, size, one, zero);
    const auto open = where_less(mu * size, zero - xn, one, zero);
    const auto pn = max(where_less(zero, open, zero, where_less(outside, one, xn, on_cone)), zero);
    const auto scale =
        where_less(zero, open, zero, where_less(outside, one, one, mu * pn / max(size, Numbers::all(kTiny<Real>))));
    const auto fn = p.x - pn, f1 = p.y - scale * x1, f2 = p.z - scale * x2;
    return ((fn * fn + f1 * f1) + f2 * f2) / max(rho * rho, Numbers::all(kTiny<Real>));
}
template <class Real>
PackOf<Real> natural_map(const RigidFrictionlessBatchOf<Real>& batch, const RigidLineOf<Real>* line) {
    using Numbers = PackOf<Real>;
    const auto un = RigidNormalPair<Real>(batch, line).normal_velocity() + Numbers::load(batch.bias);
    const auto p = Numbers::load(batch.p[0]), rho = Numbers::load(batch.inverse_w);
    const auto f = (p - max(p - rho * un, Numbers::all(0))) / max(rho, Numbers::all(kTiny<Real>));
    return f * f;
}

// Work of the impulses on the mean of the velocities before and after [J].
inline WorkPacks work(const RigidFrictionalBatch& batch, const RigidLine* mean) {
    const Pack3 u = RigidPair<double>(batch, mean).relative(batch), p = load3(batch.p);
    return {p.x * u.x, p.y * u.y + p.z * u.z};
}
inline WorkPacks work(const RigidFrictionlessBatch& batch, const RigidLine* mean) {
    return {Pack::load(batch.p[0]) * RigidNormalPair<double>(batch, mean).normal_velocity(), Pack::all(0.0)};
}

}  // namespace scree::solvers
