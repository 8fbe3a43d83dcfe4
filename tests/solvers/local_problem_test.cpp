// The local problem by itself, over many orders of magnitude of all its numbers, against the law.
#include "solvers/local_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace scree::solvers {
namespace {

using Wide = long double;

struct Numbers {
    Wide s, x1, x2, mu, k1, k2, ratio;
};
struct Impulse {
    Wide n, t1, t2;
};

// One number in 8 is zero; the others from 10^-decades to 10^decades, either sign.
Wide number(Random& random, double decades) {
    const double x = std::pow(10.0, random.uniform(-decades, decades));
    if (random.uniform() < 0.125) return 0.0L;
    return random.uniform() < 0.5 ? x : -x;
}

template <class Real>
Numbers some_numbers(Random& random, double decades) {
    const auto round = [](Wide x) { return static_cast<Wide>(static_cast<Real>(x)); };
    const auto any = [&](double d) { return round(number(random, d)); };
    return {any(decades),
            any(decades),
            any(decades),
            std::abs(any(2.0)),
            any(2.0),
            any(2.0),
            round(std::pow(10.0L, random.uniform(-decades, 0.0)))};
}

// u_N = 0 or p = 0; p in the cone; S (p_T - x) zero, or against p_T on the cone's border. S has eigenvalues 1 and
// 1 / ratio. What is added up in the equation of the slip is larger than mu s by (1 + mu |k|) p_N / s: so is round-off.
template <class Real>
void expect_the_law(const Numbers& q, const Impulse& p) {
    constexpr Wide kRound = 20 * static_cast<Wide>(std::numeric_limits<Real>::epsilon());
    ASSERT_TRUE(std::isfinite(p.n) && std::isfinite(p.t1) && std::isfinite(p.t2));
    if (q.s <= 0) {
        EXPECT_EQ(p.n, 0);
        EXPECT_EQ(p.t1, 0);
        EXPECT_EQ(p.t2, 0);
        return;
    }
    const Wide k = std::hypot(q.k1, q.k2), tangent = std::hypot(p.t1, p.t2), x = std::hypot(q.x1, q.x2);
    EXPECT_GE(p.n, 0);
    EXPECT_LE(std::abs(p.n - (q.s - (q.k1 * p.t1 + q.k2 * p.t2))), kRound * (q.s + k * x + (1 + q.mu * k) * p.n));
    EXPECT_LE(tangent, q.mu * p.n * (1 + kRound) + kRound * q.mu * k * x);
    const Wide u1 = p.t1 - q.x1, u2 = (p.t2 - q.x2) / q.ratio;
    if (u1 == 0 && u2 == 0) return;  // sticks
    EXPECT_GE(tangent, q.mu * p.n * (1 - kRound));
    if (tangent == 0) return;
    const Wide grows = 1 + (1 + q.mu * k) * p.n / q.s;
    const Wide size = std::abs(p.t1) + std::abs(q.x1) + (std::abs(p.t2) + std::abs(q.x2)) / q.ratio;
    EXPECT_LE(std::abs(u1 * p.t2 - u2 * p.t1) / tangent, kRound * size * grows);
    EXPECT_LE((u1 * p.t1 + u2 * p.t2) / tangent, kRound * size * grows);
}

template <class Real>
void solve_many(double decades, int batches) {
    constexpr int kMany = PackOf<Real>::kLanes;
    Random random(1, 1, kMany);
    int slips = 0, reversed = 0;
    for (int batch = 0; batch < batches; ++batch) {
        alignas(64) Real in[7][kMany], out[3][kMany];
        Numbers q[kMany];
        for (int i = 0; i < kMany; ++i) {
            q[i] = some_numbers<Real>(random, decades);
            const Wide all[7] = {q[i].s, q[i].x1, q[i].x2, q[i].mu, q[i].k1, q[i].k2, q[i].ratio};
            for (int d = 0; d < 7; ++d) in[d][i] = static_cast<Real>(all[d]);
        }
        const auto at = [&](int d) { return PackOf<Real>::load(in[d]); };
        store3(out, solve(LocalProblem<Real>{at(0), at(1), at(2), at(3), at(4), at(5), at(6)}));
        for (int i = 0; i < kMany; ++i) {
            const Impulse p{out[0][i], out[1][i], out[2][i]};
            expect_the_law<Real>(q[i], p);
            const bool slip = q[i].s > 0 && (p.t1 != q[i].x1 || p.t2 != q[i].x2);
            slips += slip ? 1 : 0;
            reversed += slip && q[i].mu * std::hypot(q[i].k1, q[i].k2) > 1 ? 1 : 0;
        }
    }
    EXPECT_GT(slips, batches);
    EXPECT_GT(reversed, batches / 4);  // Painlevé's case
}

TEST(LocalProblem, SatisfiesTheLawWhateverItsNumbers) {
    solve_many<double>(1.0, 10000);
    solve_many<double>(12.0, 10000);
}
TEST(LocalProblem, SatisfiesTheLawInSinglePrecision) {
    solve_many<float>(1.0, 5000);
    solve_many<float>(5.0, 5000);
}

}  // namespace
}  // namespace scree::solvers
