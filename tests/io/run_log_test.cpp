#include "io/results/run_log.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;

std::vector<nlohmann::json> records(const std::string& path) {
    std::vector<nlohmann::json> all;
    std::istringstream lines(read_text(path));
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
}

TEST(RunLog, OneObjectALine) {
    const TemporaryFolder folder;
    const std::string path = folder / "run.jsonl";
    RunLog log(path, false);
    Provenance provenance = sample_provenance();
    provenance.command_line = "scree run b\xfcx.yaml";  // not UTF-8
    log.provenance(provenance);
    Progress progress;
    progress.time = 0.1;
    progress.contacts = 12;
    progress.wall_by_phase[2] = 1.5;
    log.progress(progress);
    log.status("complete", "", 0.2, 200, 0x00ff00000000abcdULL);
    // Each line is there at once: the log is still open.
    const std::vector<nlohmann::json> all = records(path);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0]["kind"], "provenance");
    EXPECT_EQ(all[0]["seed"], 42);
    EXPECT_EQ(all[0]["scenario_resolved"], provenance.scenario_resolved);
    EXPECT_EQ(all[1]["time"], 0.1);
    EXPECT_EQ(all[1]["contacts"], 12);
    EXPECT_EQ(all[1]["wall_by_phase"]["solve"], 1.5);
    EXPECT_EQ(all[2]["status"], "complete");
    EXPECT_EQ(all[2]["state_hash"], "00ff00000000abcd");
}

TEST(RunLog, AContinuedLogLosesTheHalfLineOfAKilledRun) {
    const TemporaryFolder folder;
    const std::string path = folder / "run.jsonl";
    std::ofstream(path) << "{\"kind\": \"progress\"}\n{\"kind\": \"prog";
    {
        RunLog log(path, true);
        log.status("stopped_early", "time limit", 0.0, 0, 0);
    }
    EXPECT_EQ(records(path).size(), 2U);
    EXPECT_EQ(records(path)[1]["reason"], "time limit");
    RunLog log(path, false);
    EXPECT_EQ(read_text(path), "");
}

TEST(RunLog, ErrorsAreIoErrors) {
    const TemporaryFolder folder;
    EXPECT_THROW(RunLog(folder / "none/run.jsonl", false), IoError);
    RunLog full("/dev/full", false);
    EXPECT_THROW(full.progress({}), IoError);
}

}  // namespace
}  // namespace scree::io
