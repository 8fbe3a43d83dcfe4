// Signorini and Coulomb's law at one contact with a full Delassus block, the others held: eight contacts at a time.
//   K_mu  ∋  p  ⟂  (u_N + c + mu |u_T|) n + u_T  ∈  K_mu*,    u = q + W p         (De Saxcé and Feng 1998)
// solved as it stands, not in its convex (associated) form.
//
// q_N + c >= 0: the contact opens and p = 0. Otherwise u_N + c = 0, which gives p_N from p_T:
//   p_N = s - k.p_T,     s = -(q_N + c) / W_NN > 0,   k = W_NT / W_NN,
// and leaves  u_T = S (p_T - x),  S the Schur complement of rigid_batch.hpp with eigenvalues a1 <= a2, x the impulse
// that stops the slip. It sticks with p_T = x if that is in the cone. Otherwise u_T = -lambda p_T with lambda > 0:
//   p_T = (S + lambda)^-1 S x = e (x_1, x_2 / R),      e = a1 / (a1 + lambda) in (0, 1),   R = ratio + (1 - ratio) e,
// ratio = a1 / a2, and |p_T| = mu p_N becomes one equation in e:
//   N(e) = |p_T| + mu k.p_T = mu s.
// Written out it is the quartic of Bonnefon and Daviet (2011, INRIA RT-0400); this form needs no powers of a1 and a2.
// N(0) = 0 < mu s < N(1), so there is always a root between. 1/N as a function of 1/e is a straight line for ratio = 1
// and concave for k = 0, where Newton's iteration on it rises to the root from e = 1 without ever passing it (as for
// the secular equation of trust regions, Moré and Sorensen 1983). For any k a bracket holds it: bisection of log(e)
// where Newton's step leaves the bracket, or leads nowhere (kNewton).
//
// With mu |k| > 1 (Painlevé's case) N need not be monotone and there can be several solutions: of those that slip, it
// gives one, always the same for the same numbers; sticking comes before slipping, and opening before both.
#pragma once

#include <type_traits>

#include "solvers/packs.hpp"

namespace scree::solvers {

// Newton's iteration doubles the digits: a step this small, relative, is the last.
template <class Real>
inline constexpr Real kLastStep = std::is_same_v<Real, float> ? Real(1e-4) : Real(1e-8);
template <class Real>
inline constexpr Real kClosed = std::is_same_v<Real, float> ? Real(5e-7) : Real(1e-15);  // width of a bracket
// Newton's steps as they come; then those that halve |N - L|, and bisection; then bisection alone, enough of it for the
// whole range of exponents and all digits.
inline constexpr int kNewton = 8, kMixed = 100, kMostSteps = 180;

template <class Real>
struct LocalProblem {
    using Numbers = PackOf<Real>;
    Numbers s, x1, x2;          // [N s]
    Numbers mu, k1, k2, ratio;  // ratio in (0, 1]; in unused lanes all are 0
};

namespace detail {

// The equation at e, over the larger of |x_1| and |x_2|:  f = (N - L) R with L = mu s, and what Newton needs.
template <class Real>
struct Secular {
    using Numbers = PackOf<Real>;
    Numbers x1, x2, limit, mu_k1, mu_k2, ratio, slope;  // slope = 1 - ratio, of R
    // at e
    Numbers R, y1, y2, size, m, f;  // y = R p_T / e, m = |y| + mu k.y = R N / e

    SCREE_INLINE void at(const Numbers& e) {
        R = ratio + slope * e;
        y1 = R * x1;
        y2 = x2;
        size = sqrt(y1 * y1 + y2 * y2);
        m = size + (mu_k1 * y1 + mu_k2 * y2);
        f = e * m - limit * R;
    }
    // Newton's step on 1/N over 1/e, as the next e. Where the denominator is not positive there is none: what is
    // returned then lies outside of any bracket.
    SCREE_INLINE Numbers next(const Numbers& e) const {
        const Numbers d1 = R * y1, d2 = ratio * y2;
        const Numbers rise = limit * ((d1 * y1 + d2 * y2) + size * (mu_k1 * d1 + mu_k2 * d2));
        return e * rise / max(rise + size * (m * f), Numbers::all(kTiny<Real>));
    }
};

template <class Real>
SCREE_INLINE PackOf<Real> abs(const PackOf<Real>& a) {
    return max(a, PackOf<Real>::all(0) - a);
}

}  // namespace detail

// The impulse along n, t and s.
template <class Real>
SCREE_INLINE Pack3Of<Real> solve(const LocalProblem<Real>& q) {
    using Numbers = PackOf<Real>;
    using detail::abs;
    const Numbers zero = Numbers::all(0), one = Numbers::all(1), tiny = Numbers::all(kTiny<Real>);
    const Numbers unit = one / max(max(abs(q.x1), abs(q.x2)), tiny);
    detail::Secular<Real> at{
        unit * q.x1, unit * q.x2, unit * (q.mu * q.s), q.mu * q.k1, q.mu * q.k2, q.ratio, one - q.ratio, {}, {}, {}, {},
        {},          {}};
    Numbers e = one;
    at.at(e);
    const Numbers slips = where_less(zero, q.s, at.f, zero);  // > 0: it does
    const Numbers stick_n = max(q.s - (q.k1 * q.x1 + q.k2 * q.x2), zero);
    Pack3Of<Real> p{where_less(zero, q.s, stick_n, zero), where_less(zero, q.s, q.x1, zero),
                    where_less(zero, q.s, q.x2, zero)};
    if (!any_less(zero, slips)) return p;

    const Numbers small = Numbers::all(kLastStep<Real>);
    Numbers low = zero, high = one, off_before = zero;
    // 1 where the root is still sought; without friction no e is needed below
    Numbers sought = where_less(zero, slips, where_less(zero, at.limit, one, zero), zero);
    for (int k = 0; any_less(zero, sought) && k < kMostSteps; ++k) {
        const Numbers newton = at.next(e), step = abs(newton - e);
        const Numbers last =
            where_less(small * e, step, zero, where_less(small * (at.limit * at.R), abs(at.f), zero, one));
        low = where_less(at.f, zero, e, low);
        high = where_less(at.f, zero, high, e);
        Numbers inside = where_less(low, newton, where_less(newton, high, one, zero), zero);
        if (k >= kNewton) {
            const Numbers off = abs(at.f) / max(at.limit * at.R, tiny);
            inside = where_less(Numbers::all(Real(0.5)) * off_before, off, zero, inside);
            if (k >= kMixed) inside = zero;
            off_before = off;
        }
        Numbers to = newton;
        Numbers done = last;
        // sought, but neither inside nor the last
        const Numbers lost = where_less(inside + last, sought, one, zero);
        if (any_less(zero, lost)) {
            // N <= 2 (1 + mu |k|) e / ratio, so e is no smaller than
            const Numbers least = at.limit * at.ratio / (Numbers::all(2) * (one + (abs(at.mu_k1) + abs(at.mu_k2))));
            low = where_less(zero, lost, max(low, least), low);
            to = where_less(zero, lost, sqrt(low) * sqrt(high), newton);
            const Numbers closed = where_less(low + Numbers::all(kClosed<Real>) * high, high, zero, one);
            done = where_less(zero, lost, closed, done);
        }
        e = where_less(zero, sought, to, e);
        sought = where_less(zero, done, zero, sought);
        at.at(e);
    }
    // |p_T| = mu p_N and u_N = 0 whatever is left of round-off in e
    const Numbers scale = one / max(at.m, tiny);
    p.x = where_less(zero, slips, q.s * (at.size * scale), p.x);
    const Numbers limit = q.mu * q.s;
    p.y = where_less(zero, slips, limit * (at.y1 * scale), p.y);
    p.z = where_less(zero, slips, limit * (at.y2 * scale), p.z);
    return p;
}

}  // namespace scree::solvers
