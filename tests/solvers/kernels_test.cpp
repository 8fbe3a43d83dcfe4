// The kernels against the same contact solved in long double, one by one.
#include "solvers/kernels.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/random.hpp"
#include "tests/testing/slow_solver.hpp"

namespace scree::solvers {
namespace {

using testing::SlowSolver;
using Real = SlowSolver::Real;
using V3 = SlowSolver::V3;

struct alignas(64) Lanes {
    double x[kLanes];
};
Lanes lanes(const Pack& a) {
    Lanes r;
    a.store(r.x);
    return r;
}

// Eight contacts of sixteen bodies (the last contact: of a body with the ground), random in all.
struct Batches {
    contact::ContactSet contacts;
    Bodies bodies;
    std::vector<Vec3> impulse;
    FrictionBatch friction{};
    FrictionlessBatch frictionless{};
    std::array<SpinningLine, 17> spinning{};
    std::array<SlidingLine, 17> sliding{};

    Batches(std::uint64_t seed, double mu) {
        Random random(seed, 1, 0);
        const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
        for (int i = 0; i < 16; ++i) {
            bodies.id.push_back(BodyId{static_cast<std::uint64_t>(i)});
            bodies.radius.push_back(random.uniform(0.1, 2.0));
            bodies.mass.push_back(std::exp(random.uniform(-3.0, 3.0)));
            bodies.velocity.push_back(vector());
            bodies.spin.push_back(vector());
        }
        for (std::uint32_t i = 0; i < kLanes; ++i) {
            const Vec3 n = vector().normalized();
            ContactKey key = ContactKey::bodies(BodyId{i}, BodyId{i + 8});
            if (i == 7) key = ContactKey::wall(BodyId{i}, WallIndex{0}, 0);
            contacts.push_back({key, i, i + 8, n, -0.01, mu, random.normal()});
            const Vec3 t = n.cross(vector());
            const double pn = std::max(0.0, random.normal());
            impulse.push_back(pn * n + std::min(mu, 5.0) * pn * random.uniform() * t.normalized());
        }
        fill();
    }
    void fill() {
        for (std::size_t i = 0; i < 16; ++i) {
            SpinningLine& s = spinning[i + 1];
            SlidingLine& f = sliding[i + 1];
            for (int d = 0; d < 3; ++d) {
                s.v[d] = f.v[d] = bodies.velocity[i][d];
                s.w[d] = bodies.radius[i] * bodies.spin[i][d];
            }
            s.inverse_mass = f.inverse_mass = 1.0 / bodies.mass[i];
            s.inverse_inertia = 2.5 / bodies.mass[i];
        }
        for (int i = 0; i < kLanes; ++i) {
            const contact::Contact& c = contacts[static_cast<std::size_t>(i)];
            const bool wall = c.key.is_wall();
            friction.a[i] = frictionless.a[i] = c.a + 1;
            friction.b[i] = frictionless.b[i] = wall ? kGround : c.b + 1;
            const double w = 1.0 / bodies.mass[c.a] + (wall ? 0.0 : 1.0 / bodies.mass[c.b]);
            friction.inverse_w[i] = frictionless.inverse_w[i] = 1.0 / w;
            friction.bias[i] = frictionless.bias[i] = c.bias;
            friction.friction[i] = c.friction;
            const Vec3& p = impulse[static_cast<std::size_t>(i)];
            for (int d = 0; d < 3; ++d) {
                friction.n[d][i] = frictionless.n[d][i] = c.normal[d];
                friction.p[d][i] = p[d];
            }
            frictionless.p[0][i] = p.dot(c.normal);
        }
    }
    // The same, for the slow solver; without friction only the normal impulses and no spin.
    SlowSolver slow(bool frictional) const {
        Bodies b = bodies;
        if (!frictional) b.spin.clear();
        SlowSolver s(contacts, b, Vec3::Zero());
        for (std::size_t i = 0; i < 8; ++i) {
            s.contact[i].p = impulse[i].cast<Real>();
            if (frictional) continue;
            s.contact[i].mu = 0;
            s.contact[i].p = s.contact[i].p.dot(s.contact[i].n) * s.contact[i].n;
        }
        return s;
    }
};

V3 impulse_of(const FrictionBatch& batch, int i) {
    return {batch.p[0][i], batch.p[1][i], batch.p[2][i]};
}

constexpr std::array kFrictions{0.0, 0.3, 10.0, 1e3};

// Round-off of a kernel: a few dozen operations on numbers of the size of `scale`.
constexpr double kRound = 1e-14;

TEST(Kernels, UpdateIsTheExactLocalSolution) {
    for (std::uint64_t seed = 0; seed < 50; ++seed)
        for (const double mu : kFrictions) {
            Batches b(seed, mu);
            SlowSolver slow = b.slow(true);
            update<false>(b.friction, b.spinning.data(), nullptr, Pack::all(0.0));
            slow.sweep(1);
            for (int i = 0; i < kLanes; ++i) {
                const auto& c = slow.contact[static_cast<std::size_t>(i)];
                const double scale =
                    1.0 + static_cast<double>(c.p.norm()) + 10.0 / static_cast<double>(slow.normal_delassus(c));
                EXPECT_LE((impulse_of(b.friction, i) - c.p).norm(), kRound * scale) << "mu " << mu << " lane " << i;
            }
            for (std::size_t k = 0; k < 16; ++k)
                for (int d = 0; d < 3; ++d) {
                    EXPECT_NEAR(b.spinning[k + 1].v[d], static_cast<double>(slow.body[k].v[d]), 20 * kRound);
                    EXPECT_NEAR(b.spinning[k + 1].w[d],
                                static_cast<double>(slow.body[k].radius * slow.body[k].omega[d]), 50 * kRound);
                }
            for (int d = 0; d < 3; ++d) EXPECT_EQ(b.spinning[kGround].v[d], 0.0);
        }
}

// Signorini's and Coulomb's conditions on what comes out, whatever the reference says. Velocities are of order 1 to 10.
TEST(Kernels, UpdateSatisfiesSignoriniAndCoulomb) {
    for (std::uint64_t seed = 100; seed < 150; ++seed)
        for (const double mu : kFrictions) {
            Batches b(seed, mu);
            update<false>(b.friction, b.spinning.data(), nullptr, Pack::all(0.0));
            SlowSolver after = b.slow(true);
            for (std::size_t k = 0; k < 16; ++k)
                for (int d = 0; d < 3; ++d) {
                    after.body[k].v[d] = b.spinning[k + 1].v[d];
                    after.body[k].omega[d] = b.spinning[k + 1].w[d] / after.body[k].radius;
                }
            for (int i = 0; i < kLanes; ++i) {
                const auto& c = after.contact[static_cast<std::size_t>(i)];
                const V3 u = after.velocity(c), p = impulse_of(b.friction, i);
                const Real w = after.normal_delassus(c), un = u.dot(c.n) + c.bias, pn = p.dot(c.n);
                const V3 ut = u - u.dot(c.n) * c.n, pt = p - pn * c.n;
                const Real tolerance = kRound * (10 + w * p.norm());  // [m/s]
                EXPECT_GE(w * pn, -tolerance);
                EXPECT_GE(un, -tolerance);
                EXPECT_LE(std::min(w * pn, un), tolerance);  // one of the two is 0
                EXPECT_LE(w * (pt.norm() - mu * pn), tolerance);
                // sticking, or the impulse against the slip at its limit
                if (ut.norm() > tolerance) {
                    EXPECT_LE(w * (pt + mu * pn * ut / ut.norm()).norm(), tolerance * (1 + w * p.norm() / ut.norm()));
                }
            }
        }
}

TEST(Kernels, WithoutFrictionTheTangentIsExactlyZero) {
    Batches b(7, 0.0);
    const auto spin = b.spinning;
    for (int i = 0; i < kLanes; ++i) {  // normals along the axes: no round-off can lend a tangent
        for (int d = 0; d < 3; ++d) b.friction.n[d][i] = d == i % 3 ? 1.0 : 0.0;
        for (int d = 0; d < 3; ++d) b.friction.p[d][i] = 0.0;
    }
    update<false>(b.friction, b.spinning.data(), nullptr, Pack::all(0.0));
    for (int i = 0; i < kLanes; ++i)
        for (int d = 0; d < 3; ++d) {
            if (d == i % 3) continue;
            EXPECT_EQ(b.friction.p[d][i], 0.0);
        }
    for (std::size_t k = 0; k < spin.size(); ++k)
        for (int d = 0; d < 3; ++d) EXPECT_EQ(b.spinning[k].w[d], spin[k].w[d]);
}

TEST(Kernels, FrictionlessUpdateAgrees) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Batches b(seed, 0.0);
        SlowSolver slow = b.slow(false);
        update<false>(b.frictionless, b.sliding.data(), nullptr, Pack::all(0.0));
        slow.sweep(1);
        for (int i = 0; i < kLanes; ++i) {
            const auto& c = slow.contact[static_cast<std::size_t>(i)];
            EXPECT_NEAR(b.frictionless.p[0][i], static_cast<double>(c.p.dot(c.n)),
                        kRound * (1.0 + 10.0 / static_cast<double>(slow.normal_delassus(c))));
        }
        for (std::size_t k = 0; k < 16; ++k)
            for (int d = 0; d < 3; ++d)
                EXPECT_NEAR(b.sliding[k + 1].v[d], static_cast<double>(slow.body[k].v[d]), 20 * kRound);
    }
}

// y + beta (y - y_previous) for impulses, where the lines already are: the same as a plain update from there.
TEST(Kernels, MomentumStartsFromTheExtrapolatedImpulse) {
    Batches b(11, 0.4), plain(11, 0.4);
    alignas(64) double previous[3][kLanes];
    for (int d = 0; d < 3; ++d)
        for (int i = 0; i < kLanes; ++i) {
            previous[d][i] = 0.5 * b.friction.p[d][i] + 0.1 * d;
            plain.friction.p[d][i] += 0.75 * (plain.friction.p[d][i] - previous[d][i]);
        }
    const FrictionBatch before = b.friction;
    update<true>(b.friction, b.spinning.data(), previous, Pack::all(0.75));
    update<false>(plain.friction, plain.spinning.data(), nullptr, Pack::all(0.0));
    for (int i = 0; i < kLanes; ++i)
        for (int d = 0; d < 3; ++d) {
            EXPECT_EQ(b.friction.p[d][i], plain.friction.p[d][i]);
            EXPECT_EQ(previous[d][i], before.p[d][i]);
        }
    for (std::size_t k = 0; k < 17; ++k)
        for (int d = 0; d < 3; ++d) EXPECT_EQ(b.spinning[k].v[d], plain.spinning[k].v[d]);
}

TEST(Kernels, NaturalMapIsItsFormula) {
    for (std::uint64_t seed = 0; seed < 50; ++seed)
        for (const double mu : kFrictions) {
            const Batches b(seed, mu);
            const SlowSolver slow = b.slow(true);
            const Lanes square = lanes(natural_map(b.friction, b.spinning.data()));
            for (int i = 0; i < kLanes; ++i) {
                const auto& c = slow.contact[static_cast<std::size_t>(i)];
                const Real expected = slow.natural_map(c);
                // p / rho, u and mu |u_T| are added before they cancel
                const Real scale =
                    (1 + c.mu) * slow.velocity(c).norm() + std::abs(c.bias) + 8 * slow.normal_delassus(c) * c.p.norm();
                EXPECT_LE(std::abs(std::sqrt(static_cast<Real>(square.x[i])) - expected), 2 * kRound * scale)
                    << "mu " << mu << " lane " << i;
            }
        }
}

TEST(Kernels, NaturalMapVanishesAtTheSolution) {
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (const double mu : kFrictions) {
            Batches b(seed, mu);
            update<false>(b.friction, b.spinning.data(), nullptr, Pack::all(0.0));
            update<false>(b.frictionless, b.sliding.data(), nullptr, Pack::all(0.0));
            // mu |u_T| is subtracted from a normal impulse of the size mu |u_T| rho when the contact slides
            EXPECT_LE(std::sqrt(max_lanes(natural_map(b.friction, b.spinning.data()))), 20 * kRound * (1.0 + mu));
            EXPECT_LE(std::sqrt(max_lanes(natural_map(b.frictionless, b.sliding.data()))), 20 * kRound);
        }
}

TEST(Kernels, FrictionlessNaturalMapIsItsFormula) {
    const Batches b(3, 0.0);
    const SlowSolver slow = b.slow(false);
    const Lanes square = lanes(natural_map(b.frictionless, b.sliding.data()));
    for (int i = 0; i < kLanes; ++i)
        EXPECT_NEAR(std::sqrt(square.x[i]),
                    static_cast<double>(slow.natural_map(slow.contact[static_cast<std::size_t>(i)], false)), 1e-13);
}

TEST(Kernels, ApplyDriveAndWork) {
    Batches b(5, 0.4);
    SlowSolver slow = b.slow(true);
    const Lanes q = lanes(drive(b.friction, b.spinning.data()));
    const WorkPacks w = work(b.friction, b.spinning.data());
    const Lanes normal = lanes(w.normal), tangential = lanes(w.tangential);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const auto& c = slow.contact[i];
        const V3 u = slow.velocity(c);
        EXPECT_NEAR(q.x[i], static_cast<double>((u + c.bias * c.n).squaredNorm()), 1e-12);
        EXPECT_NEAR(normal.x[i], static_cast<double>(c.p.dot(c.n) * u.dot(c.n)), 1e-13);
        EXPECT_NEAR(tangential.x[i], static_cast<double>(c.p.dot(u) - c.p.dot(c.n) * u.dot(c.n)), 1e-13);
    }
    apply(b.friction, b.spinning.data());
    for (const auto& c : slow.contact) slow.push(c, c.p);
    for (std::size_t k = 0; k < 16; ++k)
        for (int d = 0; d < 3; ++d) {
            EXPECT_NEAR(b.spinning[k + 1].v[d], static_cast<double>(slow.body[k].v[d]), 20 * kRound);
            EXPECT_NEAR(b.spinning[k + 1].w[d], static_cast<double>(slow.body[k].radius * slow.body[k].omega[d]),
                        50 * kRound);
        }
}

// Lanes without a contact join the ground to the ground.
TEST(Kernels, UnusedLanesDoNothing) {
    FrictionBatch batch{};
    FrictionlessBatch plain{};
    SpinningLine ground{};
    SlidingLine still{};
    const Pack zero = Pack::all(0.0);
    EXPECT_EQ(sum_lanes(update<false>(batch, &ground, nullptr, zero)), 0.0);
    EXPECT_EQ(sum_lanes(natural_map(batch, &ground)), 0.0);
    EXPECT_EQ(sum_lanes(update<false>(plain, &still, nullptr, zero)), 0.0);
    EXPECT_EQ(sum_lanes(natural_map(plain, &still)), 0.0);
    EXPECT_EQ(ground.v[0], 0.0);
    EXPECT_EQ(batch.p[0][0], 0.0);
}

}  // namespace
}  // namespace scree::solvers
