// One contact of two bodies of any shape in long double: the law from its definition, with a bisection for the slip.
// Written from the equations, to compare the kernels with.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"

namespace scree::testing {

struct SlowRigidContact {
    using Real = long double;
    using V3 = Eigen::Matrix<Real, 3, 1>;
    using M3 = Eigen::Matrix<Real, 3, 3>;
    using V2 = Eigen::Matrix<Real, 2, 1>;
    using M2 = Eigen::Matrix<Real, 2, 2>;

    struct Body {
        V3 v = V3::Zero(), w = V3::Zero(), r = V3::Zero();
        Real inverse_mass = 0;
        M3 inverse_inertia = M3::Zero();
    };
    Body a, b;
    V3 n = V3::Zero(), p = V3::Zero();
    Real mu = 0, bias = 0;

    static M3 skew(const V3& r) {
        M3 m;
        m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
        return m;
    }
    static M3 block(const Body& k) {
        const M3 x = skew(k.r);
        return k.inverse_mass * M3::Identity() + x.transpose() * k.inverse_inertia * x;
    }
    M3 delassus() const { return block(a) + block(b); }
    // What is added up in an entry of W, before anything cancels: round-off is relative to this.
    Real size_of_delassus() const {
        return a.inverse_mass + a.inverse_inertia.norm() * a.r.squaredNorm() + b.inverse_mass +
               b.inverse_inertia.norm() * b.r.squaredNorm();
    }
    V3 velocity() const { return (a.v + a.w.cross(a.r)) - (b.v + b.w.cross(b.r)); }
    // The same of a velocity.
    Real size_of_velocity() const {
        return a.v.norm() + a.w.norm() * a.r.norm() + b.v.norm() + b.w.norm() * b.r.norm() + std::abs(bias);
    }
    void push(const V3& d) {
        a.v += a.inverse_mass * d;
        b.v -= b.inverse_mass * d;
        a.w += a.inverse_inertia * a.r.cross(d);
        b.w -= b.inverse_inertia * b.r.cross(d);
    }
    // Columns n, t, s with any two tangents.
    M3 frame() const {
        M3 f;
        f.col(0) = n.normalized();
        V3 t = V3::UnitX();
        for (const V3& e : {V3(V3::UnitY()), V3(V3::UnitZ())})
            if (std::abs(e.dot(n)) < std::abs(t.dot(n))) t = e;
        f.col(1) = f.col(0).cross(t).normalized();
        f.col(2) = f.col(0).cross(f.col(1));
        return f;
    }

    // u = q + W p in a frame of n and two tangents, and the slip as a function of lambda.
    struct Reduced {
        M3 to_world, w;
        M2 schur;
        V2 q, k;     // the slip without p_T, and W_TN / W_NN
        Real s, mu;  // p_N = s - k.p_T
        V2 tangent(Real lambda) const { return -(schur + lambda * M2::Identity()).inverse() * q; }
        Real normal(const V2& pt) const { return s - k.dot(pt); }
        Real excess(Real lambda) const {  // > 0: more slip resistance than there is
            const V2 pt = tangent(lambda);
            return pt.norm() - mu * normal(pt);
        }
        V3 world(const V2& pt, Real pn) const { return to_world * V3(pn, pt.x(), pt.y()); }
    };
    Reduced reduced() const {
        Reduced r;
        r.to_world = frame();
        r.w = r.to_world.transpose() * delassus() * r.to_world;
        V3 q = r.to_world.transpose() * (velocity() - delassus() * p);
        q.x() += bias;
        r.k = r.w.block<2, 1>(1, 0) / r.w(0, 0);
        r.schur = r.w.block<2, 2>(1, 1) - r.w(0, 0) * r.k * r.k.transpose();
        r.q = q.tail<2>() - r.k * q.x();
        r.s = -q.x() / r.w(0, 0);
        r.mu = mu;
        return r;
    }
    struct Solution {
        V3 p = V3::Zero();
        Real lambda = 0;  // of the slip
        int roots = 0;    // slips that are solutions, as far as a scan finds them
    };
    // Opening before sticking before slipping; of several slips the one of largest lambda.
    Solution solve() const {
        const Reduced r = reduced();
        Solution solution;
        if (r.s <= 0) return solution;
        if (r.excess(0) <= 0 || (mu == 0 && r.q.isZero(0))) {
            solution.p = r.world(r.tangent(0), r.normal(r.tangent(0)));
            return solution;
        }
        if (mu == 0) {
            solution.roots = 1;
            solution.p = r.world(V2::Zero(), r.s);
            return solution;
        }
        // lambda = unit (x^-1 - 1) for x from 1 to 0, x geometric; beyond the last there is no root
        const Real unit = r.schur.trace();
        Real last = 0, value = r.excess(0), low = 0, high = 0;
        for (int i = 1; i <= 600; ++i) {
            const Real lambda = unit * std::pow(Real(10), Real(-14) + Real(i) / 20);
            const Real now = r.excess(lambda);
            if ((now > 0) != (value > 0)) {
                ++solution.roots;
                low = last, high = lambda;
            }
            last = lambda, value = now;
        }
        const bool rises = r.excess(high) > 0;
        for (int i = 0; i < 200; ++i) {
            const Real middle = (low + high) / 2;
            ((r.excess(middle) > 0) == rises ? high : low) = middle;
        }
        solution.lambda = (low + high) / 2;
        const V2 pt = r.tangent(solution.lambda);
        solution.p = r.world(pt, r.normal(pt));
        return solution;
    }
    // |F| [m/s], F = (p - P_K(p - rho û)) / rho, rho = 3 / tr W.
    Real natural_map(bool frictional = true) const {
        const V3 u = velocity();
        const Real un = u.dot(n), rho = frictional ? 3 / delassus().trace() : 1 / n.dot(delassus() * n);
        if (!frictional) return std::abs(p.dot(n) - std::max<Real>(0, p.dot(n) - rho * (un + bias))) / rho;
        const V3 ut = u - un * n, x = p - rho * ((un + bias + mu * ut.norm()) * n + ut);
        const Real xn = x.dot(n);
        const V3 xt = x - xn * n;
        V3 projected = x;
        if (mu * xt.norm() <= -xn) {
            projected = V3::Zero();
        } else if (xt.norm() > mu * xn) {
            const Real to = (xn + mu * xt.norm()) / (1 + mu * mu);
            projected = to * n + mu * to * xt.normalized();
        }
        return (p - projected).norm() / rho;
    }
};

}  // namespace scree::testing
