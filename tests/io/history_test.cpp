#include "io/results/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>

#include "core/errors.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::vector<HistoryColumn> columns() {
    return {{"time", "s", "simulated time", 1},
            {"bed.profile", "1", "packing fraction", 3},
            {"wall_time", "s", "of the wall clock", 1}};
}

std::vector<double> row(double t) {
    return {t, 10 * t, 20 * t, 30 * t, 0.5};
}

TEST(History, RowsComeBackAfterAFlush) {
    const TemporaryFolder folder;
    HistoryWriter writer = HistoryWriter::create(folder / "history.h5", columns(), sample_provenance());
    EXPECT_EQ(read_history(folder / "history.h5").rows, 0U);
    writer.append(row(1));
    writer.append(row(2));
    EXPECT_EQ(writer.rows(), 2U);
    EXPECT_EQ(read_history(folder / "history.h5").rows, 0U);
    writer.flush();
    writer.append(row(3));
    writer.flush();
    const History history = read_history(folder / "history.h5");
    EXPECT_EQ(history.rows, 3U);
    EXPECT_EQ(history.columns[1].unit, "1");
    EXPECT_EQ(history.columns[1].width, 3);
    EXPECT_THAT(history.values[0], ElementsAre(1, 2, 3));
    EXPECT_THAT(history.values[1], ElementsAre(10, 20, 30, 20, 40, 60, 30, 60, 90));
    EXPECT_FALSE(fs::exists(folder / "history.h5.tmp"));
}

TEST(History, NoFlushBeforeItIsTime) {
    const TemporaryFolder folder;
    HistoryWriter writer = HistoryWriter::create(folder / "history.h5", columns(), {});
    writer.append(row(1));
    writer.flush_if_due();
    EXPECT_EQ(read_history(folder / "history.h5").rows, 0U);
}

TEST(History, ResumeCutsToTheRowsOfTheCheckpoint) {
    const TemporaryFolder folder;
    const std::string path = folder / "history.h5";
    {
        HistoryWriter writer = HistoryWriter::create(path, columns(), {});
        for (double t : {1.0, 2.0, 3.0}) writer.append(row(t));
        writer.flush();
    }
    HistoryWriter writer = HistoryWriter::resume(path, columns(), 2, {});
    EXPECT_EQ(writer.rows(), 2U);
    writer.append(row(4));
    writer.flush();
    EXPECT_THAT(read_history(path).values[0], ElementsAre(1, 2, 4));
}

TEST(History, ResumeRefusesWhatDoesNotFit) {
    const TemporaryFolder folder;
    const std::string path = folder / "history.h5";
    HistoryWriter::create(path, columns(), {});
    const auto message = [&](std::vector<HistoryColumn> asked, std::uint64_t rows) -> std::string {
        try {
            HistoryWriter::resume(path, std::move(asked), rows, {});
        } catch (const IoError& error) {
            return error.what();
        }
        return "no IoError";
    };
    EXPECT_THAT(message(columns(), 1), HasSubstr("it has 0 rows, the checkpoint needs 1"));
    EXPECT_THAT(message({columns()[0]}, 0), HasSubstr("it has 3 columns, the scenario asks for 1"));
    std::vector<HistoryColumn> other = columns();
    other[1].width = 4;
    EXPECT_THAT(message(other, 0), HasSubstr("column 2 is 'bed.profile' [1] of width 3"));
    other = columns();
    other[0].unit = "h";
    EXPECT_THAT(message(other, 0), HasSubstr("asks for 'time' [h]"));
    EXPECT_EQ(message(columns(), 0), "no IoError");
}

TEST(History, AFlushThatFailsLeavesTheFileWhole) {
    const TemporaryFolder folder;
    const std::string path = folder / "history.h5";
    HistoryWriter writer = HistoryWriter::create(path, columns(), {});
    writer.append(row(1));
    writer.flush();
    fs::create_directories(folder / "history.h5.tmp/blocked");  // nothing can be written under that name
    writer.append(row(2));
    EXPECT_THROW(writer.flush(), IoError);
    EXPECT_EQ(read_history(path).rows, 1U);
    fs::remove_all(folder / "history.h5.tmp");
    writer.flush();  // nothing was lost in memory
    EXPECT_THAT(read_history(path).values[0], ElementsAre(1, 2));
}

// A process that does nothing but append and flush is killed at any moment: what is on disk is whole, and its rows are
// the first ones.
TEST(History, SurvivesBeingKilledAtAnyInstant) {
    for (int kill_after_ms = 5; kill_after_ms <= 95; kill_after_ms += 10) {
        const TemporaryFolder folder;
        const std::string path = folder / "history.h5";
        HistoryWriter::create(path, columns(), {});
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            HistoryWriter writer = HistoryWriter::resume(path, columns(), 0, {});
            for (double t = 0.0;; t += 1.0) {
                writer.append(row(t));
                writer.flush();
            }
        }
        ::usleep(static_cast<useconds_t>(1000 * kill_after_ms));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const History history = read_history(path);
        for (std::size_t i = 0; i < history.rows; ++i) EXPECT_EQ(history.values[0][i], static_cast<double>(i));
    }
}

}  // namespace
}  // namespace scree::io
