// Walls against brute force: every surface is given as patches (u, v) -> point, and the distance is found by searching
// them; nothing of the formulas under test is used.
#include "contact/walls/wall_contact.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "core/random.hpp"

namespace scree::contact {
namespace {

constexpr double kNever = 1e300;

WallContacts contacts(const WallShape& shape, const Vec3& centre, double radius, double margin = kNever) {
    WallContacts found;
    find_contacts(shape, centre, radius, margin, found);
    return found;
}

// The contact with the least gap.
WallContact nearest(const WallShape& shape, const Vec3& centre, double radius) {
    const WallContacts found = contacts(shape, centre, radius);
    EXPECT_GT(found.count, 0);
    WallContact best = found.item[0];
    for (int i = 1; i < found.count; ++i) {
        const WallContact& other = found.item[static_cast<std::size_t>(i)];
        if (other.gap < best.gap) best = other;
    }
    return best;
}

// A piece of surface over the unit square.
using Patch = std::function<Vec3(double, double)>;

// Least distance to a patch: a grid of 40 x 40, then grids of 9 x 9 about the best point, each half as wide.
double distance_to(const Patch& patch, const Vec3& x) {
    double u0 = 0.5, v0 = 0.5, half = 0.5, best = kForever, bu = 0.5, bv = 0.5;
    for (int level = 0; level < 60; ++level) {
        const int n = level == 0 ? 40 : 8;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                const double u = std::clamp(u0 + half * (2.0 * i / n - 1.0), 0.0, 1.0);
                const double v = std::clamp(v0 + half * (2.0 * j / n - 1.0), 0.0, 1.0);
                const double d = (patch(u, v) - x).norm();
                if (d < best) best = d, bu = u, bv = v;
            }
        }
        u0 = bu, v0 = bv, half *= level == 0 ? 0.1 : 0.6;
    }
    return best;
}

struct Frame {
    Vec3 e1, e2, e3;
    explicit Frame(const Vec3& axis) : e3(axis) {
        e1 = axis.unitOrthogonal();
        e2 = e3.cross(e1);
    }
    Vec3 at(double r, double angle, double z) const {
        return r * std::cos(angle) * e1 + r * std::sin(angle) * e2 + z * e3;
    }
};
constexpr double kTurn = 2.0 * std::numbers::pi;

// Surface of revolution from (r0, z0) to (r1, z1).
Patch revolved(const Vec3& base, const Vec3& axis, double r0, double z0, double r1, double z1) {
    return [=, f = Frame(axis)](double u, double v) {
        return Vec3(base + f.at(r0 + (r1 - r0) * v, kTurn * u, z0 + (z1 - z0) * v));
    };
}
Patch rectangle(const Vec3& corner, const Vec3& a, const Vec3& b) {
    return [=](double u, double v) { return Vec3(corner + u * a + v * b); };
}
// Faces of a box: x-, x+, y-, y+, z-, z+.
std::vector<Patch> box_faces(const Vec3& lower, const Vec3& upper) {
    std::vector<Patch> faces;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Vec3 a = (upper[j] - lower[j]) * Vec3::Unit(j), b = (upper[k] - lower[k]) * Vec3::Unit(k);
        faces.push_back(rectangle(lower, a, b));
        faces.push_back(rectangle(lower + (upper[i] - lower[i]) * Vec3::Unit(i), a, b));
    }
    return faces;
}

struct Case {
    std::string name;
    WallShape shape;
    std::vector<Patch> surface;
    std::function<bool(const Vec3&)> buried = [](const Vec3&) { return false; };  // behind a one-sided wall, in a solid
};

// All lengths times `unit`.
std::vector<Case> all_cases(double unit) {
    const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized(), p = unit * Vec3(0.2, 0.1, -0.3);
    const Vec3 along = Frame(axis).e1, across = axis.cross(along);
    const Vec3 lower = unit * Vec3(-0.7, -0.4, -0.5), upper = unit * Vec3(0.6, 0.5, 0.8);
    const double r = 0.6 * unit, r2 = 0.25 * unit, length = 0.9 * unit, far = 8.0 * unit;
    const auto in_box = [=](const Vec3& x) { return (x - lower).minCoeff() > 0.0 && (upper - x).minCoeff() > 0.0; };
    const auto from_axis = [=](const Vec3& x) { return (x - p).cross(axis).norm(); };
    auto open_top = box_faces(lower, upper), open_both = open_top;
    open_top.pop_back();
    open_both.resize(4);
    const Patch side = revolved(p, axis, r, 0.0, r, length);
    std::vector<Case> cases;
    cases.push_back({"plane",
                     PlaneWall{p, axis},
                     {rectangle(p - far * along - far * across, 2 * far * along, 2 * far * across)},
                     [=](const Vec3& x) { return (x - p).dot(axis) < 0.0; }});
    cases.push_back({"box outside", BoxWall{lower, upper, false, false, false}, box_faces(lower, upper), in_box});
    cases.push_back({"box open above", BoxWall{lower, upper, true, true, false}, open_top});
    cases.push_back({"box open at both ends", BoxWall{lower, upper, true, true, true}, open_both});
    cases.push_back({"cylinder", CylinderWall{p, axis, r, length, true}, {side}});
    cases.push_back({"pillar",
                     CylinderWall{p, axis, r, length, false},
                     {side, revolved(p, axis, 0, 0, r, 0), revolved(p, axis, 0, length, r, length)},
                     [=](const Vec3& x) {
                         const double z = (x - p).dot(axis);
                         return z > 0.0 && z < length && from_axis(x) < r;
                     }});
    cases.push_back({"infinite cylinder",
                     CylinderWall{p, axis, r, kForever, true},
                     {revolved(p, axis, r, -far, r, far)},
                     [=](const Vec3& x) { return from_axis(x) > r; }});
    cases.push_back({"infinite pillar",
                     CylinderWall{p, axis, r, kForever, false},
                     {revolved(p, axis, r, -far, r, far)},
                     [=](const Vec3& x) { return from_axis(x) < r; }});
    cases.push_back({"funnel", ConeWall{p, axis, r2, r, length, true}, {revolved(p, axis, r2, 0, r, length)}});
    cases.push_back({"cone", ConeWall{p, axis, r, 0.0, length, false}, {revolved(p, axis, r, 0, 0, length)}});
    cases.push_back({"cone that is a cylinder", ConeWall{p, axis, r, r, length, true}, {side}});
    cases.push_back({"disc", DiscWall{p, axis, r}, {revolved(p, axis, 0, 0, r, 0)}});
    cases.push_back({"orifice floor", OrificeFloor{p, axis, r}, {revolved(p, axis, r, 0, far, 0)}});
    const Vec3 l = 0.5 * length * along, w = r * across, beyond = far * along, aside = far * across;
    cases.push_back({"slot floor",
                     SlotFloor{p, axis, along, 2 * r, length},
                     {rectangle(p + w - beyond, 2 * beyond, aside), rectangle(p - w - beyond, 2 * beyond, -aside),
                      rectangle(p + l - aside, beyond, 2 * aside), rectangle(p - l - aside, -beyond, 2 * aside)}});
    cases.push_back({"endless slot",
                     SlotFloor{p, axis, along, 2 * r, kForever},
                     {rectangle(p + w - beyond, 2 * beyond, aside), rectangle(p - w - beyond, 2 * beyond, -aside)}});
    return cases;
}

Vec3 random_point(Random& random, double unit) {
    return unit * Vec3(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
}

TEST(WallContact, GapIsTheDistanceFoundByBruteForce) {
    for (const Case& c : all_cases(1.0)) {
        for (std::uint64_t i = 0; i < 60; ++i) {
            Random random(7, 1, i);
            const Vec3 x = random_point(random, 1.0);
            const double radius = random.uniform(0.01, 0.5);
            double distance = kForever;
            for (const Patch& patch : c.surface) distance = std::min(distance, distance_to(patch, x));
            if (c.buried(x)) distance = -distance;
            EXPECT_NEAR(nearest(c.shape, x, radius).gap, distance - radius, 1e-9) << c.name << " " << x.transpose();
        }
    }
}

TEST(WallContact, ClosedBoxKeepsABodyInHoweverFarOutItIs) {
    const Vec3 lower(-1, -2, -3), upper(4, 5, 6);
    const WallShape box = BoxWall{lower, upper, true, false, false};
    const double radius = 0.5;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(-0.8, 4.9, 5.9), Vec3(-100, 0, 0), Vec3(9, 9, 9)}) {
        const WallContacts found = contacts(box, x, radius);
        ASSERT_EQ(found.count, 6);
        for (const WallContact& contact :
             {found.item[0], found.item[1], found.item[2], found.item[3], found.item[4], found.item[5]}) {
            const Vec3 face = contact.normal.minCoeff() < 0.0 ? upper : lower;
            EXPECT_DOUBLE_EQ(contact.gap, (x - face).dot(contact.normal) - radius);
        }
    }
    EXPECT_EQ(contacts(box, Vec3(-0.6, 4.6, 5.6), radius, 0.0).count, 3);  // in a corner
}

TEST(WallContact, NormalIsTheGradientOfTheGap) {
    for (const Case& c : all_cases(1.0)) {
        int tested = 0;
        for (std::uint64_t i = 0; i < 300; ++i) {
            Random random(11, 1, i);
            const Vec3 x = random_point(random, 1.0);
            const double d = 1e-6;
            const WallContact at = nearest(c.shape, x, 0.2);
            EXPECT_NEAR(at.normal.norm(), 1.0, 4e-16) << c.name;
            Vec3 gradient;
            bool smooth = true;
            for (int k = 0; k < 3; ++k) {
                const WallContact more = nearest(c.shape, x + d * Vec3::Unit(k), 0.2);
                const WallContact less = nearest(c.shape, x - d * Vec3::Unit(k), 0.2);
                gradient[k] = (more.gap - less.gap) / (2.0 * d);
                smooth = smooth && more.normal.dot(less.normal) > 0.999;  // no ridge of the distance within d
            }
            if (!smooth) continue;
            ++tested;
            EXPECT_LT((gradient - at.normal).norm(), 1e-5) << c.name << " " << x.transpose();
        }
        EXPECT_GT(tested, 280) << c.name;
    }
}

// A distance changes by no more than the way moved, whatever feature is nearest.
TEST(WallContact, GapIsContinuousAcrossFeatures) {
    for (const Case& c : all_cases(1.0)) {
        for (std::uint64_t i = 0; i < 20; ++i) {
            Random random(13, 1, i);
            const Vec3 a = random_point(random, 1.0), b = random_point(random, 1.0);
            const int n = 2000;
            double before = nearest(c.shape, a, 0.1).gap;
            for (int k = 1; k <= n; ++k) {
                const double gap = nearest(c.shape, a + (b - a) * k / n, 0.1).gap;
                ASSERT_LE(std::abs(gap - before), (b - a).norm() / n * (1 + 1e-9)) << c.name << " " << i << " " << k;
                before = gap;
            }
        }
    }
}

TEST(WallContact, LengthsHaveNoScale) {
    const std::vector<Case> one = all_cases(1.0);
    for (const double unit : {1e-6, 1e3, 1e-150, 1e100}) {
        const std::vector<Case> scaled = all_cases(unit);
        for (std::size_t k = 0; k < one.size(); ++k) {
            for (std::uint64_t i = 0; i < 50; ++i) {
                Random random(17, k, i);
                const Vec3 x = random_point(random, 1.0);
                const WallContacts a = contacts(one[k].shape, x, 0.3),
                                   b = contacts(scaled[k].shape, unit * x, 0.3 * unit);
                ASSERT_EQ(a.count, b.count) << one[k].name;
                for (std::size_t j = 0; j < static_cast<std::size_t>(a.count); ++j) {
                    EXPECT_EQ(a.item[j].feature, b.item[j].feature);
                    EXPECT_NEAR(a.item[j].gap, b.item[j].gap / unit, 1e-13);
                    EXPECT_LT((a.item[j].normal - b.item[j].normal).norm(), 1e-12);
                }
            }
        }
    }
}

// No two places share a feature; a margin leaves out what is farther and nothing else.
TEST(WallContact, FeaturesDifferAndAMarginOnlyLeavesOut) {
    for (const Case& c : all_cases(1.0)) {
        for (std::uint64_t i = 0; i < 60; ++i) {
            Random random(19, 1, i);
            const Vec3 x = random_point(random, 1.0);
            const double radius = random.uniform(0.2, 1.2), margin = 0.1;
            const WallContacts all = contacts(c.shape, x, radius), near = contacts(c.shape, x, radius, margin);
            int expected = 0;
            for (std::size_t j = 0; j < static_cast<std::size_t>(all.count); ++j) {
                const WallContact& contact = all.item[j];
                expected += contact.gap <= margin;
                for (std::size_t k = 0; k < j; ++k) EXPECT_NE(contact.feature, all.item[k].feature) << c.name;
                EXPECT_NEAR(contact.normal.norm(), 1.0, 4e-16);
            }
            EXPECT_EQ(near.count, expected) << c.name;
        }
    }
}

// Centres on axes, surfaces, edges, apices: unit normals, right gaps.
TEST(WallContact, DegenerateCentresHaveANormal) {
    const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized(), p(0.2, 0.1, -0.3);
    const double length = 0.9, r = 0.6;
    const Vec3 e = Frame(axis).e1;
    for (const Case& c : all_cases(1.0)) {
        for (const Vec3& x :
             {p, Vec3(p + length * axis), Vec3(p + 0.5 * length * axis), Vec3(p + r * e), Vec3(p - axis),
              Vec3(p + r * e + length * axis), Vec3(-0.7, -0.4, -0.5), Vec3(-0.7, 0, 0), Vec3(0.6, 0.5, 0.8)}) {
            const WallContacts found = contacts(c.shape, x, 0.1);
            ASSERT_GT(found.count, 0) << c.name;
            for (std::size_t j = 0; j < static_cast<std::size_t>(found.count); ++j) {
                EXPECT_NEAR(found.item[j].normal.norm(), 1.0, 4e-16) << c.name << " " << x.transpose();
                EXPECT_TRUE(std::isfinite(found.item[j].gap)) << c.name;
            }
        }
    }
    // On an axis the normal is across it although round-off leaves a little of `x` along it.
    const WallContact on_axis = nearest(CylinderWall{p, axis, r, kForever, true}, p + 0.7 * axis, r);
    EXPECT_NEAR(on_axis.gap, 0.0, 1e-15);
    EXPECT_NEAR(on_axis.normal.dot(axis), 0.0, 1e-15);
    // On the disc's plane: its normal. On the surface of a cone: the side that it keeps bodies on.
    EXPECT_EQ(nearest(DiscWall{Vec3::Zero(), Vec3::UnitZ(), 1.0}, Vec3(0.5, 0, 0), 0.1).normal, Vec3::UnitZ());
    const ConeWall inside{Vec3::Zero(), Vec3::UnitZ(), 1.0, 1.0, 2.0, true};
    ConeWall outside = inside;
    outside.inside = false;
    EXPECT_EQ(nearest(inside, Vec3(1, 0, 1), 0.1).normal, Vec3(-1, 0, 0));
    EXPECT_EQ(nearest(outside, Vec3(1, 0, 1), 0.1).normal, Vec3(1, 0, 0));
    // In the middle of a cube all faces are as near: the first.
    EXPECT_EQ(nearest(BoxWall{Vec3(-1, -1, -1), Vec3(1, 1, 1), false, false, false}, Vec3::Zero(), 0.1).normal,
              Vec3(-1, 0, 0));
}

// A sphere wider than a hole rests on it: the contacts hold it up and hold it in place.
TEST(WallContact, SphereOverAHoleIsHeldAllRound) {
    const double radius = 0.5, hole = 0.3, height = std::sqrt(radius * radius - hole * hole);
    const Vec3 centre(0, 0, height);
    const struct {
        WallShape shape;
        int count;
    } cases[] = {{OrificeFloor{Vec3::Zero(), Vec3::UnitZ(), hole}, 3},
                 {SlotFloor{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 2 * hole, kForever}, 2},
                 {SlotFloor{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 2 * hole, 2 * hole}, 4},
                 {BoxWall{Vec3(-hole, -hole, -1), Vec3(hole, hole, 0), true, true, false}, 4},
                 {CylinderWall{Vec3(0, 0, -1), Vec3::UnitZ(), hole, 1.0, true}, 3}};
    for (const auto& c : cases) {
        const WallContacts found = contacts(c.shape, centre, radius, 1e-12);
        ASSERT_EQ(found.count, c.count);
        Vec3 sum = Vec3::Zero();
        for (std::size_t j = 0; j < static_cast<std::size_t>(found.count); ++j) {
            EXPECT_NEAR(found.item[j].gap, 0.0, 1e-15);
            EXPECT_NEAR(found.item[j].normal.z(), height / radius, 1e-15);
            sum += found.item[j].normal;
        }
        EXPECT_LT(sum.head<2>().norm(), 1e-14);
    }
    // In a funnel of half-angle 45 degrees, touching all round: d = height sin 45.
    const WallContacts funnel =
        contacts(ConeWall{Vec3::Zero(), Vec3::UnitZ(), 0.0, 2.0, 2.0, true}, Vec3::UnitZ(), std::sqrt(0.5), 1e-12);
    ASSERT_EQ(funnel.count, 3);
    EXPECT_NEAR(funnel.item[0].normal.z() + funnel.item[1].normal.z() + funnel.item[2].normal.z(), 3 * std::sqrt(0.5),
                1e-14);
}

TEST(WallContact, SmallSphereAtAHoleHasOneContact) {
    EXPECT_EQ(contacts(OrificeFloor{Vec3::Zero(), Vec3::UnitZ(), 1.0}, Vec3(0.95, 0, 0.05), 0.1, 0.01).count, 1);
    EXPECT_EQ(contacts(CylinderWall{Vec3::Zero(), Vec3::UnitZ(), 1.0, 2.0, true}, Vec3(0.91, 0, 1), 0.1, 0.01).count,
              1);
    EXPECT_EQ(contacts(OrificeFloor{Vec3::Zero(), Vec3::UnitZ(), 1.0}, Vec3(0, 0, 0), 0.1, 0.01).count, 0);
}

// No body that touches the wall lies out of its bounds, and bounds are not idle where the surface is bounded.
TEST(WallContact, BoundsHoldEverySurface) {
    for (const Case& c : all_cases(1.0)) {
        const WallBounds box = bounds(c.shape);
        for (std::uint64_t i = 0; i < 500; ++i) {
            Random random(23, 1, i);
            const Vec3 x = 2.0 * random_point(random, 1.0);
            const double radius = random.uniform(0.0, 0.5);
            const bool out =
                ((box.lower - x).array() > radius + 1e-12).any() || ((x - box.upper).array() > radius + 1e-12).any();
            if (!out) continue;
            EXPECT_GT(nearest(c.shape, x, radius).gap, 0.0) << c.name;
        }
    }
    const WallBounds disc = bounds(DiscWall{Vec3(1, 2, 3), Vec3::UnitZ(), 0.5});
    EXPECT_EQ(disc.lower, Vec3(0.5, 1.5, 3));
    EXPECT_EQ(disc.upper, Vec3(1.5, 2.5, 3));
    const WallBounds floor = bounds(PlaneWall{Vec3(1, 2, 3), Vec3::UnitZ()});
    EXPECT_EQ(floor.upper.z(), 3.0);
    EXPECT_EQ(floor.lower.z(), -kForever);
    EXPECT_EQ(floor.upper.x(), kForever);
}

TEST(WallContact, OnlyOneSidedWallsAreNotThin) {
    EXPECT_FALSE(is_thin(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}));
    EXPECT_FALSE(is_thin(BoxWall{-Vec3::Ones(), Vec3::Ones(), true, false, false}));
    EXPECT_TRUE(is_thin(BoxWall{-Vec3::Ones(), Vec3::Ones(), true, true, false}));
    EXPECT_FALSE(is_thin(CylinderWall{Vec3::Zero(), Vec3::UnitZ(), 1.0, kForever, true}));
    EXPECT_TRUE(is_thin(CylinderWall{Vec3::Zero(), Vec3::UnitZ(), 1.0, 1.0, true}));
    EXPECT_TRUE(is_thin(DiscWall{Vec3::Zero(), Vec3::UnitZ(), 1.0}));
}

}  // namespace
}  // namespace scree::contact
