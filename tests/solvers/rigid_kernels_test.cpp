// The kernels of bodies of any shape against the same contact solved in long double, and against the law itself.
#include "solvers/rigid_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>

#include "solvers/kernels.hpp"
#include "tests/testing/rigid_contacts.hpp"

namespace scree::solvers {
namespace {

using testing::RigidContacts, testing::Shape, testing::SlowRigidContact;
using Real = SlowRigidContact::Real;
using V3 = SlowRigidContact::V3;

struct alignas(64) Lanes {
    double x[kLanes];
};
Lanes lanes(const Pack& a) {
    Lanes r;
    a.store(r.x);
    return r;
}

constexpr std::array kFrictions{0.0, 0.05, 0.5, 1.0, 10.0, 100.0};
constexpr std::array kShapes{Shape::sphere, Shape::grain, Shape::plate, Shape::needle};
constexpr Real kRound = 2.2e-16L;
Real off(Real a, Real b) {
    return std::abs(a - b);
}

// Round-off of velocities [m/s]: a few dozen operations, each of one half of kRound of what is added up, the velocities
// themselves and the impulses in units of velocity.
Real round_off(const SlowRigidContact& before, const SlowRigidContact& after) {
    const Real w = after.size_of_delassus();
    return 30 * kRound *
           (before.size_of_velocity() + after.size_of_velocity() + w * (before.p.norm() + after.p.norm()));
}

// 6 frictions x 4 shapes x 530 seeds x 8 lanes > 1e5 contacts.
template <class Check>
void for_each_batch(int seeds, const Check& check) {
    for (const Shape shape : kShapes)
        for (const double mu : kFrictions)
            for (int seed = 0; seed < seeds; ++seed)
                check(RigidContacts(static_cast<std::uint64_t>(seed), shape, mu, seed % 2 == 0 ? 0.4 : 1.0));
}

// Signorini's and Coulomb's conditions, on the velocities in the lines and the impulses in the batch.
//
// Where friction couples the normal and the tangents, p_N = s |y| / (|y| + mu k.y), and round-off grows by what it
// grows: (1 + mu |k|) p_N / s.
void expect_the_law(const RigidContacts& before, const RigidContacts& after, int lane) {
    const SlowRigidContact c = after.slow(lane), old = before.slow(lane);
    const auto r = old.reduced();
    const Real pn = after.friction.p[0][lane], wn = c.n.dot(c.delassus() * c.n);
    const Real grows = 1 + (r.s > 0 ? (1 + c.mu * r.k.norm()) * pn / r.s : 0);
    const Real exact = round_off(old, c), rounded = exact * grows;
    const V3 u = c.velocity(), ut = u - u.dot(c.n) * c.n, pt = after.tangential(lane);
    const Real un = u.dot(c.n) + c.bias;
    EXPECT_GE(pn, 0);
    EXPECT_GE(un, -exact);
    if (pn > 0) {
        EXPECT_LE(un, exact);
    }
    EXPECT_LE(pt.norm(), c.mu * pn * (1 + 10 * kRound));
    if (pt.norm() < c.mu * pn * (1 - 10 * kRound)) {
        EXPECT_LE(ut.norm(), exact) << "sticks";
    } else if (pt.norm() > 0) {
        const V3 along = pt.normalized();
        EXPECT_LE(ut.dot(along), rounded);
        EXPECT_LE((ut - ut.dot(along) * along).norm(), rounded) << "slips, mu " << static_cast<double>(c.mu);
    } else {
        EXPECT_LE(c.mu * pn * wn, exact);
    }
}

TEST(RigidKernels, UpdateSatisfiesSignoriniAndCoulomb) {
    for_each_batch(530, [](const RigidContacts& before) {
        RigidContacts b = before;
        update<false>(b.friction, b.line.data(), nullptr, Pack::all(0.0));
        for (int i = 0; i < kLanes; ++i) expect_the_law(before, b, i);
        for (int d = 0; d < 3; ++d) {
            EXPECT_EQ(b.line[kGround].v[d], 0.0);
            EXPECT_EQ(b.line[kGround].w[d], 0.0);
        }
    });
}

// Where there is one solution (in Painlevé's case there can be more) it is this one. How far round-off of velocities
// moves it: by what moves the slip's root, whose equation's slope the slow solution measures.
TEST(RigidKernels, UpdateIsTheSlowSolution) {
    int compared = 0, several = 0;
    for_each_batch(60, [&](const RigidContacts& before) {
        RigidContacts b = before;
        update<false>(b.friction, b.line.data(), nullptr, Pack::all(0.0));
        for (int i = 0; i < kLanes; ++i) {
            const SlowRigidContact old = before.slow(i), now = b.slow(i);
            const auto solution = old.solve();
            if (solution.roots > 1) {
                ++several;
                continue;
            }
            ++compared;
            const auto r = old.reduced();
            const Real a1 = r.schur.selfadjointView<Eigen::Lower>().eigenvalues()[0];
            const Real exact = round_off(old, now) / std::min(a1, r.w(0, 0));
            Real grows = 1 + r.k.norm();
            if (solution.lambda > 0) {  // |p_T| (1 + k..) / |d(|p_T| - mu p_N) / d log(a1 + lambda)|
                const Real step = 1e-6L * (a1 + solution.lambda);
                const Real slope = (r.excess(solution.lambda + step) - r.excess(solution.lambda - step)) / 2e-6L;
                grows *= 1 + (1 + old.mu * r.k.norm()) * solution.p.norm() / std::abs(slope);
            }
            EXPECT_LE((now.p - solution.p).norm(), exact * grows) << "mu " << static_cast<double>(old.mu);
        }
    });
    EXPECT_GT(compared, 10000);
    EXPECT_GT(several, 0);
}

TEST(RigidKernels, SpheresAreThoseOfTheSphereKernels) {
    for (int seed = 0; seed < 200; ++seed)
        for (const double mu : kFrictions) {
            RigidContacts b(static_cast<std::uint64_t>(seed), Shape::sphere, mu);
            FrictionBatch friction{};
            FrictionlessBatch frictionless{};
            std::array<SpinningLine, RigidContacts::kBodies + 1> spinning{};
            std::array<SlidingLine, RigidContacts::kBodies + 1> sliding{};
            std::array<double, RigidContacts::kBodies + 1> radius{};
            for (std::size_t i = 0; i < kLanes; ++i) {
                radius[b.friction.a[i]] = b.data[i].ra.norm();
                radius[b.friction.b[i]] = b.data[i].rb.norm();
            }
            for (std::size_t k = 1; k < spinning.size(); ++k) {
                spinning[k].inverse_mass = sliding[k].inverse_mass = b.line[k].inverse_mass;
                spinning[k].inverse_inertia = 2.5 * b.line[k].inverse_mass;
                for (int d = 0; d < 3; ++d) {
                    spinning[k].v[d] = sliding[k].v[d] = b.line[k].v[d];
                    spinning[k].w[d] = radius[k] * b.line[k].w[d];
                }
            }
            for (int i = 0; i < kLanes; ++i) {
                friction.a[i] = frictionless.a[i] = b.friction.a[i];
                friction.b[i] = frictionless.b[i] = b.friction.b[i];
                for (int d = 0; d < 3; ++d) friction.n[d][i] = frictionless.n[d][i] = b.friction.n[d][i];
                friction.bias[i] = frictionless.bias[i] = b.friction.bias[i];
                friction.friction[i] = mu;
                friction.inverse_w[i] = frictionless.inverse_w[i] =
                    1.0 / (b.line[friction.a[i]].inverse_mass + b.line[friction.b[i]].inverse_mass);
                for (int d = 0; d < 3; ++d) friction.p[d][i] = b.impulse[static_cast<std::size_t>(i)][d];
                frictionless.p[0][i] = b.frictionless.p[0][i];
            }
            RigidContacts after = b, smooth = b;
            const Pack zero = Pack::all(0.0);
            const Lanes change = lanes(update<false>(after.friction, after.line.data(), nullptr, zero));
            const Lanes change_sphere = lanes(update<false>(friction, spinning.data(), nullptr, zero));
            update<false>(smooth.frictionless, smooth.line.data(), nullptr, zero);
            update<false>(frictionless, sliding.data(), nullptr, zero);
            for (int i = 0; i < kLanes; ++i) {
                const Vec3 p = world_impulse(after.friction, i);
                const Real inverse_w = friction.inverse_w[i];
                const Real tolerance = round_off(b.slow(i), after.slow(i)) * inverse_w;
                for (int d = 0; d < 3; ++d) EXPECT_LE(off(p[d], friction.p[d][i]), tolerance) << "mu " << mu;
                EXPECT_LE(off(smooth.frictionless.p[0][i], frictionless.p[0][i]), tolerance);
                EXPECT_LE(off(std::sqrt(change.x[i]), std::sqrt(change_sphere.x[i])), tolerance / inverse_w);
                for (const std::uint32_t k : {friction.a[i], friction.b[i]})
                    for (int d = 0; d < 3; ++d) {
                        const double v = static_cast<double>(10 * tolerance / inverse_w);
                        EXPECT_LE(off(after.line[k].v[d], spinning[k].v[d]), v);
                        EXPECT_LE(off(radius[k] * after.line[k].w[d], spinning[k].w[d]), v);
                        EXPECT_LE(off(smooth.line[k].v[d], sliding[k].v[d]), v);
                    }
            }
        }
}

// A lane's result has the same bits in another place of the batch, beside other contacts, and alone.
TEST(RigidKernels, LanesDoNotKnowTheirNeighbours) {
    for_each_batch(20, [](const RigidContacts& before) {
        RigidContacts together = before;
        update<false>(together.friction, together.line.data(), nullptr, Pack::all(0.0));
        for (int i = 0; i < kLanes; ++i) {
            const int to = (3 * i + 5) % kLanes;
            RigidContacts alone = before;
            alone.friction = {};
            const auto at = static_cast<std::size_t>(i);
            alone.friction.a[to] = before.friction.a[i];
            alone.friction.b[to] = before.friction.b[i];
            set_lane(alone.friction, to, before.data[at], alone.line[before.friction.a[i]],
                     alone.line[before.friction.b[i]]);
            set_world_impulse(alone.friction, to, before.impulse[at]);
            update<false>(alone.friction, alone.line.data(), nullptr, Pack::all(0.0));
            for (int d = 0; d < 3; ++d) EXPECT_EQ(alone.friction.p[d][to], together.friction.p[d][i]);
            for (const std::uint32_t k : {before.friction.a[i], before.friction.b[i]})
                for (int d = 0; d < 3; ++d) {
                    EXPECT_EQ(alone.line[k].v[d], together.line[k].v[d]);
                    EXPECT_EQ(alone.line[k].w[d], together.line[k].w[d]);
                }
        }
    });
}

// Linear momentum, and angular momentum about the origin: the levers of a pair end in one point.
TEST(RigidKernels, APushKeepsMomentum) {
    for_each_batch(20, [](const RigidContacts& before) {
        RigidContacts b = before, f = before;
        apply(b.friction, b.line.data());
        apply(f.frictionless, f.line.data());
        for (const RigidContacts* after : {&b, &f})
            for (int i = 0; i + 1 < kLanes; ++i) {
                V3 linear = V3::Zero(), angular = V3::Zero();
                Real size = 0, turned = 0;
                const SlowRigidContact old = before.slow(i), now = after->slow(i);
                const auto add = [&](const SlowRigidContact::Body& was, const SlowRigidContact::Body& is,
                                     const Vec3& at) {
                    const V3 dp = (is.v - was.v) / is.inverse_mass, x = at.cast<Real>();
                    const V3 spun = is.inverse_inertia.inverse() * (is.w - was.w);
                    linear += dp;
                    angular += spun + x.cross(dp);
                    size += (was.v.norm() + is.v.norm()) / is.inverse_mass + dp.norm();
                    // inverse of the inverse: as exact as the inertia is conditioned
                    turned += is.inverse_inertia.inverse().norm() * (was.w.norm() + is.w.norm()) +
                              (x.norm() + is.r.norm()) * (was.v.norm() + is.v.norm()) / is.inverse_mass + spun.norm() +
                              is.inverse_inertia.inverse().norm() * is.inverse_inertia.norm() * is.r.norm() * dp.norm();
                };
                const auto at = static_cast<std::size_t>(i);
                add(old.a, now.a, before.position[at]);
                add(old.b, now.b, before.position[at + kLanes]);
                EXPECT_LE(linear.norm(), 10 * kRound * size);
                EXPECT_LE(angular.norm(), 20 * kRound * turned);
            }
    });
}

TEST(RigidKernels, NaturalMapIsItsFormula) {
    for_each_batch(60, [](const RigidContacts& b) {
        const Lanes friction = lanes(natural_map(b.friction, b.line.data()));
        const Lanes frictionless = lanes(natural_map(b.frictionless, b.line.data()));
        for (int i = 0; i < kLanes; ++i) {
            const SlowRigidContact c = b.slow(i);
            const Real scale = round_off(c, c) * (1 + c.mu);
            EXPECT_LE(std::abs(std::sqrt(static_cast<Real>(friction.x[i])) - c.natural_map()), scale);
            EXPECT_LE(std::abs(std::sqrt(static_cast<Real>(frictionless.x[i])) - c.natural_map(false)), scale);
        }
    });
}

TEST(RigidKernels, NaturalMapVanishesAtTheSolution) {
    for_each_batch(60, [](const RigidContacts& before) {
        RigidContacts b = before, f = before;
        update<false>(b.friction, b.line.data(), nullptr, Pack::all(0.0));
        update<false>(f.frictionless, f.line.data(), nullptr, Pack::all(0.0));
        const Lanes friction = lanes(natural_map(b.friction, b.line.data()));
        const Lanes frictionless = lanes(natural_map(f.frictionless, f.line.data()));
        for (int i = 0; i < kLanes; ++i) {
            const SlowRigidContact old = before.slow(i), now = b.slow(i);
            const auto r = old.reduced();
            // as in expect_the_law; mu |u_T| is added to and taken off the normal part
            const Real pn = b.friction.p[0][i], grows = 1 + (r.s > 0 ? (1 + now.mu * r.k.norm()) * pn / r.s : 0);
            EXPECT_LE(std::sqrt(static_cast<Real>(friction.x[i])), round_off(old, now) * (1 + now.mu) * grows);
            EXPECT_LE(std::sqrt(static_cast<Real>(frictionless.x[i])), round_off(before.slow(i), f.slow(i)));
        }
    });
}

// y + beta (y - y_previous) for impulses, where the lines already are: the same as a plain update from there.
TEST(RigidKernels, MomentumStartsFromTheExtrapolatedImpulse) {
    RigidContacts b(11, Shape::grain, 0.4), plain = b;
    alignas(64) double previous[3][kLanes], previous_normal[1][kLanes];
    for (int i = 0; i < kLanes; ++i) {
        for (int d = 0; d < 3; ++d) {
            previous[d][i] = 0.5 * b.friction.p[d][i] + 0.1 * d;
            plain.friction.p[d][i] += 0.75 * (plain.friction.p[d][i] - previous[d][i]);
        }
        previous_normal[0][i] = 0.25 * b.frictionless.p[0][i];
        plain.frictionless.p[0][i] += 0.75 * (plain.frictionless.p[0][i] - previous_normal[0][i]);
    }
    const RigidContacts before = b;
    RigidContacts smooth = b, plain_smooth = plain;
    update<true>(b.friction, b.line.data(), previous, Pack::all(0.75));
    update<false>(plain.friction, plain.line.data(), nullptr, Pack::all(0.0));
    update<true>(smooth.frictionless, smooth.line.data(), previous_normal, Pack::all(0.75));
    update<false>(plain_smooth.frictionless, plain_smooth.line.data(), nullptr, Pack::all(0.0));
    for (int i = 0; i < kLanes; ++i) {
        for (int d = 0; d < 3; ++d) {
            EXPECT_EQ(b.friction.p[d][i], plain.friction.p[d][i]);
            EXPECT_EQ(previous[d][i], before.friction.p[d][i]);
        }
        EXPECT_EQ(smooth.frictionless.p[0][i], plain_smooth.frictionless.p[0][i]);
        EXPECT_EQ(previous_normal[0][i], before.frictionless.p[0][i]);
    }
    for (std::size_t k = 0; k < b.line.size(); ++k)
        for (int d = 0; d < 3; ++d) {
            EXPECT_EQ(b.line[k].w[d], plain.line[k].w[d]);
            EXPECT_EQ(smooth.line[k].w[d], plain_smooth.line[k].w[d]);
        }
}

TEST(RigidKernels, DriveWorkAndChange) {
    for_each_batch(10, [](const RigidContacts& before) {
        const Lanes q = lanes(drive(before.friction, before.line.data()));
        const Lanes q_n = lanes(drive(before.frictionless, before.line.data()));
        const WorkPacks w = work(before.friction, before.line.data());
        const WorkPacks w_n = work(before.frictionless, before.line.data());
        const Lanes normal = lanes(w.normal), tangential = lanes(w.tangential), smooth = lanes(w_n.normal);
        RigidContacts b = before, f = before;
        const Lanes change = lanes(update<false>(b.friction, b.line.data(), nullptr, Pack::all(0.0)));
        const Lanes change_n = lanes(update<false>(f.frictionless, f.line.data(), nullptr, Pack::all(0.0)));
        EXPECT_EQ(sum_lanes(w_n.tangential), 0.0);
        for (int i = 0; i < kLanes; ++i) {
            const SlowRigidContact c = before.slow(i);
            const V3 u = c.velocity();
            const Real un = u.dot(c.n), pn = c.p.dot(c.n), wn = c.n.dot(c.delassus() * c.n);
            const Real tolerance = round_off(c, c),
                       of_work = tolerance * c.p.norm() + 30 * kRound * c.p.norm() * u.norm();
            EXPECT_LE(off(std::sqrt(q.x[i]), (u + c.bias * c.n).norm()), tolerance);
            EXPECT_LE(off(std::sqrt(q_n.x[i]), std::abs(un + c.bias)), tolerance);
            EXPECT_LE(off(normal.x[i], pn * un), of_work);
            EXPECT_LE(off(tangential.x[i], c.p.dot(u) - pn * un), of_work);
            EXPECT_LE(off(smooth.x[i], pn * un), of_work);
            const Real moved = wn * (b.slow(i).p - c.p).norm(), of_moved = round_off(c, b.slow(i));
            EXPECT_LE(off(std::sqrt(change.x[i]), moved), of_moved);
            EXPECT_LE(off(std::sqrt(change_n.x[i]), wn * std::abs(f.frictionless.p[0][i] - pn)), of_moved);
        }
    });
}

// Lanes without a contact join the ground to the ground.
TEST(RigidKernels, UnusedLanesDoNothing) {
    RigidFrictionalBatch batch{};
    RigidFrictionlessBatch plain{};
    RigidLine ground{};
    const Pack zero = Pack::all(0.0);
    EXPECT_EQ(sum_lanes(update<false>(batch, &ground, nullptr, zero)), 0.0);
    EXPECT_EQ(sum_lanes(natural_map(batch, &ground)), 0.0);
    EXPECT_EQ(sum_lanes(drive(batch, &ground)), 0.0);
    EXPECT_EQ(sum_lanes(update<false>(plain, &ground, nullptr, zero)), 0.0);
    EXPECT_EQ(sum_lanes(natural_map(plain, &ground)), 0.0);
    into_cone(batch);
    for (int d = 0; d < 3; ++d) {
        EXPECT_EQ(ground.v[d], 0.0);
        EXPECT_EQ(ground.w[d], 0.0);
        EXPECT_EQ(batch.p[d][0], 0.0);
    }
}

}  // namespace
}  // namespace scree::solvers
