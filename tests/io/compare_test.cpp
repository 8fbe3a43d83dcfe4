#include "io/results/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/history.hpp"
#include "io/results/snapshot.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Compare : public ::testing::Test {
  protected:
    std::string snapshot(const std::string& name, const State& state, bool contacts = true) {
        write_snapshot(folder_ / name, 0, sample_scene(), state,
                       contacts ? sample_contacts() : decltype(sample_contacts()){}, sample_provenance());
        return folder_ / name;
    }
    static const Difference& of(const Comparison& c, const std::string& dataset) {
        for (const Difference& d : c.differences) {
            if (d.dataset == dataset) return d;
        }
        throw std::runtime_error("no dataset " + dataset);
    }
    TemporaryFolder folder_;
};

TEST_F(Compare, EqualSnapshotsAreIdentical) {
    const Comparison c = compare(snapshot("a.h5", sample_state(5)), snapshot("b.h5", sample_state(5)));
    EXPECT_TRUE(c.identical);
    EXPECT_TRUE(c.within);
    EXPECT_GT(c.differences.size(), 15U);
    EXPECT_THAT(to_text(c), HasSubstr("Identical."));
}

TEST_F(Compare, DifferencesAreMeasured) {
    State other = sample_state(5);
    other.bodies.velocity[4].z() += 0.5;  // the largest speed is 4
    const std::string a = snapshot("a.h5", sample_state(5)), b = snapshot("b.h5", other);
    const Comparison c = compare(a, b, 0.1);
    EXPECT_FALSE(c.identical);
    EXPECT_FALSE(c.within);
    const Difference& d = of(c, "bodies/velocity");
    EXPECT_EQ(d.compared, 15U);
    EXPECT_EQ(d.different, 1U);
    EXPECT_EQ(d.max_absolute, 0.5);
    EXPECT_EQ(d.max_relative, 0.125);
    EXPECT_TRUE(of(c, "bodies/position").identical);
    EXPECT_TRUE(compare(a, b, 0.125).within);
    EXPECT_THAT(to_text(c), HasSubstr("bodies/velocity: 1 of 15 numbers differ, by 0.5 m/s at most"));
}

TEST_F(Compare, ASignOfZeroIsADifferenceToTheBitOnly) {
    State other = sample_state(2);
    other.bodies.velocity[0].x() = -0.0;
    const Comparison c = compare(snapshot("a.h5", sample_state(2)), snapshot("b.h5", other));
    EXPECT_FALSE(c.identical);
    EXPECT_TRUE(c.within);
}

TEST_F(Compare, BodiesAreMatchedById) {
    State other = sample_state(5);
    for (auto* list : {&other.bodies.position, &other.bodies.velocity, &other.bodies.spin})
        list->erase(list->begin() + 1);
    other.bodies.id.erase(other.bodies.id.begin() + 1);
    other.bodies.radius.pop_back();
    other.bodies.mass.pop_back();
    other.bodies.material = {MaterialIndex{0}, MaterialIndex{0}, MaterialIndex{1}, MaterialIndex{0}};
    other.bodies.orientation.pop_back();
    const Comparison c = compare(snapshot("a.h5", sample_state(5)), snapshot("b.h5", other));
    EXPECT_FALSE(c.identical);
    EXPECT_FALSE(c.within);
    EXPECT_THAT(c.only_in_a, ElementsAre(2));
    EXPECT_THAT(c.only_in_b, IsEmpty());
    EXPECT_EQ(of(c, "bodies/position").different, 0U);
    EXPECT_EQ(of(c, "bodies/position").compared, 12U);
    EXPECT_THAT(to_text(c), HasSubstr("bodies only in the first: 2"));
}

TEST_F(Compare, OtherNumbersOfContactsAreTold) {
    const Comparison c = compare(snapshot("a.h5", sample_state(2)), snapshot("b.h5", sample_state(2), false));
    EXPECT_FALSE(c.within);
    EXPECT_EQ(of(c, "contacts/gap").note, "2 rows in the first, 0 in the second");
}

TEST_F(Compare, CheckpointsWithoutTheWallClock) {
    State state = random_state(3, 20, true, false);
    const std::string a = write_checkpoint(folder_ / "a", state, sample_provenance());
    state.totals.wall_time = 1.0;
    state.totals.wall_by_phase[0] = 1.0;
    const std::string b = write_checkpoint(folder_ / "b", state, sample_provenance());
    EXPECT_TRUE(compare(a, b).identical);
    ++state.next_id;
    EXPECT_FALSE(compare(a, write_checkpoint(folder_ / "b", state, {})).identical);
}

TEST_F(Compare, RunFolders) {
    const std::vector<HistoryColumn> columns = {{"time", "s", "t", 1}, {"energy", "J", "e", 1}};
    const auto run = [&](const std::string& name, double energy, int snapshots) {
        State state = sample_state(3);
        SnapshotSeries series(folder_ / name, 0);
        for (int i = 0; i < snapshots; ++i) series.write(sample_scene(), state, {}, {});
        HistoryWriter history = HistoryWriter::create(folder_ / name + "/history.h5", columns, {});
        history.append({0.0, energy});
        history.flush();
        state.snapshots_written = 0;
        write_checkpoint(folder_ / name + "/checkpoint", state, {});
        return folder_ / name;
    };
    const std::string a = run("a", 1.0, 2);
    EXPECT_TRUE(compare(a, run("b", 1.0, 2)).identical);
    const Comparison other = compare(a, run("c", 1.5, 1));
    EXPECT_FALSE(other.within);
    EXPECT_EQ(of(other, "history.h5: history/energy").max_absolute, 0.5);
    EXPECT_THAT(other.notes, ElementsAre("snapshots/000001.h5: only in the first"));
}

TEST_F(Compare, WhatCannotBeComparedIsAnError) {
    const std::string a = snapshot("a.h5", sample_state(1));
    std::ofstream(folder_ / "text") << "x";
    EXPECT_THROW(compare(a, folder_ / "none"), IoError);
    EXPECT_THROW(compare(a, folder_ / "text"), IoError);
    EXPECT_THROW(compare(a, folder_.path()), IoError);
    EXPECT_THROW(compare(a, write_checkpoint(folder_ / "c", State{}, {})), IoError);
    EXPECT_THROW(compare(folder_ / "c", folder_ / "c"), IoError);
}

}  // namespace
}  // namespace scree::io
