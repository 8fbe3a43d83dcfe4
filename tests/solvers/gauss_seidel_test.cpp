// The solver on small random problems, against an enumeration of all active sets and against the slow solver.
#include "solvers/gauss_seidel.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
#include "tests/testing/slow_solver.hpp"
#include "tests/testing/solver_case.hpp"

namespace scree::solvers {
namespace {

using testing::SlowSolver;
using testing::SmallScene;
using testing::SolverCase;

// A clump of touching and slightly overlapping spheres with random velocities above a floor.
void clump(SmallScene& w, int count, std::uint64_t seed, bool spin) {
    Random random(seed, 1, 0);
    const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    w.add(Vec3(0, 0, 0.0999), 0.1, vector());
    while (static_cast<int>(w.state.bodies.size()) < count) {
        const double r = random.uniform(0.05, 0.15);
        const std::size_t to = random.bits() % w.state.bodies.size();
        const Vec3 n = vector().normalized();
        const Vec3 x = w.position(to) + (w.radius(to) + r - 1e-4) * n;
        bool is_free = x.z() > r - 1e-3;
        for (std::size_t j = 0; j < w.state.bodies.size() && is_free; ++j)
            is_free = j == to || (x - w.position(j)).norm() > r + w.radius(j) - 1e-3;
        if (is_free) w.add(x, r, vector());
    }
    w.add_floor();
    if (!spin) return;
    for (std::size_t i = 0; i < w.state.bodies.size(); ++i) w.state.bodies.spin.push_back(10.0 * vector());
}

SolverSettings settings(SolverMethod method, double tolerance = 1e-13) {
    SolverSettings s;
    s.method = method;
    s.tolerance = tolerance;
    s.max_sweeps = 20000;
    return s;
}
constexpr auto kPlain = SolverMethod::gauss_seidel, kFast = SolverMethod::conjugate_gauss_seidel;

using Row = std::vector<double>;

// Solves a x = b by elimination with pivots from the diagonal (a is symmetric, semi-definite); false if singular.
bool eliminate(std::vector<Row> a, Row b, Row& x) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        if (a[k][k] < 1e-9 * a[0][0]) return false;
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    x.assign(n, 0.0);
    for (std::size_t k = n; k-- > 0;) {
        x[k] = b[k];
        for (std::size_t j = k + 1; j < n; ++j) x[k] -= a[k][j] * x[j];
        x[k] /= a[k][k];
    }
    return true;
}

// Frictionless: every set of closed contacts is tried; the one whose impulses push and whose other contacts open is
// the solution. Velocities are unique, and a set of independent contacts always gives them.
std::vector<Vec3> enumerate(const contact::ContactSet& contacts, const Bodies& bodies, const Vec3& dv_free) {
    const std::size_t m = contacts.size();
    const auto push = [&](std::vector<Vec3>& v, std::size_t c, double p) {
        const contact::Contact& contact = contacts[c];
        v[contact.a] += p / bodies.mass[contact.a] * contact.normal;
        if (!contact.key.is_wall()) v[contact.b] -= p / bodies.mass[contact.b] * contact.normal;
    };
    const auto normal_velocity = [&](const std::vector<Vec3>& v, std::size_t c) {
        const contact::Contact& contact = contacts[c];
        return contact.normal.dot(contact.key.is_wall() ? v[contact.a] : Vec3(v[contact.a] - v[contact.b]));
    };
    std::vector<Vec3> free = bodies.velocity;
    for (Vec3& v : free) v += dv_free;
    std::vector<Row> w(m, Row(m));
    for (std::size_t k = 0; k < m; ++k) {
        std::vector<Vec3> unit(bodies.size(), Vec3::Zero());
        push(unit, k, 1.0);
        for (std::size_t i = 0; i < m; ++i) w[i][k] = normal_velocity(unit, i);
    }
    for (std::uint32_t set = 0; set < (1U << m); ++set) {
        std::vector<std::size_t> closed;
        for (std::size_t k = 0; k < m; ++k)
            if (((set >> k) & 1U) != 0) closed.push_back(k);
        std::vector<Row> part;
        Row rhs, p;
        for (const std::size_t i : closed) {
            part.emplace_back();
            for (const std::size_t j : closed) part.back().push_back(w[i][j]);
            rhs.push_back(-normal_velocity(free, i) - contacts[i].bias);
        }
        if (!eliminate(part, rhs, p)) continue;
        bool good = std::all_of(p.begin(), p.end(), [](double x) { return x >= 0.0; });
        std::vector<Vec3> v = free;
        for (std::size_t k = 0; k < closed.size(); ++k) push(v, closed[k], p[k]);
        for (std::size_t c = 0; c < m && good; ++c) good = normal_velocity(v, c) + contacts[c].bias > -1e-11;
        if (good) return v;
    }
    ADD_FAILURE() << "no active set is the solution";
    return {};
}

TEST(GaussSeidel, FrictionlessAgreesWithEnumeration) {
    std::size_t contacts = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
        for (const double e : {0.0, 0.7}) {
            SmallScene w(1e-2, 0.0, e);
            clump(w, 5, seed, false);
            SolverCase<Frictionless> c(w);
            contacts += c.contacts.size();
            const SolveReport report = gauss_seidel(c.problem, settings(kPlain));
            EXPECT_TRUE(report.converged);
            EXPECT_LE(report.residual.rms, 1e-13);
            const std::vector<Vec3> expected = enumerate(c.contacts, w.state.bodies, c.dv_free);
            // residual 1e-13 of a velocity of order 1, times the condition of W, at most some hundreds here
            for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_LT((c.velocity(i) - expected[i]).norm(), 1e-10);
        }
    EXPECT_GT(contacts, 300U);
}

TEST(GaussSeidel, FrictionAgreesWithTheSlowSolver) {
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (const double mu : {0.1, 0.5, 1.0}) {
            SmallScene w(1e-2, mu, seed % 2 == 0 ? 0.0 : 0.5);
            clump(w, 8, seed, true);
            SolverCase<Frictional> c(w);
            const SolveReport report = gauss_seidel(c.problem, settings(kPlain, 1e-12));
            EXPECT_TRUE(report.converged) << "mu " << mu;
            SlowSolver slow(c.contacts, w.state.bodies, c.dv_free);
            long double error = 1.0L;
            for (int k = 0; k < 400 && error > 1e-13L; ++k) {
                slow.sweep(50);
                error = 0.0L;
                for (const auto& contact : slow.contact) error = std::max(error, slow.natural_map(contact));
            }
            EXPECT_LE(error, 1e-13L);
            for (std::size_t i = 0; i < w.state.bodies.size(); ++i)
                EXPECT_LT((c.velocity(i).cast<long double>() - slow.body[i].v).norm(), 1e-9) << seed << " mu " << mu;
        }
}

TEST(GaussSeidel, AcceleratedAndPlainAgree) {
    for (std::uint64_t seed = 40; seed < 50; ++seed) {
        SmallScene w(1e-2, 0.3);
        clump(w, 30, seed, true);
        SolverCase<Frictional> plain(w), fast(w);
        EXPECT_TRUE(gauss_seidel(plain.problem, settings(kPlain, 1e-12)).converged);
        EXPECT_TRUE(gauss_seidel(fast.problem, settings(kFast, 1e-12)).converged);
        for (std::size_t i = 0; i < w.state.bodies.size(); ++i)
            EXPECT_LT((plain.velocity(i) - fast.velocity(i)).norm(), 1e-9);
    }
}

// Frictionless stack of N equal balls: the spectral radius of a sweep in order is cos^2(pi / 2N); the acceleration must
// need fewer sweeps by far, whatever the order of the blocks makes of it.
TEST(GaussSeidel, AccelerationPaysOnAStack) {
    SmallScene w(1e-3);
    for (int i = 0; i < 40; ++i) w.add(Vec3(0, 0, 0.1 + 0.2 * i), 0.1);
    w.add_floor();
    SolverCase<Frictionless> plain(w), fast(w);
    const SolveReport slow = gauss_seidel(plain.problem, settings(kPlain, 1e-4));
    const SolveReport quick = gauss_seidel(fast.problem, settings(kFast, 1e-4));
    EXPECT_TRUE(slow.converged);
    EXPECT_TRUE(quick.converged);
    EXPECT_LT(3 * quick.sweeps, slow.sweeps);
    // contact k under N - k balls carries (N - k) m g h; 1e-4 of g h a contact, times 0.405 N^2 at worst
    std::vector<Vec3> unused;
    std::vector<double> p;
    fast.problem.impulses(unused, p);
    for (std::size_t c = 0; c < p.size(); ++c) {
        const double carried = fast.contacts[c].key.is_wall() ? 40.0 : 39.0 - static_cast<double>(fast.contacts[c].a);
        EXPECT_NEAR(p[c] / (w.mass() * 9.81e-3), carried, 0.065);
    }
}

TEST(GaussSeidel, AStepThatEndsAtItsLimitSaysSo) {
    SmallScene w(1e-3);
    for (int i = 0; i < 40; ++i) w.add(Vec3(0, 0, 0.1 + 0.2 * i), 0.1);
    w.add_floor();
    SolverCase<Frictionless> c(w);
    SolverSettings s = settings(kPlain, 1e-6);
    s.max_sweeps = 7;
    const SolveReport report = gauss_seidel(c.problem, s);
    EXPECT_EQ(report.sweeps, 7);
    EXPECT_FALSE(report.converged);
    EXPECT_GT(report.residual.rms, 1e-6);
    EXPECT_EQ(report.residual.rms, c.problem.residual().rms);  // that of the state which is returned
}

TEST(GaussSeidel, TheReportedResidualIsTheNaturalMap) {
    SmallScene w(1e-2, 0.5);
    clump(w, 12, 3, true);
    SolverCase<Frictional> c(w);
    SolverSettings s = settings(kFast, 1e-30);
    s.max_sweeps = 4;
    const SolveReport report = gauss_seidel(c.problem, s);
    SlowSolver slow(c.contacts, w.state.bodies, c.dv_free);
    long double drive = 0.0L;
    for (const auto& contact : slow.contact) {
        const auto u = slow.velocity(contact);
        drive += (u + contact.bias * contact.n).squaredNorm();
    }
    std::vector<Vec3> p;
    std::vector<double> unused;
    c.problem.impulses(p, unused);
    for (std::size_t k = 0; k < p.size(); ++k) {
        slow.contact[k].p = p[k].cast<long double>();
        slow.push(slow.contact[k], slow.contact[k].p);
    }
    long double sum = 0.0L, largest = 0.0L;
    for (const auto& contact : slow.contact) {
        const long double f = slow.natural_map(contact);
        sum += f * f;
        largest = std::max(largest, f);
    }
    const auto count = static_cast<long double>(slow.contact.size());
    const long double v_ref = std::max<long double>(0.0981L, std::sqrt(drive / count));
    EXPECT_GT(report.residual.rms, 1e-6);
    EXPECT_NEAR(report.residual.rms, static_cast<double>(std::sqrt(sum / count) / v_ref), 1e-12);
    EXPECT_NEAR(report.residual.max, static_cast<double>(largest / v_ref), 1e-12);
}

TEST(GaussSeidel, NoContactsNoSweeps) {
    SmallScene w(1e-3);
    w.add(Vec3::Zero(), 0.1);
    SolverCase<Frictionless> c(w);
    const SolveReport report = gauss_seidel(c.problem, settings(kFast));
    EXPECT_EQ(report.sweeps, 0);
    EXPECT_TRUE(report.converged);
}

}  // namespace
}  // namespace scree::solvers
