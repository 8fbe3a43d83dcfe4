// The points of contact of two convex polyhedra: the clipped polygon of faces, and for any pair the corners of the gap
// over the plane of contact, found by brute force.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "tests/testing/polyhedra_pair.hpp"
#include "tests/testing/slow_polyhedra.hpp"

namespace scree::contact {
namespace {

using testing::about;
using testing::Body;
using testing::touch;

double least_gap(const Manifold& m) {
    double least = 1e300;
    for (const ManifoldPoint& p : m.points()) least = std::min(least, p.gap);
    return least;
}

// Corners of the intersection of half-planes n . x <= c: all crossings of two borders that satisfy the others.
std::vector<Eigen::Vector2d> polygon(const std::vector<Vec3>& half_planes) {
    std::vector<Eigen::Vector2d> corners;
    for (const Vec3& p : half_planes) {
        for (const Vec3& q : half_planes) {
            const double det = p.x() * q.y() - p.y() * q.x();
            if (det < 1e-9) continue;
            const Eigen::Vector2d x((p.z() * q.y() - p.y() * q.z()) / det, (p.x() * q.z() - p.z() * q.x()) / det);
            bool within = true;
            for (const Vec3& h : half_planes) within = within && h.head<2>().dot(x) <= h.z() + 1e-12;
            if (within) corners.push_back(x);
        }
    }
    return corners;
}

double area_of(std::vector<Eigen::Vector2d> p) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const auto& x : p) middle += x / static_cast<double>(p.size());
    std::sort(p.begin(), p.end(), [&](const auto& x, const auto& y) {
        return std::atan2(x.y() - middle.y(), x.x() - middle.x()) < std::atan2(y.y() - middle.y(), y.x() - middle.x());
    });
    double twice = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto &x = p[i], &y = p[(i + 1) % p.size()];
        twice += x.x() * y.y() - x.y() * y.x();
    }
    return 0.5 * twice;
}

TEST(PolyhedraPatch, FaceOnFaceIsTheClippedPolygon) {
    int most = 0, tested = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        Random random(21, 1, i);
        const auto length = [&] { return random.uniform(0.5, 2.0); };
        const Vec3 sa(length(), length(), length()), sb(length(), length(), length());
        const ConvexShape upper = testing::box_shape(sa), lower = testing::box_shape(sb);
        const double gap = random.uniform(-0.01, 0.01), angle = random.uniform(0.0, 3.0);
        const Vec3 at(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.5 * (sa.z() + sb.z()) + gap);
        const Body a(upper, at, about(Vec3::UnitZ(), angle)), b(lower, Vec3::Zero(), Quat::Identity());
        std::vector<Vec3> half_planes;
        for (int k = 0; k < 4; ++k) {
            const double turn = k * std::numbers::pi / 2.0, half_a = 0.5 * sa[k % 2], half_b = 0.5 * sb[k % 2];
            const Vec3 n(std::cos(turn + angle), std::sin(turn + angle), 0.0), m(std::cos(turn), std::sin(turn), 0.0);
            half_planes.push_back({n.x(), n.y(), half_a + n.dot(at)});
            half_planes.push_back({m.x(), m.y(), half_b});
        }
        const std::vector<Eigen::Vector2d> exact = polygon(half_planes);
        const Manifold found = touch(a, b, 0.02);
        if (exact.empty() || area_of(exact) < 0.05) continue;  // a sliver may be pushed out sideways
        ++tested;
        // corners nearer than the tolerance are one; rare
        bool close = false;
        for (const auto& x : exact) {
            for (const auto& y : exact) close = close || (&x != &y && (x - y).norm() < 1e-4);
        }
        if (close) continue;
        ASSERT_EQ(found.count, static_cast<int>(exact.size())) << i;
        most = std::max(most, found.count);
        for (const ManifoldPoint& p : found.points()) {
            double nearest = 1e300;
            for (const auto& x : exact) nearest = std::min(nearest, (x - p.point.head<2>()).norm());
            ASSERT_LT(nearest, 1e-12) << i;
            ASSERT_NEAR(p.gap, gap, 1e-14);
            ASSERT_NEAR(p.point.z(), 0.5 * (sb.z() + gap), 1e-14);
            ASSERT_LT((p.normal - Vec3::UnitZ()).norm(), 1e-14);
        }
        ASSERT_NEAR(found.area, area_of(exact), 1e-12);
    }
    EXPECT_GT(tested, 1000);
    EXPECT_EQ(most, 8);  // squares turned against one another meet in an octagon
}

// Heights of a body's surface along n over the point x, towards `side` n; no value if the line misses it.
bool surface(const Placed& body, const Vec3& x, const Vec3& n, double side, double& height) {
    double enter = -1e300, leave = 1e300;
    for (std::size_t f = 0; f < body.normal.size(); ++f) {
        const double above = body.normal[f].dot(x - body.position) - body.offset(f),
                     slope = side * body.normal[f].dot(n);
        if (slope > 1e-9) enter = std::max(enter, above / slope);
        if (slope < -1e-9) leave = std::min(leave, above / slope);
        if (std::abs(slope) <= 1e-9 && above > 1e-9) return false;
    }
    height = n.dot(x) - side * enter;
    return enter <= leave + 1e-9;
}

struct SlowCorner {
    Vec3 at;
    double gap;
};

// Gaps over all vertices and all crossings of edges, seen along n: the lower corners of the gap are among them.
std::vector<SlowCorner> slow_corners(const Placed& a, const Placed& b, const Vec3& n) {
    std::vector<SlowCorner> corners;
    // `x` on a and `y` on b, one above the other, both on the surfaces that face one another
    const auto attempt = [&](const Vec3* x, const Vec3* y) {
        double low, high;
        const Vec3& at = x != nullptr ? *x : *y;
        if (!surface(a, at, n, -1.0, low) || !surface(b, at, n, 1.0, high)) return;
        if (x != nullptr && std::abs(n.dot(*x) - low) > 1e-9) return;
        if (y != nullptr && std::abs(n.dot(*y) - high) > 1e-9) return;
        corners.push_back({at, low - high});
    };
    for (const Vec3& v : a.vertex) {
        const Vec3 x = a.position + v;
        attempt(&x, nullptr);
    }
    for (const Vec3& v : b.vertex) {
        const Vec3 x = b.position + v;
        attempt(nullptr, &x);
    }
    for (const auto& e : a.shape->edge) {
        for (const auto& f : b.shape->edge) {
            const Vec3 p = a.position + a.vertex[e.from], d = a.vertex[e.to] - a.vertex[e.from];
            const Vec3 q = b.position + b.vertex[f.from], c = b.vertex[f.to] - b.vertex[f.from];
            const double det = n.dot(d.cross(c));
            if (std::abs(det) < 1e-9) continue;
            const double s = n.dot((q - p).cross(c)) / det, t = n.dot((q - p).cross(d)) / det;
            const Vec3 x = p + s * d, y = q + t * c;
            if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) attempt(&x, &y);
        }
    }
    return corners;
}

std::vector<ConvexShape> shapes() {
    Random random(21, 2, 0);
    return {testing::box_shape({1.0, 1.0, 1.0}), testing::box_shape({2.0, 0.7, 0.4}), testing::tetrahedron_shape(1.5),
            testing::rock_shape(12, {0.7, 0.6, 0.5}, random), testing::rock_shape(30, {0.8, 0.6, 0.5}, random)};
}

// A random pair whose gap is `gap`, or that overlaps by at most as much.
std::pair<std::unique_ptr<Body>, std::unique_ptr<Body>> near_pair(const std::vector<ConvexShape>& all, Random& random,
                                                                  double gap) {
    const auto pick = [&]() -> const ConvexShape& {
        return all[static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size()))];
    };
    const ConvexShape &sa = pick(), &sb = pick();
    const Vec3 n = testing::random_direction(random);
    auto a = std::make_unique<Body>(sa, 1.1 * (sa.radius + sb.radius) * n, testing::random_turn(random));
    auto b = std::make_unique<Body>(sb, 0.1 * testing::random_direction(random), testing::random_turn(random));
    const testing::SlowGap slow = testing::slow_gap(*a, *b);
    a->placed.position += (gap - slow.gap) * slow.normal;
    return {std::move(a), std::move(b)};
}

// Whichever way the bodies are tilted against one another, the points stop them where the surfaces do: the least of
// gap + tilt . x over the points is that over all corners within the margin.
TEST(PolyhedraPatch, HoldsWhatTheSurfacesHold) {
    const std::vector<ConvexShape> all = shapes();
    int tested = 0, counts[Manifold::kCapacity + 1] = {};
    double short_by = 0.0;  // of the margin, where some were left out
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Random random(21, 3, i);
        const auto [a, b] = near_pair(all, random, random.uniform(-0.02, 0.01));
        const double margin = random.uniform() < 0.5 ? 0.02 : 0.15;
        const Manifold found = touch(*a, *b, margin);
        ASSERT_GT(found.count, 0) << i;
        ++counts[found.count];
        const Vec3 n = found.item[0].normal;
        const std::vector<SlowCorner> exact = slow_corners(*a, *b, n);
        PolyhedraScratch scratch;
        ASSERT_NEAR(least_gap(found), polyhedra_gap(*a, *b, margin, scratch).gap, 1e-12) << i;
        for (const ManifoldPoint& p : found.points()) {
            double low, high;
            ASSERT_LE(p.gap, margin);
            ASSERT_EQ(p.normal, n);
            if (!surface(*a, p.point, n, -1.0, low) || !surface(*b, p.point, n, 1.0, high)) continue;
            ASSERT_NEAR(p.gap, low - high, 1e-7) << i;  // ill-conditioned at borders
            ASSERT_NEAR(n.dot(p.point), 0.5 * (low + high), 1e-7) << i;
        }
        // eight may be those left of more
        const bool all_kept = found.count < Manifold::kCapacity;
        for (int k = 0; k < 20; ++k) {
            const Vec3 tilt = random.uniform(0.0, 0.3) * testing::random_direction(random);
            const Vec3 across = tilt - tilt.dot(n) * n;
            double least = 1e300, points = 1e300;
            for (const SlowCorner& c : exact) {
                if (c.gap <= margin) least = std::min(least, c.gap + across.dot(c.at));
            }
            for (const ManifoldPoint& p : found.points()) points = std::min(points, p.gap + across.dot(p.point));
            if (!all_kept) {
                short_by = std::max(short_by, (points - least) / margin);
                continue;
            }
            ASSERT_NEAR(points, least, 5e-5) << i;  // kSameCorner of the sizes
            ++tested;
        }
    }
    EXPECT_GT(tested, 10000);
    EXPECT_LT(short_by, 0.75);
    std::printf("    short by %.2f of the margin\n", short_by);
    for (int c = 0; c <= Manifold::kCapacity; ++c) std::printf("    %d points: %d pairs\n", c, counts[c]);
}

TEST(PolyhedraPatch, ExchangeMirrorsExactly) {
    const std::vector<ConvexShape> all = shapes();
    for (std::uint64_t i = 0; i < 3000; ++i) {
        Random random(21, 4, i);
        const auto [a, b] = near_pair(all, random, random.uniform(-0.2, 0.05));
        if (i % 10 == 0) a->placed.position = b->placed.position;
        const Manifold one = touch(*a, *b, 0.1), two = touch(*b, *a, 0.1);
        ASSERT_EQ(one.count, two.count);
        ASSERT_EQ(one.area, two.area);
        for (std::size_t k = 0; k < static_cast<std::size_t>(one.count); ++k) {
            ASSERT_EQ(one.item[k].point, two.item[k].point);
            ASSERT_EQ(one.item[k].normal, -two.item[k].normal);
            ASSERT_EQ(one.item[k].gap, two.item[k].gap);
            ASSERT_EQ(one.item[k].key, mirrored(two.item[k].key));
        }
    }
}

// Positions on a grid of 2^-30, moved by 2^20: the difference of positions is the same number, and so is all else.
TEST(PolyhedraPatch, FarFromTheOrigin) {
    const std::vector<ConvexShape> all = shapes();
    for (std::uint64_t i = 0; i < 500; ++i) {
        Random random(21, 5, i);
        const auto [a, b] = near_pair(all, random, random.uniform(-0.02, 0.02));
        for (Body* body : {a.get(), b.get()}) {
            for (double& x : body->placed.position) x = std::round(x * 0x1p30) * 0x1p-30;
        }
        const Manifold here = touch(*a, *b, 0.1);
        const Vec3 far(0x1p20, -0x1p20, 0x1p20);
        a->placed.position += far, b->placed.position += far;
        const Manifold there = touch(*a, *b, 0.1);
        ASSERT_EQ(here.count, there.count);
        for (std::size_t k = 0; k < static_cast<std::size_t>(here.count); ++k) {
            ASSERT_EQ(here.item[k].gap, there.item[k].gap);
            ASSERT_EQ(here.item[k].normal, there.item[k].normal);
            ASSERT_EQ(here.item[k].key, there.item[k].key);
            ASSERT_LT((here.item[k].point + far - there.item[k].point).norm(), 4e-10);
        }
    }
}

// No length is special: grains of micrometres and blocks of kilometres.
TEST(PolyhedraPatch, AnyUnitOfLength) {
    for (std::uint64_t i = 0; i < 300; ++i) {
        std::vector<Manifold> found;
        for (const double unit : {1.0, 0x1p-20, 0x1p10}) {
            Random random(21, 6, i);
            std::vector<Vec3> p, q;
            for (int k = 0; k < 12; ++k) {
                p.push_back(unit * testing::random_direction(random));
                q.push_back(unit * testing::random_direction(random));
            }
            const ConvexShape sa = testing::hull_shape(p), sb = testing::hull_shape(q);
            const Quat qa = testing::random_turn(random), qb = testing::random_turn(random);
            const Body a(sa, unit * 1.8 * testing::random_direction(random), qa), b(sb, Vec3::Zero(), qb);
            found.push_back(touch(a, b, 0.1 * unit));
            const Manifold &one = found.front(), &other = found.back();
            ASSERT_EQ(one.count, other.count);
            for (std::size_t k = 0; k < static_cast<std::size_t>(one.count); ++k) {
                ASSERT_NEAR(one.item[k].gap * unit, other.item[k].gap, 1e-12 * unit);
                ASSERT_EQ(one.item[k].key, other.item[k].key);
            }
        }
    }
}

}  // namespace
}  // namespace scree::contact
