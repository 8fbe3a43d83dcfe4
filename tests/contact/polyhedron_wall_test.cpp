// Convex polyhedra in containers: against planes written out, and against the containers' own definition for points on
// the whole surface of the body, not only its vertices.
#include "contact/polyhedra/polyhedron_wall.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "contact/walls/wall_contact.hpp"
#include "tests/testing/slow_polyhedra.hpp"

namespace scree::contact {
namespace {

using testing::Body;

constexpr double kNever = 1e300;

WallPlaces places(const WallShape& wall, const Placed& body, double margin) {
    WallPlaces found;
    polyhedron_wall(wall, body, margin, found);
    return found;
}

double least_gap(const WallPlaces& found) {
    double least = kNever;
    for (const Manifold& m : found.places()) {
        for (const ManifoldPoint& p : m.points()) least = std::min(least, p.gap);
    }
    return least;
}

std::vector<ConvexShape> shapes() {
    Random random(51, 1, 0);
    return {testing::box_shape({1.0, 0.8, 0.5}), testing::tetrahedron_shape(1.0),
            testing::rock_shape(12, {0.6, 0.5, 0.4}, random), testing::rock_shape(30, {0.6, 0.5, 0.4}, random)};
}

struct Container {
    WallShape shape;
    Vec3 centre;  // bodies are put up to `room` away from it
    double room;
};

std::vector<Container> containers() {
    const Vec3 axis = Vec3(1, 2, 3).normalized(), other = Vec3(-2, 1, 0.5).normalized();
    return {{PlaneWall{{0.1, 0.2, 0.3}, axis}, {0.5, 0.9, 1.3}, 1.0},
            {BoxWall{{-1.5, -1.4, -1.3}, {1.5, 1.3, 1.4}, true, false, false}, {0, 0, 0}, 1.2},
            {BoxWall{{-1.5, -1.4, -1.3}, {1.5, 1.3, 9.0}, true, true, false}, {0, 0, 0}, 1.2},
            {CylinderWall{{0.3, -0.2, 0.1}, other, 1.5, kForever, true}, {0.3, -0.2, 0.1}, 1.2},
            {CylinderWall{-5.0 * axis, axis, 1.5, 10.0, true}, {0, 0, 0}, 1.2},
            {ConeWall{-5.0 * axis, axis, 3.0, 0.5, 10.0, true}, {0, 0, 0}, 0.8},
            {ConeWall{-5.0 * axis, axis, 0.0, 4.0, 10.0, true}, {0, 0, 0}, 0.8},
            {DiscWall{{0.1, 0.2, 0.3}, axis, 5.0}, {0.5, 0.9, 1.3}, 0.3}};
}

// No point of the body's surface comes nearer to the wall than the least gap says, and a point of it comes as near. The
// walls' own distance for spheres of no size is asked, which for bodies that reach through knows no depth: those only
// where walls are one-sided.
TEST(PolyhedronWall, NoPointOfTheBodyIsNearer) {
    int tested = 0;
    for (const Container& c : containers()) {
        ASSERT_NE(polyhedron_wall_cover(c.shape), WallCover::none);
        for (const ConvexShape& shape : shapes()) {
            for (std::uint64_t i = 0; i < 200; ++i) {
                Random random(51, 2, i);
                const Vec3 at = c.centre + random.uniform(0.0, c.room) * testing::random_direction(random);
                const Body body(shape, at, testing::random_turn(random));
                const double least = least_gap(places(c.shape, body, kNever));
                const bool one_sided = !is_thin(c.shape);
                if (!one_sided && least < 0.0) continue;
                ++tested;
                double nearest = kNever;
                const auto look = [&](const Vec3& x) {
                    WallContacts at_x;
                    find_contacts(c.shape, x, 0.0, kNever, at_x);
                    for (int k = 0; k < at_x.count; ++k) {
                        nearest = std::min(nearest, at_x.item[static_cast<std::size_t>(k)].gap);
                    }
                };
                for (std::size_t f = 0; f < shape.face.size(); ++f) {
                    const auto corners = shape.corners(f);
                    for (std::size_t k = 0; k < corners.size(); ++k) {
                        const Vec3 &p = body.placed.vertex[corners[0]], &q = body.placed.vertex[corners[k]],
                                   &r = body.placed.vertex[corners[(k + 1) % corners.size()]];
                        const double s = std::sqrt(random.uniform()), t = random.uniform();
                        for (const Vec3& x :
                             {q, Vec3(0.5 * (q + r)), Vec3((1.0 - s) * p + s * ((1.0 - t) * q + t * r))}) {
                            look(at + x);
                        }
                    }
                }
                ASSERT_NEAR(nearest, least, 1e-13) << c.shape.index() << " " << i;
            }
        }
    }
    EXPECT_GT(tested, 3000);
}

// d gap / dx = n at every point.
TEST(PolyhedronWall, NormalsAreGradients) {
    for (const Container& c : containers()) {
        for (const ConvexShape& shape : shapes()) {
            for (std::uint64_t i = 0; i < 50; ++i) {
                Random random(51, 3, i);
                const Vec3 at = c.centre + random.uniform(0.0, c.room) * testing::random_direction(random);
                const Quat turn = testing::random_turn(random);
                const Vec3 step = 1e-7 * testing::random_direction(random);
                const WallPlaces now = places(c.shape, Body(shape, at, turn), 0.3);
                const WallPlaces later = places(c.shape, Body(shape, at + step, turn), 0.31);
                for (const Manifold& m : now.places()) {
                    for (const ManifoldPoint& p : m.points()) {
                        ASSERT_NEAR(p.normal.norm(), 1.0, 1e-14);
                        if (p.gap > 0.2) continue;
                        for (const Manifold& l : later.places()) {
                            for (const ManifoldPoint& q : l.points()) {
                                if (q.key == p.key) {
                                    ASSERT_NEAR(q.gap - p.gap, p.normal.dot(step), 1e-12);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(PolyhedronWall, BoxOnAPlane) {
    const ConvexShape box = testing::box_shape({2.0, 1.0, 0.5});
    const PlaneWall plane{Vec3::Zero(), Vec3::UnitZ()};
    for (const double tilt : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
        const Body body(box, {3.0, 4.0, 0.25 - 1e-5}, Quat(Eigen::AngleAxisd(tilt, Vec3::UnitX())));
        const WallPlaces found = places(plane, body, 1e-2);
        ASSERT_EQ(found.count, 1);
        ASSERT_EQ(found.item[0].count, 4);
        EXPECT_NEAR(found.item[0].area, 2.0, 1e-5);
        for (const ManifoldPoint& p : found.item[0].points()) {
            EXPECT_NEAR(p.gap, -1e-5, 0.51 * tilt + 1e-15);
            EXPECT_NEAR(p.point.z(), 0.5 * p.gap, 1e-15);
            EXPECT_EQ(p.normal, Vec3::UnitZ());
        }
    }
    // on a vertex, on an edge, deep behind
    const Body on_edge(box, {0, 0, 0.5}, Quat(Eigen::AngleAxisd(0.4, Vec3::UnitX())));
    EXPECT_EQ(places(plane, on_edge, 0.1).item[0].count, 2);
    const Body on_vertex(box, {0, 0, 0.5}, Quat(Eigen::AngleAxisd(0.4, Vec3(1, 0.5, 0).normalized())));
    EXPECT_EQ(places(plane, on_vertex, -0.05).item[0].count, 1);
    const WallPlaces behind = places(plane, Body(box, {0, 0, -100.0}, Quat::Identity()), 0.0);
    EXPECT_EQ(behind.item[0].count, 4);  // the deeper of two vertices one above the other
    for (const ManifoldPoint& p : behind.item[0].points()) EXPECT_DOUBLE_EQ(p.gap, -100.25);
}

TEST(PolyhedronWall, CornerOfABoxHasThreePlaces) {
    const ConvexShape cube = testing::box_shape({1.0, 1.0, 1.0});
    const BoxWall wall{{0, 0, 0}, {3, 3, 3}, true, false, false};
    const WallPlaces found = places(wall, Body(cube, {0.5, 0.5, 0.5}, Quat::Identity()), 1e-3);
    ASSERT_EQ(found.count, 3);
    for (const Manifold& m : found.places()) {
        EXPECT_EQ(m.count, 4);
        EXPECT_DOUBLE_EQ(m.area, 1.0);
    }
    const WallPlaces jammed =
        places(BoxWall{{0, 0, 0}, {1, 1, 1}, true, false, false}, Body(cube, {0.5, 0.5, 0.5}, Quat::Identity()), 1e-12);
    EXPECT_EQ(jammed.count, 6);
}

TEST(PolyhedronWall, AlongAndOnTheAxisOfACylinder) {
    const ConvexShape box = testing::box_shape({1.0, 1.0, 4.0});
    const CylinderWall wall{Vec3::Zero(), Vec3::UnitZ(), std::sqrt(0.5), kForever, true};
    const WallPlaces found = places(wall, Body(box, {0, 0, 7.0}, Quat::Identity()), 1e-9);
    ASSERT_EQ(found.count, 1);
    EXPECT_EQ(found.item[0].count, 8);  // all corners, held all round
    Vec3 sum = Vec3::Zero();
    for (const ManifoldPoint& p : found.item[0].points()) {
        EXPECT_NEAR(p.gap, 0.0, 1e-15);
        sum += p.normal;
    }
    EXPECT_LT(sum.norm(), 1e-14);
    // a vertex on the axis has a normal all the same
    const ConvexShape tetrahedron = testing::tetrahedron_shape(1.0);
    const Vec3 vertex = tetrahedron.vertex[0];
    const WallPlaces wide = places(wall, Body(tetrahedron, -vertex, Quat::Identity()), kNever);
    for (const ManifoldPoint& p : wide.item[0].points()) EXPECT_NEAR(p.normal.norm(), 1.0, 1e-14);
}

TEST(PolyhedronWall, SaysWhatItDoesNotCover) {
    EXPECT_EQ(polyhedron_wall_cover(OrificeFloor{Vec3::Zero(), Vec3::UnitZ(), 1.0}), WallCover::none);
    EXPECT_EQ(polyhedron_wall_cover(SlotFloor{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 1.0, 1.0}), WallCover::none);
    EXPECT_EQ(polyhedron_wall_cover(BoxWall{{0, 0, 0}, {1, 1, 1}, false, false, false}), WallCover::exact);
    EXPECT_EQ(polyhedron_wall_cover(CylinderWall{Vec3::Zero(), Vec3::UnitZ(), 1.0, 1.0, false}), WallCover::none);
    EXPECT_EQ(polyhedron_wall_cover(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}), WallCover::exact);
}

}  // namespace
}  // namespace scree::contact
