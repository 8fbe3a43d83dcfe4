#include "io/results/info.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/history.hpp"
#include "io/results/snapshot.hpp"
#include "io/results/summary.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Info, ASnapshot) {
    const TemporaryFolder folder;
    write_snapshot(folder / "a.h5", 0, sample_scene(), sample_state(3), sample_contacts(), sample_provenance());
    const std::string text = info(folder / "a.h5");
    EXPECT_THAT(text, AllOf(HasSubstr("scree snapshot"), HasSubstr("time        0.25 s"), HasSubstr("step        250"),
                            HasSubstr("bodies      3"), HasSubstr("glass, steel"), HasSubstr("scree run box.yaml")));
    EXPECT_THAT(text, ContainsRegex("bodies/velocity +3 x 3 +0, 0, -2 .. 0 m/s"));
}

TEST(Info, ACheckpoint) {
    const TemporaryFolder folder;
    const std::string path = write_checkpoint(folder.path(), sample_state(3), sample_provenance());
    EXPECT_THAT(info(path),
                AllOf(HasSubstr("scree checkpoint"), HasSubstr("checksum    good"), HasSubstr("bodies      3")));
    fs::resize_file(path, fs::file_size(path) - 1);
    EXPECT_THROW(info(path), IoError);
}

TEST(Info, ARunFolderWithAllThatIsInIt) {
    const TemporaryFolder folder;
    State state = sample_state(2);
    SnapshotSeries(folder.path(), 0).write(sample_scene(), state, {}, {});
    HistoryWriter history = HistoryWriter::create(folder / "history.h5", {{"time", "s", "t", 1}}, {});
    history.append({1.5});
    history.flush();
    write_checkpoint(folder / "checkpoint", state, {});
    Summary summary = summarise(sample_scene(), Plan{}, state);
    summary.status = "complete";
    write_summary(folder / "summary.yaml", summary);
    EXPECT_THAT(info(folder.path()),
                AllOf(HasSubstr("snapshots   1, from 0.25 s to 0.25 s"), HasSubstr("1 columns, 1 rows"),
                      HasSubstr("step_0000000250.h5"), HasSubstr("status: complete")));
    EXPECT_THAT(info(folder / "summary.yaml"), HasSubstr("state_hash: "));
    EXPECT_THAT(info(folder / "history.h5"), ContainsRegex("history/time +1 +1.5 s"));
}

TEST(Info, AnythingElseIsAnError) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.yaml") << "title: no summary\n";
    std::ofstream(folder / "b.yaml") << "a: [";
    std::ofstream(folder / "c.h5") << "x";
    for (const char* name : {"a.yaml", "b.yaml", "c.h5", "none", ""}) {
        EXPECT_THROW(info(folder / name), IoError) << name;
    }
}

}  // namespace
}  // namespace scree::io
