// What users do with the files: h5py and an XML reader, by read_files.py.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "io/results/checkpoint.hpp"
#include "io/results/history.hpp"
#include "io/results/snapshot.hpp"
#include "polyhedra.hpp"

namespace scree::io {
namespace {

using namespace testing;

constexpr const char* kPython = "/usr/bin/python3";

int run(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Files, AreReadByPython) {
    if (run(std::string(kPython) + " -c 'import h5py' 2>/dev/null") != 0) GTEST_SKIP() << "no h5py";
    const TemporaryFolder folder;
    const Scene scene = sample_scene();
    State state = sample_state(50);
    SnapshotSeries series(folder.path(), 0);
    series.write(scene, state, sample_contacts(), sample_provenance());
    State empty = sample_state(0);
    empty.snapshots_written = 1;
    empty.time = 0.5;
    series.write(scene, empty, {}, sample_provenance());
    HistoryWriter history = HistoryWriter::create(
        folder / "history.h5", {{"time", "s", "simulated time", 1}, {"bed.profile", "1", "packing", 3}},
        sample_provenance());
    for (int i = 0; i < 3000; ++i) {
        history.append({0.5 * i, 1.0, 2.0, 3.0});
        if (i % 1000 == 0) history.flush();
    }
    history.flush();
    write_checkpoint(folder / "checkpoint", state, sample_provenance());
    State rocks = polyhedra_state(20);
    SnapshotSeries(folder / "rocks", 0).write(scene, rocks, {}, sample_provenance());
    const std::string script = std::string(SCREE_TEST_FOLDER "/read_files.py");
    EXPECT_EQ(run(std::string(kPython) + " '" + script + "' '" + folder.path() + "'"), 0);
}

}  // namespace
}  // namespace scree::io
