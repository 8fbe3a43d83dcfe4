// Rasters, runout and trajectories on ranks: bodies dealt out anyhow, ghosts among them, give the bits of one rank.
#include "solvers/rasters.hpp"

#include <gtest/gtest.h>

#include "core/parallel/sorted_slices.hpp"
#include "solvers/runout.hpp"
#include "solvers/trajectories.hpp"
#include "tests/mpi/dealt.hpp"

namespace scree::solvers {
namespace {

using testing::cloud;
using testing::Ghosts;
using testing::share;
using testing::SmallScene;
using testing::world;

// This rank's cells of values of all.
std::vector<double> own(const std::vector<double>& all, const RasterGrid& grid) {
    const Division rows{grid.rows, 1, world().size()};
    const auto at = [&](int rank) {
        return all.begin() + static_cast<std::ptrdiff_t>(rows.first(rank) * grid.columns);
    };
    return {at(world().rank()), at(world().rank() + 1)};
}

void expect_equal(const Vec3& a, const Vec3& b) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(a[k], b[k]);
}

TEST(RanksRasters, AreThoseOfOneRank) {
    for (const RasterGrid& grid : {RasterGrid{40, 37, -1.0, -0.9, 0.05, 0.05}, RasterGrid{1, 1, -1, -1, 2, 2},
                                   RasterGrid{300, 2, -1.0, -1.0, 0.0067, 1.0}}) {
        SmallScene w = cloud(400, 3);
        w.scene.rasters.emplace();
        w.scene.rasters->grid = grid;
        w.scene.rasters->covered = 1e-4;
        State one = w.state, many = w.state;
        Rasters alone(w.scene, Communicator::self()), shared(w.scene, world());
        std::vector<double> deposit, deposits;
        for (std::uint64_t step = 0; step < 4; ++step) {
            one.step = many.step = step;
            one.time = many.time = 0.1 * static_cast<double>(step);
            for (std::size_t i = 0; i < one.bodies.size(); ++i)
                one.bodies.position[i] += 0.02 * one.bodies.velocity[i].normalized();
            many.bodies = share(one.bodies, step, Ghosts::some);
            if (step == 0) {
                alone.start(w.scene, one);
                shared.start(w.scene, many);
            } else {
                alone.after_step(w.scene, one);
                shared.after_step(w.scene, many);
            }
        }
        EXPECT_EQ(many.rasters.depth, own(one.rasters.depth, grid));
        EXPECT_EQ(many.rasters.height, own(one.rasters.height, grid));
        EXPECT_EQ(many.rasters.speed, own(one.rasters.speed, grid));
        EXPECT_EQ(many.rasters.arrival, own(one.rasters.arrival, grid));
        expect_equal(many.rasters.top, one.rasters.top);
        expect_equal(many.rasters.centre, one.rasters.centre);
        deposit = alone.depth(w.scene, one), deposits = shared.depth(w.scene, many);
        EXPECT_EQ(deposits, own(deposit, grid));
        const Runout a = runout(w.scene, one, deposit, Communicator::self()),
                     b = runout(w.scene, many, deposits, world());
        EXPECT_GT(a.deposit_area, 0.0);
        expect_equal(a.toe, b.toe);
        expect_equal(a.centre_after, b.centre_after);
        EXPECT_EQ(a.length, b.length);
        EXPECT_EQ(a.fall_height, b.fall_height);
        EXPECT_EQ(a.deposit_volume, b.deposit_volume);
        EXPECT_EQ(a.deposit_most, b.deposit_most);
        EXPECT_EQ(a.flowed_area, b.flowed_area);
        EXPECT_EQ(a.released_volume, b.released_volume);
    }
}

TEST(RanksTrajectories, AreThoseOfOneRank) {
    const SmallScene w = cloud(97, 5);
    TrajectorySettings settings;
    settings.count = 10;
    State one = w.state, many = w.state;
    many.bodies = share(one.bodies, 4, Ghosts::some);
    one.followed = choose_followed(settings, one.bodies, Communicator::self());
    many.followed = choose_followed(settings, many.bodies, world());
    EXPECT_EQ(one.followed, many.followed);
    EXPECT_EQ(one.followed.size(), 10U);
    Plan plan;
    plan.spin = true;
    EXPECT_EQ(trajectory_row(w.scene, one, plan, Communicator::self()), trajectory_row(w.scene, many, plan, world()));
}

}  // namespace
}  // namespace scree::solvers
