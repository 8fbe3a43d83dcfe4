// Gap and normal of two convex polyhedra against the slow search of tests/testing/slow_polyhedra.hpp.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "tests/testing/slow_polyhedra.hpp"

namespace scree::contact {
namespace {

using testing::Body;

constexpr double kNever = 1e300;

const std::vector<ConvexShape>& shapes() {
    static const std::vector<ConvexShape> all = [] {
        Random random(1, 2, 3);
        std::vector<ConvexShape> made;
        made.push_back(testing::box_shape({1.0, 1.0, 1.0}));
        made.push_back(testing::box_shape({2.0, 0.7, 0.4}));
        made.push_back(testing::tetrahedron_shape(1.5));
        made.push_back(testing::rock_shape(12, {0.7, 0.6, 0.5}, random));
        made.push_back(testing::rock_shape(30, {0.8, 0.6, 0.5}, random));
        made.push_back(testing::box_shape({5.0, 0.05, 0.05}));  // a needle
        made.push_back(testing::box_shape({3.0, 3.0, 0.03}));   // a plate
        return made;
    }();
    return all;
}

struct Pair {
    std::unique_ptr<Body> a, b;
    double size;

    void move_a(const Vec3& by) { a->placed.position += by; }
};

// In random orientations, `gap` apart along a random direction (so their true gap is at least that).
Pair random_pair(Random& random, double gap) {
    const auto pick = [&]() -> const ConvexShape& {
        return shapes()[static_cast<std::size_t>(random.uniform() * static_cast<double>(shapes().size()))];
    };
    const ConvexShape &sa = pick(), &sb = pick();
    const Quat qa = testing::random_turn(random), qb = testing::random_turn(random);
    const Vec3 n = testing::random_direction(random), aside = testing::random_direction(random);
    Body a(sa, Vec3::Zero(), qa), b(sb, Vec3::Zero(), qb);
    const Vec3 shift = 0.3 * (aside - aside.dot(n) * n);
    const Vec3 position = shift + (gap - testing::slow_separation(a, b, n)) * n;
    return {std::make_unique<Body>(sa, position, qa), std::make_unique<Body>(sb, Vec3::Zero(), qb),
            sa.radius + sb.radius};
}

// The same, moved along the shortest way until they are `gap` apart; overlapping ones come out up to that deep.
Pair near_pair(Random& random, double gap) {
    Pair pair = random_pair(random, 0.3);
    const testing::SlowGap slow = testing::slow_gap(*pair.a, *pair.b);
    pair.move_a((gap - slow.gap) * slow.normal);
    return pair;
}

struct Worst {
    double gap = 0.0, normal = 0.0;
    int apart = 0, overlapping = 0;
};

void expect_exact(const Pair& pair, PolyhedraScratch& scratch, Worst& worst) {
    const Placed &a = *pair.a, &b = *pair.b;
    const testing::SlowGap slow = testing::slow_gap(a, b);
    const PolyhedraGap fast = polyhedra_gap(a, b, kNever, scratch);
    ASSERT_NEAR(fast.gap, slow.gap, 1e-12 * pair.size);
    ASSERT_NEAR(fast.normal.norm(), 1.0, 1e-14);
    // what the gap claims, the supports along the normal bear out
    ASSERT_NEAR(testing::slow_separation(a, b, fast.normal), slow.gap, 1e-12 * pair.size);
    worst.gap = std::max(worst.gap, std::abs(fast.gap - slow.gap) / pair.size);
    ++(slow.gap > 0.0 ? worst.apart : worst.overlapping);
    // The direction of a distance is unique; the slow one, a difference of points, is good to round-off / distance.
    if (slow.gap > 1e-6 * pair.size) {
        worst.normal = std::max(worst.normal, (fast.normal - slow.normal).norm());
        ASSERT_LT((fast.normal - slow.normal).norm(), 1e-9) << "gap " << slow.gap;
    }
}

void expect_exact(Pair (*make)(Random&, double), double low, double high, std::uint64_t stream, int count) {
    PolyhedraScratch scratch;
    Worst worst;
    for (int i = 0; i < count; ++i) {
        Random random(11, stream, static_cast<std::uint64_t>(i));
        expect_exact(make(random, random.uniform(low, high)), scratch, worst);
        if (::testing::Test::HasFatalFailure()) FAIL() << "pair " << i;
    }
    std::printf("    gap within %.1e of the size, normal within %.1e; %d apart, %d overlapping\n", worst.gap,
                worst.normal, worst.apart, worst.overlapping);
}

TEST(PolyhedraGap, DeepOverlap) {
    expect_exact(random_pair, -1.5, -0.3, 1, 2000);
}
TEST(PolyhedraGap, Overlap) {
    expect_exact(near_pair, -0.3, 0.0, 2, 2000);
}
TEST(PolyhedraGap, Distance) {
    expect_exact(random_pair, 0.0, 0.5, 3, 1000);
    expect_exact(near_pair, 0.0, 0.01, 4, 2000);
}
TEST(PolyhedraGap, NearlyTouching) {
    expect_exact(near_pair, -1e-3, 1e-3, 5, 2000);
    expect_exact(near_pair, -1e-5, 1e-5, 6, 2000);
    expect_exact(near_pair, -1e-9, 1e-9, 7, 2000);
    expect_exact(near_pair, -1e-15, 1e-15, 8, 1000);
}

// Faces, edges and vertices exactly aligned: equal orientations, turned by quarters and eighths, moved along a grid.
TEST(PolyhedraGap, Aligned) {
    PolyhedraScratch scratch;
    Worst worst;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Random random(11, 9, i);
        const auto some = [&](int n) { return static_cast<double>(static_cast<int>(random.uniform() * n)); };
        const ConvexShape &sa = shapes()[random.uniform() < 0.5 ? 0 : 2],
                          &sb = shapes()[random.uniform() < 0.7 ? 0 : 2];
        const auto turn = [&] {
            return Quat(Eigen::AngleAxisd(some(8) * std::numbers::pi / 4.0, Vec3::Unit(static_cast<int>(some(3)))));
        };
        const Quat qa = turn(), qb = turn();
        const Vec3 r = 0.25 * Vec3(some(7) - 3.0, some(7) - 3.0, some(7) - 3.0);
        const Pair pair{std::make_unique<Body>(sa, r, qa), std::make_unique<Body>(sb, Vec3::Zero(), qb),
                        sa.radius + sb.radius};
        expect_exact(pair, scratch, worst);
        if (HasFatalFailure()) FAIL() << "pair " << i << " r " << r.transpose();
    }
    EXPECT_GT(worst.apart, 100);
    EXPECT_GT(worst.overlapping, 100);
}

// Both at once, down to round-off: the hardest there is. The gap is then known to 3e-9 of the sizes, from below.
TEST(PolyhedraGap, NearlyParallelAndNearlyTouching) {
    PolyhedraScratch scratch;
    Manifold found;
    for (std::uint64_t i = 0; i < 6000; ++i) {
        Random random(11, 13, i);
        const auto pick = [&](std::size_t n) {
            return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
        };
        const ConvexShape &sa = shapes()[pick(7)], &sb = shapes()[pick(7)];
        const double size = sa.radius + sb.radius, off = std::pow(10.0, random.uniform(-16.0, 0.0));
        const Quat eighths(Eigen::AngleAxisd(static_cast<double>(pick(3)) * std::numbers::pi / 4.0,
                                             Vec3::Unit(static_cast<int>(pick(3)))));
        const Quat qb = testing::random_turn(random);
        const Quat qa = qb * Quat(Eigen::AngleAxisd(off, testing::random_direction(random))) * eighths;
        Body a(sa, 1.01 * size * testing::random_direction(random), qa);
        const Body b(sb, Vec3::Zero(), qb);
        const testing::SlowGap before = testing::slow_gap(a, b);
        const double target = (i % 2 == 0 ? size : -size) * std::pow(10.0, random.uniform(-14.0, -2.0));
        a.placed.position += (target - before.gap) * before.normal;
        const double exact = testing::slow_gap(a, b).gap;
        const PolyhedraGap fast = polyhedra_gap(a, b, kNever, scratch);
        ASSERT_NEAR(fast.gap, exact, 3e-9 * size) << i;
        ASSERT_GT(testing::slow_separation(a, b, fast.normal), exact - 3e-9 * size) << i;
        Vec3 axis = Vec3::Zero();
        if (!polyhedron_polyhedron(a, b, 0.02 * size, axis, scratch, found)) continue;
        double least = kNever;
        for (const ManifoldPoint& p : found.points()) least = std::min(least, p.gap);
        ASSERT_NEAR(least, exact, 3e-9 * size) << i;
    }
}

// d gap / dx_a = n and d gap / dx_b = -n where the normal is unique.
TEST(PolyhedraGap, NormalIsTheGradient) {
    PolyhedraScratch scratch;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        Random random(11, 10, i);
        Pair pair = near_pair(random, random.uniform(-0.05, 0.05));
        const Vec3 way = testing::random_direction(random);
        const PolyhedraGap now = polyhedra_gap(*pair.a, *pair.b, kNever, scratch);
        const double h = 1e-7;
        pair.move_a(h * way);
        const PolyhedraGap later = polyhedra_gap(*pair.a, *pair.b, kNever, scratch);
        if ((now.normal - later.normal).norm() > 1e-4) continue;  // past an equal depth
        // a distance is convex: its difference quotient lies between the slopes at both ends
        EXPECT_NEAR((later.gap - now.gap) / h, now.normal.dot(way), 1e-7 + (now.normal - later.normal).norm()) << i;
    }
}

TEST(PolyhedraGap, ContinuousThroughContact) {
    PolyhedraScratch scratch;
    for (std::uint64_t i = 0; i < 300; ++i) {
        Random random(11, 11, i);
        Pair pair = near_pair(random, 3e-6);
        const Vec3 n = polyhedra_gap(*pair.a, *pair.b, kNever, scratch).normal;
        double before = kNever;
        for (int k = 0; k < 60; ++k) {
            const double gap = polyhedra_gap(*pair.a, *pair.b, kNever, scratch).gap;
            // moves by 1e-7 a time, so the gap falls by at most that, and never rises
            if (k > 0) {
                EXPECT_LE(gap, before + 1e-14) << i << " " << k;
                EXPECT_GE(gap, before - 1e-7 - 1e-14) << i << " " << k;
            }
            before = gap;
            pair.move_a(-1e-7 * n);
        }
    }
}

TEST(PolyhedraGap, TellsFarPairsApart) {
    PolyhedraScratch scratch;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        Random random(11, 12, i);
        const Pair pair = random_pair(random, random.uniform(-0.1, 0.5));
        const double exact = testing::slow_gap(*pair.a, *pair.b).gap, margin = random.uniform(0.0, 0.3);
        const PolyhedraGap found = polyhedra_gap(*pair.a, *pair.b, margin, scratch);
        EXPECT_EQ(found.gap > margin, exact > margin);
        EXPECT_LE(found.gap, exact + 1e-12);
    }
}

}  // namespace
}  // namespace scree::contact
