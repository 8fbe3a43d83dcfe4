// Volumes of cut spheres: closed forms, sums of parts, and random points.
#include "solvers/measure_overlap.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/random.hpp"

namespace scree::solvers {
namespace {

using std::numbers::pi;
const double kBall = 4.0 / 3.0 * pi;

BoxRegion box(const Vec3& lower, const Vec3& upper) {
    return {lower, upper};
}

TEST(MeasureOverlap, SphereOutOfInAndHalfInABox) {
    const BoxRegion region = box(Vec3::Zero(), Vec3(10, 10, 10));
    EXPECT_DOUBLE_EQ(overlap_volume(region, Vec3(5, 5, 5), 1.0), kBall);
    EXPECT_EQ(overlap_volume(region, Vec3(-1.1, 5, 5), 1.0), 0.0);
    EXPECT_NEAR(overlap_volume(region, Vec3(-0.8, -0.8, 5), 1.0), 0.0, 1e-14);  // near an edge that it does not reach
    EXPECT_NEAR(overlap_volume(region, Vec3(0, 5, 5), 1.0), kBall / 2, 1e-14);
    EXPECT_NEAR(overlap_volume(region, Vec3(0, 10, 5), 1.0), kBall / 4, 1e-13);
    EXPECT_NEAR(overlap_volume(region, Vec3(0, 10, 0), 1.0), kBall / 8, 1e-13);
    const double k = 0.3;
    EXPECT_NEAR(overlap_volume(region, Vec3(5, 5, -0.7), 1.0), pi * k * k * (3 - k) / 3, 1e-15);
    // A box inside the sphere, and one that holds the sphere's waist.
    EXPECT_NEAR(overlap_volume(box(Vec3(-.1, -.2, -.3), Vec3(.3, .2, .1)), Vec3::Zero(), 1.0), 0.4 * 0.4 * 0.4, 1e-13);
}

// Three planes through a sphere cut it into eight; the parts make the whole, and each is right on its own: a wedge
// between planes through the axis is half of its angle.
TEST(MeasureOverlap, EightPartsMakeTheWhole) {
    for (std::uint64_t i = 0; i < 300; ++i) {
        Random random(3, 0, i);
        const Vec3 cut(random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1));
        double sum = 0.0;
        for (int part = 0; part < 8; ++part) {
            Vec3 lower = Vec3::Constant(-2), upper = Vec3::Constant(2);
            for (int k = 0; k < 3; ++k) ((part >> k) & 1 ? lower : upper)[k] = cut[k];
            sum += overlap_volume(box(lower, upper), Vec3::Zero(), 1.0);
        }
        ASSERT_NEAR(sum / kBall, 1.0, 1e-12) << cut.transpose();
    }
}

// The corner x, y, z >= a, b, c by Gauss and Bonnet: 3 V = S - a A_a - b A_b - c A_c, where the sphere's patch S has
// 2 pi - sum of exterior angles - sum of the arcs' curvatures (a times the arc's angle).
double corner_volume(const Vec3& c) {
    double curvature = 0.0, angles = 0.0, faces = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double a = c[i], p = c[(i + 1) % 3], q = c[(i + 2) % 3];
        const double rho = std::sqrt(1 - a * a);
        curvature += a * (std::acos(p / rho) + std::acos(q / rho) - pi / 2);
        faces += a * quadrant_area(rho, p, q);
        // The exterior angle where the planes of p and q meet on the sphere.
        angles += std::acos(-p * q / std::sqrt((1 - p * p) * (1 - q * q)));
    }
    return (2 * pi - angles - curvature - faces) / 3;
}

TEST(MeasureOverlap, CornersByGaussAndBonnet) {
    for (std::uint64_t i = 0; i < 300; ++i) {
        Random random(5, 0, i);
        const Vec3 c(random.uniform(-0.5, 0.55), random.uniform(-0.5, 0.55), random.uniform(-0.5, 0.55));
        ASSERT_NEAR(overlap_volume(box(c, Vec3::Constant(5)), Vec3::Zero(), 1.0), corner_volume(c), 1e-12)
            << c.transpose();
    }
    EXPECT_NEAR(corner_volume(Vec3::Zero()), kBall / 8, 1e-15);
}

TEST(MeasureOverlap, CylinderAgainstClosedForms) {
    const CylinderRegion tall{Vec3(0, 0, -5), Vec3::UnitZ(), 0.6, 10.0};
    // A hole drilled through the middle leaves a ring of volume pi/6 H^3, H its height.
    const double height = 2 * std::sqrt(1 - 0.36);
    EXPECT_NEAR(overlap_volume(tall, Vec3::Zero(), 1.0), kBall - pi / 6 * height * height * height, 1e-13);
    // Viviani: a cylinder of half the radius through the centre and the edge.
    const CylinderRegion viviani{Vec3(0.5, 0, -5), Vec3::UnitZ(), 0.5, 10.0};
    EXPECT_NEAR(overlap_volume(viviani, Vec3::Zero(), 1.0), 2 * pi / 3 - 8.0 / 9, 1e-12);
    // Wholly inside, outside, cut by an end.
    const CylinderRegion wide{Vec3::Zero(), Vec3::UnitZ(), 5.0, 10.0};
    EXPECT_DOUBLE_EQ(overlap_volume(wide, Vec3(1, 1, 5), 1.0), kBall);
    EXPECT_EQ(overlap_volume(wide, Vec3(6.01, 0, 5), 1.0), 0.0);
    EXPECT_NEAR(overlap_volume(wide, Vec3(1, 1, 10), 1.0), kBall / 2, 1e-14);
    // A very wide cylinder is a plane.
    const CylinderRegion plane{Vec3(-1e6, 0, -5), Vec3::UnitZ(), 1e6, 10.0};
    EXPECT_NEAR(overlap_volume(plane, Vec3(0.25, 0, 0), 1.0), slab_volume(1.0, 0.25, 1.0), 1e-6);
}

TEST(MeasureOverlap, SpheresAndHalfSpaces) {
    const SphereRegion region{Vec3::Zero(), 2.0};
    EXPECT_EQ(overlap_volume(region, Vec3(3.01, 0, 0), 1.0), 0.0);
    EXPECT_DOUBLE_EQ(overlap_volume(region, Vec3(0.9, 0, 0), 1.0), kBall);
    EXPECT_DOUBLE_EQ(overlap_volume(region, Vec3::Zero(), 3.0), 8 * kBall);
    const SphereRegion same{Vec3::Zero(), 1.0};
    EXPECT_NEAR(overlap_volume(same, Vec3(1, 0, 0), 1.0), 5 * pi / 12, 1e-15);
    const Vec3 n = Vec3(1, 2, -2) / 3;
    EXPECT_NEAR(overlap_volume(HalfSpaceRegion{Vec3(1, 1, 1), n}, Vec3(1, 1, 1) + 0.5 * n, 1.0), slab_volume(1, 0.5, 1),
                1e-15);
}

TEST(MeasureOverlap, RandomPoints) {
    const Region regions[] = {box(Vec3(-.5, -.2, -.7), Vec3(.4, .9, .3)),
                              CylinderRegion{Vec3(0.3, 0.1, -0.4), Vec3(1, 1, 1).normalized(), 0.7, 0.9}};
    for (const Region& region : regions) {
        std::uint64_t hits = 0, in_ball = 0;
        for (std::uint64_t i = 0; in_ball < 200000; ++i) {
            Random random(9, 0, i);
            const Vec3 x(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            if (x.squaredNorm() > 1.0) continue;
            ++in_ball;
            hits += contains(region, x);
        }
        const double share = static_cast<double>(hits) / static_cast<double>(in_ball);
        EXPECT_NEAR(overlap_volume(region, Vec3::Zero(), 1.0) / kBall, share, 4 * 0.5 / std::sqrt(200000.0));
    }
}

TEST(MeasureOverlap, LengthsHaveNoScale) {
    const Vec3 lower(-.5, -.2, -.7), upper(.4, .9, .3);
    const double one = overlap_volume(box(lower, upper), Vec3(0.1, 0, 0), 1.0);
    for (double s : {1e-6, 1e3}) {
        EXPECT_NEAR(overlap_volume(box(s * lower, s * upper), s * Vec3(0.1, 0, 0), s) / (s * s * s) / one, 1.0, 1e-13);
    }
}

}  // namespace
}  // namespace scree::solvers
