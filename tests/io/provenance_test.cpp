#include "io/results/provenance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "io/hdf5/hdf5_file.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::MatchesRegex;

TEST(Provenance, SaysWhatTheProgramKnows) {
    ::setenv("SLURM_JOB_ID", "4711", 1);
    const Provenance p = sample_provenance();
    ::unsetenv("SLURM_JOB_ID");
    EXPECT_THAT(p.creator, MatchesRegex("scree [0-9]+\\.[0-9]+\\.[0-9]+"));
    EXPECT_THAT(p.run_id, MatchesRegex("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"));
    EXPECT_THAT(p.created_utc, MatchesRegex("20[0-9]{2}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z"));
    EXPECT_EQ(p.slurm_job_id, "4711");
    EXPECT_EQ(p.seed, 42U);
    EXPECT_NE(p.hostname, "");
    EXPECT_NE(sample_provenance().run_id, p.run_id);
    EXPECT_EQ(sample_provenance().slurm_job_id, "");
}

TEST(Provenance, AResumedRunNamesItsEarlierParts) {
    const Provenance first = sample_provenance();
    Provenance second = sample_provenance();
    continue_run(second, first);
    Provenance third = sample_provenance();
    continue_run(third, second);
    EXPECT_THAT(third.restart_of, ElementsAre(first.run_id, second.run_id));
}

TEST(Provenance, ComesBackFromAFileAndCanBeReplaced) {
    const TemporaryFolder folder;
    Provenance first = sample_provenance();
    Provenance second = sample_provenance();
    second.git_dirty = true;
    second.scenario_text = std::string(100000, 'x');
    continue_run(second, first);
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    write_provenance(file.root(), first);
    write_provenance(file.root(), second);
    const Provenance read = read_provenance(file.root());
    EXPECT_EQ(provenance_lines(read), provenance_lines(second));
    EXPECT_EQ(read.scenario_text, second.scenario_text);
    EXPECT_EQ(read.scenario_resolved, second.scenario_resolved);
    EXPECT_TRUE(read.git_dirty);
    EXPECT_THAT(read.restart_of, ElementsAre(first.run_id));
}

TEST(Provenance, LinesLeaveOutWhatIsUnknown) {
    std::map<std::string, std::string> lines;
    for (const auto& [name, value] : provenance_lines(sample_provenance())) lines[name] = value;
    EXPECT_EQ(lines.count("slurm_job_id"), 0U);
    EXPECT_EQ(lines["seed"], "42");
    EXPECT_THAT(lines["cgal_version"], ::testing::MatchesRegex("[0-9]+[.][0-9]+.*"));
    EXPECT_EQ(lines["command_line"], "scree run box.yaml");
}

}  // namespace
}  // namespace scree::io
