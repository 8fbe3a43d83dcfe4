#include "solvers/trajectories.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/testing/small_scene.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;
using Ids = std::vector<std::uint64_t>;

SmallScene row_of(int bodies) {
    SmallScene w(0.1);
    for (int i = 0; i < bodies; ++i) w.add(Vec3(i, 2.0 * i, 0.0), 0.1, Vec3(0.0, 0.0, i));
    return w;
}

TEST(Trajectories, AreOfBodiesSpreadOverTheIds) {
    const SmallScene w = row_of(10);
    TrajectorySettings settings;
    const auto chosen = [&](std::uint64_t count) {
        settings.count = count;
        return choose_followed(settings, w.state.bodies, Communicator::self());
    };
    EXPECT_EQ(chosen(1), (Ids{5}));
    EXPECT_EQ(chosen(2), (Ids{2, 7}));
    EXPECT_EQ(chosen(5), (Ids{1, 3, 5, 7, 9}));
    EXPECT_EQ(chosen(99).size(), 10U);
    settings = {{4, 77}, 0, 1};
    EXPECT_EQ(choose_followed(settings, w.state.bodies, Communicator::self()), (Ids{4, 77}));
}

TEST(Trajectories, ARowHoldsWhatThePlanHas) {
    SmallScene w = row_of(5);
    w.scene.origin = Vec3(100.0, 0.0, 0.0);
    w.state.time = 0.5;
    w.state.followed = {3, 77};
    Plan plan;
    EXPECT_EQ(trajectory_columns(w.state, plan).size(), 5U);
    const std::vector<double> bare = trajectory_row(w.scene, w.state, plan, Communicator::self());
    ASSERT_EQ(bare.size(), 13U);
    EXPECT_EQ(std::vector<double>(bare.begin(), bare.begin() + 7), (std::vector<double>{0.5, 103, 6, 0, 0, 0, 3}));
    for (std::size_t k = 7; k < 13; ++k) EXPECT_TRUE(std::isnan(bare[k]));
    plan.spin = plan.orientation = true;
    w.state.bodies.spin.assign(5, Vec3(0.0, -0.0, 7.0));
    w.state.bodies.orientation.assign(5, Quat(0.5, -0.5, 0.5, 0.5));
    const std::vector<double> row = trajectory_row(w.scene, w.state, plan, Communicator::self());
    std::size_t width = 0;
    for (const HistoryColumn& column : trajectory_columns(w.state, plan))
        width += static_cast<std::size_t>(column.width);
    ASSERT_EQ(row.size(), width);
    EXPECT_EQ(std::vector<double>(row.begin() + 7, row.begin() + 14),
              (std::vector<double>{0, 0, 7, 0.5, -0.5, 0.5, 0.5}));
    EXPECT_TRUE(std::signbit(row[8]));  // to the bit
}

}  // namespace
}  // namespace scree::solvers
