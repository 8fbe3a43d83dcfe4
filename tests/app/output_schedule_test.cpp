#include "app/output_schedule.hpp"

#include <gtest/gtest.h>

namespace scree::app {
namespace {

OutputSchedule schedule(double end, double step, double snapshots, double history) {
    TimeSettings time;
    time.end = end;
    time.step = step;
    OutputSettings output;
    output.snapshot_interval = snapshots;
    output.history_interval = history;
    return {time, output};
}

TEST(OutputSchedule, RatiosThatAreNotExactInBinaryAreWhole) {
    EXPECT_EQ(steps_until(0.3, 0.1), 3U);  // 0.3 / 0.1 = 2.9999999999999996
    EXPECT_EQ(steps_until(1.2, 1e-3), 1200U);
    EXPECT_EQ(steps_until(3600.0, 1e-4), 36000000U);
}

TEST(OutputSchedule, AnEndBetweenStepsIsReached) {
    EXPECT_EQ(steps_until(1.05, 0.1), 11U);
    EXPECT_EQ(steps_until(0.01, 0.1), 1U);
}

TEST(OutputSchedule, FirstAndLastAreAlwaysDue) {
    const OutputSchedule s = schedule(1.0, 0.1, 0.0, 0.36);
    EXPECT_EQ(s.history_every, 4U);  // nearest to 3.6
    EXPECT_TRUE(s.snapshot_due(0));
    EXPECT_FALSE(s.snapshot_due(5));
    EXPECT_TRUE(s.snapshot_due(10));
    EXPECT_TRUE(s.history_due(8));
    EXPECT_FALSE(s.history_due(9));
    EXPECT_TRUE(s.history_due(10));
}

TEST(OutputSchedule, CountsAreThoseOfTheSteps) {
    for (const auto& s : {schedule(1.0, 0.1, 0.2, 0.0), schedule(1.0, 0.1, 0.3, 0.3), schedule(1.0, 0.1, 0.0, 5.0),
                          schedule(0.1, 0.1, 0.0, 0.0), schedule(1.0, 0.1, 0.01, 0.01)}) {
        std::uint64_t snapshots = 0, rows = 0;
        for (std::uint64_t step = 0; step <= s.steps; ++step) {
            snapshots += s.snapshot_due(step) ? 1 : 0;
            rows += s.history_due(step) ? 1 : 0;
        }
        EXPECT_EQ(s.snapshots(), snapshots);
        EXPECT_EQ(s.history_rows(), rows);
    }
}

}  // namespace
}  // namespace scree::app
