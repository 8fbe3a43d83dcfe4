// Bodies that fill a box: Voronoi cells and blocks between joints.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/exact_sum.hpp"
#include "core/make_shape.hpp"
#include "core/random.hpp"
#include "core/volume_integrals.hpp"
#include "scenarios/shapes/rock_mass.hpp"
#include "scenarios/shapes/solids.hpp"
#include "scenarios/shapes/voronoi.hpp"

namespace scree::scenarios {
namespace {

std::vector<Vec3> random_seeds(std::uint64_t seed, int count, const Vec3& lower, const Vec3& upper) {
    std::vector<Vec3> seeds;
    for (int k = 0; k < count; ++k) {
        Random random(seed, 1, static_cast<std::uint64_t>(k));
        Vec3& x = seeds.emplace_back();
        for (int i = 0; i < 3; ++i) x[i] = random.uniform(lower[i], upper[i]);
    }
    return seeds;
}

TEST(Voronoi, CellsFillTheBoxAndAreNearestToTheirSeeds) {
    const Vec3 lower(1.0, 2.0, 3.0), upper(3.0, 5.0, 4.0);
    for (const int count : {1, 2, 3, 10, 400}) {
        const auto seeds = random_seeds(5, count, lower, upper);
        const auto cells = voronoi_cells(box_between(lower, upper), seeds);
        ASSERT_EQ(cells.size(), seeds.size());
        ExactSum raw, shapes;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            raw.add(volume_integrals(cells[k]).volume);
            const PlacedShape placed = make_shape(cells[k]);
            shapes.add(placed.shape.volume);
            // the cell is that of its seed: no corner is nearer to another one
            for (const Vec3& x : polyhedron_of(placed).vertex)
                for (const Vec3& other : seeds) EXPECT_GE((x - other).norm(), (x - seeds[k]).norm() - 1e-12);
        }
        EXPECT_NEAR(raw.value() / 6.0, 1.0, 1e-13);
        EXPECT_NEAR(shapes.value() / 6.0, 1.0, 1e-12);
    }
}

// Seeds of a cubic and a body-centred lattice: cubes, and Kelvin's truncated octahedra with 8 hexagons and 6 squares.
TEST(Voronoi, LatticesGiveTheirKnownCells) {
    std::vector<Vec3> cubic, centred;
    for (int k = 0; k < 125; ++k) {
        const Vec3 x(0.5 + k % 5, 0.5 + k / 5 % 5, 0.5 + k / 25);
        cubic.push_back(x);
        centred.push_back(x);
        if ((x.array() < 4.0).all()) centred.push_back(x + Vec3(0.5, 0.5, 0.5));
    }
    const Polyhedron box = box_between(Vec3::Zero(), Vec3(5, 5, 5));
    for (const Polyhedron& cell : voronoi_cells(box, cubic)) {
        const auto shape = make_shape(cell).shape;
        EXPECT_EQ(shape.face.size(), 6U);
        EXPECT_EQ(shape.vertex.size(), 8U);
        EXPECT_NEAR(shape.volume, 1.0, 1e-13);
    }
    const auto cells = voronoi_cells(box, centred);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if ((centred[k].array() < 1.2).any() || (centred[k].array() > 3.8).any()) continue;
        const auto shape = make_shape(cells[k]).shape;
        EXPECT_EQ(shape.face.size(), 14U);
        EXPECT_EQ(shape.vertex.size(), 24U);
        EXPECT_NEAR(shape.volume, 0.5, 1e-13);
    }
}

// Four planes and more that nearly meet in one point, at every scale from round-off to visible: short edges and thin
// faces of every size. Cells are bodies all the same; what vanishes of them (up to 1e-9 of their size) is missing in
// the sum.
TEST(Voronoi, NearlyRegularLatticesMakeBodies) {
    double jitter = 1e-17;
    for (std::uint64_t k = 0; k < 46; ++k, jitter *= 2.1) {
        std::vector<Vec3> seeds;
        Random random(8, 8, k);
        for (int i = 0; i < 27; ++i) {
            Vec3 x(0.5 + i % 3, 0.5 + i / 3 % 3, 0.5 + i / 9);
            for (int c = 0; c < 3; ++c) x[c] += jitter * random.uniform(-1.0, 1.0);
            seeds.push_back(x);
            if (k % 2 == 1 && (x.array() < 2.0).all()) seeds.push_back(x + Vec3(0.5, 0.5, 0.5));
        }
        ExactSum sum;
        for (const Polyhedron& cell : voronoi_cells(box_between(Vec3::Zero(), Vec3(3, 3, 3)), seeds))
            sum.add(make_shape(cell).shape.volume);
        EXPECT_NEAR(sum.value() / 27.0, 1.0, 1e-9) << jitter;
    }
}

TEST(Voronoi, RefusesSeedsThatHaveNoCell) {
    const Polyhedron box = box_between(Vec3::Zero(), Vec3(1, 1, 1));
    EXPECT_THROW(voronoi_cells(box, {{0.5, 0.5, 0.5}, {0.5, 0.5, 1.5}}), ShapeError);
    EXPECT_THROW(voronoi_cells(box, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}), ShapeError);
    EXPECT_THROW(voronoi_cells(box, {{0.5, std::nan(""), 0.5}}), ShapeError);
    EXPECT_TRUE(voronoi_cells(box, {}).empty());
}

double sum_of(const RockMass& mass) {
    ExactSum sum;
    for (const PlacedShape& block : mass.blocks) sum.add(block.shape.volume);
    return sum.value();
}

TEST(RockMass, DipAndDipDirection) {
    using std::numbers::pi;
    EXPECT_LT((upward_normal(pi / 4, pi / 2) - Vec3(1, 0, 1).normalized()).norm(), 1e-15);  // dips to the east
    EXPECT_LT((upward_normal(pi / 2, 0.0) - Vec3(0, 1, 0)).norm(), 1e-15);
    EXPECT_LT((upward_normal(0.0, 1.0) - Vec3(0, 0, 1)).norm(), 1e-15);
}

// Three sets at right angles without scatter: inner blocks are boxes with the spacings as sides.
TEST(RockMass, SetsAtRightAnglesMakeBoxes) {
    using std::numbers::pi;
    const Polyhedron body = box_between(Vec3::Zero(), Vec3(10, 10, 10));
    const auto mass = cut_rock_mass(
        body, {{0.0, 0.0, 1.0, 0.0, 0.0}, {pi / 2, 0.0, 2.0, 0.0, 0.0}, {pi / 2, pi / 2, 2.5, 0.0, 0.0}}, 1);
    EXPECT_EQ(mass.slivers, 0U);
    EXPECT_EQ(mass.blocks.size(),
              11U * 6U * 5U);  // spacings of 1, 2 and 2.5 with an offset leave two cut-off boxes, or one
    std::size_t inner = 0;
    for (const PlacedShape& block : mass.blocks) {
        EXPECT_EQ(block.shape.face.size(), 6U);
        if (std::abs(block.shape.volume - 5.0) < 1e-10) ++inner;
    }
    EXPECT_EQ(inner, 9U * 4U * 3U);
    EXPECT_NEAR(sum_of(mass) / mass.volume, 1.0, 1e-13);
}

TEST(RockMass, ScatteredJointsFillTheMass) {
    const Polyhedron body = box_between(Vec3(-50, -30, 0), Vec3(50, 30, 40));
    const std::vector<JointSet> sets = {
        {0.3, 1.0, 6.0, 0.4, 0.05}, {1.2, 2.5, 8.0, 0.6, 0.1}, {1.4, 4.4, 7.0, 0.3, 0.08}};
    const auto mass = cut_rock_mass(body, sets, 7);
    EXPECT_GT(mass.blocks.size(), 800U);
    EXPECT_NEAR((sum_of(mass) + mass.lost) / mass.volume, 1.0, 1e-12);
    EXPECT_LT(mass.lost, 1e-9 * mass.volume);
    const auto again = cut_rock_mass(body, sets, 7), other = cut_rock_mass(body, sets, 8);
    ASSERT_EQ(again.blocks.size(), mass.blocks.size());
    EXPECT_TRUE(again.blocks.back().shape.vertex == mass.blocks.back().shape.vertex);
    EXPECT_NE(other.blocks.back().shape.volume, mass.blocks.back().shape.volume);
}

TEST(RockMass, MeanSpacingIsTheOneAskedFor) {
    const Polyhedron body = box_between(Vec3(0, 0, 0), Vec3(1, 1, 1000));
    const auto mass = cut_rock_mass(body, {{0.0, 0.0, 2.0, 0.9, 0.0}}, 3);
    EXPECT_NEAR(1000.0 / static_cast<double>(mass.blocks.size()), 2.0,
                0.2);  // 500 joints with 0.52 of deviation: 2.3 %, four times
}

TEST(RockMass, RefusesWhatIsNoJointSet) {
    const Polyhedron body = box_between(Vec3::Zero(), Vec3(1, 1, 1));
    for (const JointSet& bad : {JointSet{2.0, 0, 1, 0, 0}, JointSet{0.1, NAN, 1, 0, 0}, JointSet{0.1, 0, 0, 0, 0},
                                JointSet{0.1, 0, 1, 1, 0}, JointSet{0.1, 0, 1, 0, -1}, JointSet{0.1, 0, 1e-9, 0, 0}})
        EXPECT_THROW(cut_rock_mass(body, {bad}, 1, 1000), ShapeError);
    EXPECT_THROW(cut_rock_mass(body, {{0.0, 0.0, 0.01, 0, 0}}, 1, 50), ShapeError);
    EXPECT_EQ(cut_rock_mass(body, {}, 1).blocks.size(), 1U);
}

}  // namespace
}  // namespace scree::scenarios
