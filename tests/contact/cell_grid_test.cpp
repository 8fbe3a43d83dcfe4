// The grid of cells against all pairs tried one by one.
#include "contact/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace scree::contact {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs all_pairs(const std::vector<Ball>& balls) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < balls.size(); ++i)
        for (std::uint32_t j = i + 1; j < balls.size(); ++j) {
            const Ball &a = balls[i], &b = balls[j];
            const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, reach = a.radius + b.radius;
            if (dx * dx + dy * dy + dz * dz <= reach * reach) pairs.emplace_back(i, j);
        }
    return pairs;
}

// Returns the number of pairs.
std::size_t expect_all_found(CellGrid& grid, const std::vector<Ball>& balls) {
    Pairs found;
    grid.find_pairs(balls, found);
    std::sort(found.begin(), found.end());
    const Pairs expected = all_pairs(balls);
    EXPECT_EQ(found, expected);
    return expected.size();
}

// Radii spread evenly in their logarithm over a ratio; `crowd` below 1 pulls the balls to the middle.
std::vector<Ball> random_balls(std::uint64_t seed, int count, double ratio, double box, double crowd,
                               const Vec3& centre) {
    Random random(seed, 1, 0);
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
        Vec3 x;
        for (int d = 0; d < 3; ++d) {
            const double u = random.uniform(-1.0, 1.0);
            x[d] = centre[d] + box * std::copysign(std::pow(std::abs(u), 1.0 / crowd), u);
        }
        balls.push_back({x.x(), x.y(), x.z(), 0.1 * std::pow(ratio, -random.uniform())});
    }
    return balls;
}

TEST(CellGrid, FindsWhatAllPairsFind) {
    CellGrid grid;  // the same one for all: nothing of the last scene may stay
    std::uint64_t seed = 0;
    for (const double ratio : {1.0, 1.9, 20.0, 100.0})
        for (const double crowd : {1.0, 0.3})
            for (const Vec3& centre : {Vec3(0, 0, 0), Vec3(-3.3, 7.7, -0.05), Vec3(-538500, 5576504, 2000)}) {
                const std::size_t pairs = expect_all_found(grid, random_balls(++seed, 250, ratio, 0.5, crowd, centre));
                EXPECT_GT(pairs, 20U);  // else the comparison says little
            }
}

// Balls taken out one after the other, each looking for its partners from elsewhere, and then called by other names.
TEST(CellGrid, PartnersOfBallsTakenOut) {
    for (const double ratio : {1.9, 100.0}) {
        std::vector<Ball> balls = random_balls(7, 250, ratio, 0.5, 0.3, Vec3(1, 2, 3));
        CellGrid grid;
        Pairs found;
        grid.find_pairs(balls, found);
        std::vector<std::uint32_t> name(balls.size());
        for (std::uint32_t i = 0; i < name.size(); ++i) name[i] = i % 3 == 0 ? CellGrid::kGone : 2 * i;
        std::vector<std::uint32_t> number(2 * balls.size(), CellGrid::kGone);  // whose name it is
        std::size_t seen = 0;
        for (const bool renamed : {false, true}) {
            if (renamed) grid.rename(name, number.size());
            for (std::uint32_t i = 0; i < balls.size(); ++i) {
                if (renamed && name[i] != CellGrid::kGone) number[name[i]] = i;
                if (!renamed) number[i] = i;
            }
            for (std::uint32_t called = renamed ? 250 : 0; called < (renamed ? 500 : 60); called += 2) {
                const std::uint32_t i = number[called];
                if (i == CellGrid::kGone || !grid.holds(called)) continue;
                grid.take_out(called);
                EXPECT_FALSE(grid.holds(called));
                const Ball& old = balls[i];
                // far beyond the grid, much wider than before, and a little to the side
                for (const Ball& ball : {Ball{old.x + 1e30, old.y, -1e30, old.radius}, Ball{old.x, old.y, old.z, 0.3},
                                         Ball{old.x + 0.02, old.y, old.z, old.radius}}) {
                    Pairs partners, expected;
                    grid.find_partners(called, ball, partners);
                    for (std::uint32_t k = 0; k < number.size(); ++k)
                        if (number[k] != CellGrid::kGone && grid.holds(k) && overlap(ball, balls[number[k]]))
                            expected.emplace_back(std::min(k, called), std::max(k, called));
                    std::sort(partners.begin(), partners.end());
                    std::sort(expected.begin(), expected.end());
                    EXPECT_EQ(partners, expected);
                    seen += expected.size();
                }
            }
            std::fill(number.begin(), number.end(), CellGrid::kGone);
        }
        EXPECT_GT(seen, 1000U);
    }
}

TEST(CellGrid, BallsOnTheBordersOfCells) {
    // A lattice of the cells' own width: every centre lies on a border, every neighbour just touches.
    std::vector<Ball> balls;
    for (int x = -3; x < 4; ++x)
        for (int y = -3; y < 4; ++y)
            for (int z = -3; z < 4; ++z) balls.push_back({0.5 * x, 0.5 * y, 0.5 * z, 0.25});
    CellGrid grid;
    EXPECT_EQ(expect_all_found(grid, balls), 3U * 6U * 7U * 7U);
    balls.push_back({0.25, 0.25, 0.25, 0.25 / 64});  // and one far smaller between them
    balls.push_back({0.0, 0.0, 0.0, 2.0});           // and one that holds them all
    expect_all_found(grid, balls);
}

TEST(CellGrid, CoincidentBallsAndNone) {
    CellGrid grid;
    EXPECT_EQ(expect_all_found(grid, std::vector<Ball>(5, Ball{1.0, -2.0, 3.0, 0.5})), 10U);
    EXPECT_EQ(expect_all_found(grid, {}), 0U);
    EXPECT_EQ(expect_all_found(grid, {{0, 0, 0, 1}}), 0U);
}

// Bodies that fell out of the scene: far away, but found if they meet.
TEST(CellGrid, SomeFarAway) {
    std::vector<Ball> balls = random_balls(50, 200, 5.0, 0.4, 1.0, Vec3(0, 0, 0));
    CellGrid grid;
    const std::size_t near = expect_all_found(grid, balls);
    for (const double far : {1e3, -1e9, 1e13}) {
        balls.push_back({0.0, 0.3, far, 0.1});
        balls.push_back({0.05, 0.3, far, 0.02});
    }
    EXPECT_EQ(expect_all_found(grid, balls), near + 3);
}

TEST(CellGrid, LengthsHaveNoScale) {
    const std::vector<Ball> balls = random_balls(99, 200, 20.0, 0.5, 0.5, Vec3(0.1, 0, 0));
    CellGrid grid;
    const std::size_t expected = all_pairs(balls).size();
    for (const double scale : {0x1p-60, 0x1p-20, 0x1p10, 0x1p60}) {  // powers of two: the same bits scaled
        std::vector<Ball> scaled = balls;
        for (Ball& b : scaled) b = {scale * b.x, scale * b.y, scale * b.z, scale * b.radius};
        EXPECT_EQ(expect_all_found(grid, scaled), expected);
    }
}

}  // namespace
}  // namespace scree::contact
