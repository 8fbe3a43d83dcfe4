#include "io/results/snapshot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

TEST(Snapshot, HoldsWhatTheScenarioAsksFor) {
    const TemporaryFolder folder;
    const std::string path = folder / "000007.h5";
    write_snapshot(path, 7, sample_scene(), sample_state(3), sample_contacts(), sample_provenance());
    const Hdf5File file = Hdf5File::open(path);
    const Hdf5Group& root = file.root();
    check_format(root, "scree snapshot");
    EXPECT_EQ(root.number_attribute("time"), 0.25);
    EXPECT_EQ(root.integer_attribute("step"), 250U);
    EXPECT_EQ(root.text_attribute("title"), sample_scene().title);
    EXPECT_THAT(root.numbers_attribute("gravity"), ElementsAre(0.0, 0.0, -9.81));
    EXPECT_THAT(read_numbers(root, "bodies/id"), ElementsAre(0, 2, 4));
    // The scene's origin is added to positions, not to velocities.
    EXPECT_THAT(read_numbers(root, "bodies/position"), ElementsAre(100, 200, 300.5, 101, 202, 300.5, 102, 204, 300.5));
    EXPECT_THAT(read_numbers(root, "bodies/velocity"), ElementsAre(0, 0, 0, 0, 0, -1, 0, 0, -2));
    EXPECT_THAT(read_numbers(root, "bodies/orientation"), ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0));
    EXPECT_THAT(read_numbers(root, "bodies/material"), ElementsAre(0, 1, 0));
    EXPECT_THAT(read_texts(root, "materials/name"), ElementsAre("glass", "steel"));
    EXPECT_EQ(read_provenance(root).scenario_text, "title: box\n");
    for (const DatasetInfo& info : root.datasets()) EXPECT_NE(info.description, "") << info.name;
}

TEST(Snapshot, WallsAreDescribedAsTheyStand) {
    const TemporaryFolder folder;
    const std::string path = folder / "000000.h5";
    State state = sample_state(0);
    state.time = 0.75;
    write_snapshot(path, 0, sample_scene(), state, {}, {});
    const Hdf5File file = Hdf5File::open(path);
    EXPECT_THAT(read_texts(file.root(), "walls/name"), ElementsAre("floor", "drum"));
    EXPECT_THAT(read_texts(file.root(), "walls/shape"), ElementsAre("plane", "cylinder"));
    EXPECT_THAT(read_texts(file.root(), "walls/parameters")[1],
                HasSubstr(R"("axis":[0.0,1.0,0.0],"radius":0.5,"length":null,"inside":true)"));
    EXPECT_THAT(read_numbers(file.root(), "walls/present"), ElementsAre(1, 0));  // the drum went at 0.5 s
    const std::vector<double> rotation = read_numbers(file.root(), "walls/rotation");
    EXPECT_NEAR(rotation[9], std::cos(0.75), 1e-15);       // row 0, column 0 of the drum's
    EXPECT_NEAR(rotation[9 + 2], std::sin(0.75), 1e-15);   // row 0, column 2: about +y
    EXPECT_NEAR(rotation[9 + 6], -std::sin(0.75), 1e-15);  // row 2, column 0
    EXPECT_THAT(read_numbers(file.root(), "walls/translation"), ElementsAre(100, 200, 300, 100, 200, 300));
}

TEST(Snapshot, ContactsNameBodiesAndWalls) {
    const TemporaryFolder folder;
    const std::string path = folder / "000000.h5";
    write_snapshot(path, 0, sample_scene(), sample_state(2), sample_contacts(), {});
    const Hdf5File file = Hdf5File::open(path);
    EXPECT_THAT(read_numbers(file.root(), "contacts/id_a"), ElementsAre(0, 2));
    EXPECT_THAT(read_numbers(file.root(), "contacts/id_b"), ElementsAre(2, -2));
    EXPECT_THAT(read_numbers(file.root(), "contacts/point"), ElementsAre(101, 202, 303, 100, 200, 300));
    EXPECT_THAT(read_numbers(file.root(), "contacts/force"), ElementsAre(8, 0, 0, 0, 0, 4));
    EXPECT_THAT(read_numbers(file.root(), "contacts/status"), ElementsAre(2, 1));
}

TEST(Snapshot, NothingMoreThanAskedFor) {
    const TemporaryFolder folder;
    Scene scene = sample_scene();
    scene.output.fields = {"spin"};
    scene.output.contacts = false;
    State state = sample_state(2);
    state.bodies.spin.clear();  // a scene without friction
    write_snapshot(folder / "000000.h5", 0, scene, state, sample_contacts(), {});
    const Hdf5File file = Hdf5File::open(folder / "000000.h5");
    std::vector<std::string> names;
    for (const DatasetInfo& info : file.root().existing_group("bodies").datasets()) names.push_back(info.name);
    EXPECT_THAT(names, ElementsAre("id", "position", "radius"));
    EXPECT_FALSE(file.root().has("contacts"));
}

TEST(SnapshotSeries, NumbersFilesAndListsThem) {
    const TemporaryFolder folder;
    State state = sample_state(2);
    {
        SnapshotSeries series(folder.path(), 0);
        series.write(sample_scene(), state, {}, {});
        series.write(sample_scene(), state, {}, {});
        EXPECT_EQ(state.snapshots_written, 2U);
        EXPECT_EQ(series.files(), 2U);
        EXPECT_GT(series.bytes(), 1000U);
    }
    EXPECT_THAT(list_snapshots(folder.path()), ElementsAre(EndsWith("/000000.h5"), EndsWith("/000001.h5")));
    // Continued from a checkpoint between the two: the first is listed again, the second is written again.
    std::ofstream(folder / "snapshots/000009.h5.tmp") << "left by a killed run";
    state.snapshots_written = 1;
    state.time = 0.5;
    SnapshotSeries series(folder.path(), 1);
    EXPECT_FALSE(fs::exists(folder / "snapshots/000009.h5.tmp"));
    series.write(sample_scene(), state, {}, {});
    const std::string xdmf = read_text(folder / "run.xdmf");
    EXPECT_THAT(xdmf, HasSubstr("snapshots/000000.h5:/bodies/position"));
    EXPECT_THAT(xdmf, HasSubstr("snapshots/000001.h5:/bodies/velocity"));
    EXPECT_THAT(xdmf, HasSubstr("<Time Value=\"0.25\"/>"));
    EXPECT_THAT(xdmf, HasSubstr("<Time Value=\"0.5\"/>"));
    EXPECT_THAT(xdmf, Not(HasSubstr(folder.path())));
}

TEST(SnapshotSeries, AnUnwritableFolderIsAnError) {
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "x";
    EXPECT_THROW(SnapshotSeries(folder / "file", 0), IoError);
    EXPECT_THROW(write_snapshot(folder / "file/a.h5", 0, sample_scene(), sample_state(1), {}, {}), IoError);
}

}  // namespace
}  // namespace scree::io
