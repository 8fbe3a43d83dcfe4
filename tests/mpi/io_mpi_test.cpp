// Files of many ranks against those of one: the same contents, whoever wrote and whoever reads; and faults on one rank,
// which must end all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <functional>
#include <optional>

#include "core/errors.hpp"
#include "core/parallel/sorted_slices.hpp"
#include "core/state_hash.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/compare.hpp"
#include "io/results/history.hpp"
#include "io/results/raster_files.hpp"
#include "io/results/run_log.hpp"
#include "io/results/snapshot.hpp"
#include "io/results/summary.hpp"
#include "tests/io/io_fixtures.hpp"
#include "tests/io/polyhedra.hpp"
#include "tests/io/state_bytes.hpp"
#include "tests/mpi/dealt.hpp"

namespace scree::io {
namespace {

using namespace testing;
using scree::testing::Ghosts;
using scree::testing::owner;
using scree::testing::share;
using scree::testing::world;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// One folder of all ranks.
class SharedFolder {
  public:
    SharedFolder() {
        if (world().root()) folder_.emplace();
        if (folder_) path_ = folder_->path();
        world().broadcast(path_);
    }
    ~SharedFolder() { world().barrier(); }
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    const std::string& path() const { return path_; }

  private:
    std::optional<TemporaryFolder> folder_;
    std::string path_;
};

// Contact keys with bodies of this state, increasing.
WarmStart impulses(const Bodies& bodies, bool friction, Random& random) {
    WarmStart all;
    all.step = 0.001;
    for (std::size_t i = 0; i + 1 < bodies.size(); ++i) {
        const std::uint64_t a = raw(bodies.id[i]);
        for (std::uint64_t k = random.bits() % 4; k-- > 0;) {
            const std::uint64_t b = raw(bodies.id[i + 1]) + 10 * k;
            all.key.push_back({a, b, 0});
        }
        if (i % 7 == 0) all.key.push_back(ContactKey::wall(bodies.id[i], WallIndex{3}, 2));
        if (i % 14 == 0) all.key.push_back(ContactKey::wall(bodies.id[i], WallIndex{3}, 9));
    }
    std::sort(all.key.begin(), all.key.end());
    for (std::size_t k = 0; k < all.key.size(); ++k) {
        if (friction) all.impulse_vector.push_back(any_vector(random));
        if (!friction) all.impulse_normal.push_back(any_number(random));
    }
    return all;
}

WarmStart share_of(const WarmStart& all) {
    WarmStart part;
    part.step = all.step;
    for (std::size_t k = 0; k < all.key.size(); ++k) {
        if (owner(all.key[k].a, 5) != world().rank()) continue;
        part.key.push_back(all.key[k]);
        if (!all.impulse_vector.empty()) part.impulse_vector.push_back(all.impulse_vector[k]);
        if (!all.impulse_normal.empty()) part.impulse_normal.push_back(all.impulse_normal[k]);
    }
    return part;
}

// Leaves this rank's rows of cells.
void cut_rasters(RasterState& rasters) {
    for (auto* values : {&rasters.depth, &rasters.height, &rasters.speed, &rasters.arrival}) {
        const Division rows{values->size() / rasters.columns, 1, world().size()};
        const auto at = [&](int rank) {
            return values->begin() + static_cast<std::ptrdiff_t>(rows.first(rank) * rasters.columns);
        };
        *values = std::vector<double>(at(world().rank()), at(world().rank() + 1));
    }
}

// The whole state, equal on all ranks, and what this one has of it.
struct Dealt {
    Dealt(std::size_t bodies, bool spins, bool orientations, std::uint64_t seed)
        : whole(random_state(seed, bodies, spins, orientations)) {
        Random random(seed, 9, 9);
        whole.warm_start = impulses(whole.bodies, spins, random);
        part = whole;
        part.bodies = share(whole.bodies, seed, Ghosts::some);
        part.warm_start = share_of(whole.warm_start);
        cut_rasters(part.rasters);
    }
    State whole, part;
};

std::vector<ContactRecord> contacts_of(const WarmStart& warm, const std::vector<std::size_t>& which) {
    std::vector<ContactRecord> records;
    for (const std::size_t k : which) {
        const double x = static_cast<double>(k);
        records.push_back({warm.key[k], Vec3(x, 0.1 * x, 3.0), Vec3::UnitZ(), -1e-6 * x, Vec3(0.0, x, 2.0 * x), 0.001,
                           k % 2 == 0 ? ContactStatus::sticking : ContactStatus::sliding});
    }
    return records;
}

std::string differences(const std::string& a, const std::string& b) {
    const Comparison comparison = compare(a, b);
    return comparison.identical ? "" : to_text(comparison);
}

// By rank 0 alone; the others go on when it is done.
void on_root(const std::function<void()>& work) {
    if (world().root()) work();
    world().barrier();
}

struct Case {
    std::size_t bodies;
    bool spins, orientations;
};
const Case kCases[] = {{0, true, true}, {1, true, false}, {3, true, true}, {3, false, false}, {500, true, true}};

TEST(RanksCheckpoint, IsTheFileOfOneRank) {
    const SharedFolder folder;
    const Provenance provenance = sample_provenance();
    std::uint64_t seed = 1;
    for (const Case& c : kCases) {
        const Dealt dealt(c.bodies, c.spins, c.orientations, seed++);
        const std::string many = write_checkpoint(folder / "many", dealt.part, provenance, world());
        on_root([&] {
            const std::string one = write_checkpoint(folder / "one", dealt.whole, provenance);
            EXPECT_EQ(differences(one, many), "");
            EXPECT_TRUE(StateBytes(read_checkpoint(many)) == StateBytes(dealt.whole));
            const Hdf5File a = Hdf5File::open(one), b = Hdf5File::open(many);
            EXPECT_EQ(a.root().integer_attribute("checksum"), b.root().integer_attribute("checksum"));
            EXPECT_EQ(read_provenance(b.root()).ranks, provenance.ranks);
            EXPECT_EQ(a.root().datasets().size(), b.root().datasets().size());
            EXPECT_FALSE(fs::exists(many + ".tmp"));
        });
    }
}

TEST(RanksCheckpoint, IsReadInSlices) {
    const SharedFolder folder;
    std::uint64_t seed = 1;
    for (const Case& c : kCases) {
        const Dealt dealt(c.bodies, c.spins, c.orientations, seed++);
        on_root([&] { write_checkpoint(folder / "one", dealt.whole, sample_provenance()); });
        const auto found = find_latest_checkpoint(folder / "one", world());
        ASSERT_TRUE(found.has_value());
        const State& state = found->state;
        EXPECT_EQ(state_hash(state.bodies, world()), state_hash(dealt.whole.bodies));
        const Division division{c.bodies, 1, world().size()};
        const std::uint64_t first = division.first(world().rank()), end = division.first(world().rank() + 1);
        ASSERT_EQ(state.bodies.size(), end - first);
        // The slices are at most one apart, and the impulses lie with their body a.
        EXPECT_LE(end - first,
                  (c.bodies + static_cast<std::size_t>(world().size()) - 1) / static_cast<std::size_t>(world().size()));
        EXPECT_EQ(world().sum(state.warm_start.key.size()), dealt.whole.warm_start.key.size());
        for (const ContactKey& key : state.warm_start.key) {
            EXPECT_TRUE(std::binary_search(state.bodies.id.begin(), state.bodies.id.end(), BodyId{key.a}));
        }
        State rest = dealt.whole;
        rest.bodies = state.bodies;
        rest.warm_start = state.warm_start;
        cut_rasters(rest.rasters);
        EXPECT_TRUE(StateBytes(state) == StateBytes(rest));
        // Written again by those who read it, it is the same file.
        const std::string again = write_checkpoint(folder / "again", state, found->provenance, world());
        on_root([&] { EXPECT_EQ(differences(found->path, again), ""); });
    }
}

TEST(RanksCheckpoint, ADamagedOneIsPassedOverByAll) {
    const SharedFolder folder;
    Dealt dealt(40, true, true, 3);
    dealt.part.step = 10;
    const std::string good = write_checkpoint(folder.path(), dealt.part, {}, world());
    dealt.part.step = 11;
    const std::string bad = write_checkpoint(folder.path(), dealt.part, {}, world());
    on_root([&] { fs::resize_file(bad, fs::file_size(bad) - 8); });
    const auto found = find_latest_checkpoint(folder.path(), world());
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->path, good);
    EXPECT_EQ(found->state.step, 10U);
    ASSERT_EQ(found->messages.size(), 1U);
    EXPECT_THAT(found->messages[0], HasSubstr("truncated"));
    on_root([&] { fs::resize_file(good, 1000); });
    EXPECT_THROW(find_latest_checkpoint(folder.path(), world()), IoError);
    EXPECT_FALSE(find_latest_checkpoint(folder / "none", world()).has_value());
}

TEST(RanksSnapshot, IsTheFileOfOneRank) {
    const SharedFolder folder;
    std::uint64_t seed = 21;
    const Case large{40000, true, true};  // several compressed chunks
    for (const Case& c : {kCases[0], kCases[1], kCases[2], kCases[3], kCases[4], large}) {
        for (const int compression : {0, 4}) {
            const Dealt dealt(c.bodies, c.spins, c.orientations, seed++);
            Scene scene = sample_scene();
            scene.output.compression = compression;
            std::vector<std::size_t> all, own;
            for (std::size_t k = dealt.whole.warm_start.key.size(); k-- > 0;) {
                all.push_back(k);
                if (mix64(k) % static_cast<std::uint64_t>(world().size()) == static_cast<std::uint64_t>(world().rank()))
                    own.push_back(k);
            }
            const std::string many = folder / "many.h5", one = folder / "one.h5";
            write_snapshot(many, 7, scene, dealt.part, contacts_of(dealt.whole.warm_start, own), {}, world());
            on_root([&] {
                write_snapshot(one, 7, scene, dealt.whole, contacts_of(dealt.whole.warm_start, all), {});
                EXPECT_EQ(differences(one, many), "") << c.bodies << " bodies, compression " << compression;
                const Hdf5File a = Hdf5File::open(one), b = Hdf5File::open(many);
                EXPECT_EQ(a.root().datasets().size(), b.root().datasets().size());
                const double size_of_one = static_cast<double>(fs::file_size(one));
                EXPECT_NEAR(static_cast<double>(fs::file_size(many)), size_of_one, 0.01 * size_of_one + 8000.0);
            });
        }
    }
}

TEST(RanksSnapshot, SurfacesAreThoseOfOneRank) {
    const SharedFolder folder;
    std::uint64_t deal = 1;
    for (const std::size_t bodies : {0U, 1U, 4U, 300U, 20000U}) {
        for (const int compression : {0, 4}) {
            const State whole = polyhedra_state(bodies);
            State part = whole;
            part.bodies = share(whole.bodies, deal++, Ghosts::some);
            Scene scene = sample_scene();
            scene.output.compression = compression;
            const std::string many = folder / "many.h5", one = folder / "one.h5";
            write_snapshot(many, 7, scene, part, {}, {}, world());
            on_root([&] {
                write_snapshot(one, 7, scene, whole, {}, {});
                EXPECT_EQ(differences(one, many), "") << bodies << " bodies, compression " << compression;
                const Hdf5File file = Hdf5File::open(many);
                const std::vector<DatasetInfo> datasets = file.root().existing_group("mesh").datasets();
                EXPECT_EQ(datasets.size(), 3U);
            });
        }
    }
}

TEST(RanksSnapshot, TheSeriesGoesOn) {
    const SharedFolder folder;
    State state = sample_state(5);
    state.bodies = share(state.bodies, 1, Ghosts::all);
    {
        SnapshotSeries series(folder.path(), 0, world());
        series.write(sample_scene(), state, {}, {});
        series.write(sample_scene(), state, {}, {});
        EXPECT_EQ(state.snapshots_written, 2U);
        EXPECT_GT(series.bytes(), 1000U);
    }
    SnapshotSeries series(folder.path(), 1, world());
    state.snapshots_written = 1;
    series.write(sample_scene(), state, {}, {});
    on_root([&] {
        EXPECT_EQ(list_snapshots(folder.path()).size(), 2U);
        EXPECT_THAT(read_text(folder / "run.xdmf"), HasSubstr("snapshots/000001.h5:/bodies/velocity"));
    });
}

TEST(RanksRasters, AreTheFileOfOneRank) {
    const SharedFolder folder;
    for (const std::uint32_t rows : {1U, 2U, 700U}) {
        Scene scene = sample_scene();
        scene.rasters.emplace();
        scene.rasters->grid = {500, rows, 0.0, 0.0, 1.0, 1.0};
        State state = sample_state(1);
        state.rasters.columns = 500;
        Random random(rows, 0, 0);
        for (auto* values : {&state.rasters.depth, &state.rasters.height, &state.rasters.speed, &state.rasters.arrival})
            for (std::uint32_t k = 0; k < 500 * rows; ++k) values->push_back(random.uniform(0.0, 1.0));
        State part = state;
        cut_rasters(part.rasters);
        write_rasters(folder / "many", scene, part, part.rasters.speed, {}, world());
        on_root([&] {
            write_rasters(folder / "one", scene, state, state.rasters.speed, {}, Communicator::self());
            EXPECT_EQ(differences(folder / "one/rasters.h5", folder / "many/rasters.h5"), "");
            for (const char* name : {"deposit", "arrival_time"}) {
                EXPECT_EQ(read_text(folder / ("one/" + std::string(name) + ".asc")),
                          read_text(folder / ("many/" + std::string(name) + ".asc")));
            }
        });
    }
}

TEST(RanksHash, IsThatOfOneRank) {
    for (const Case& c : kCases) {
        const Dealt dealt(c.bodies, c.spins, c.orientations, 77);
        EXPECT_EQ(state_hash(dealt.part.bodies, world()), state_hash(dealt.whole.bodies));
    }
}

TEST(RanksHistory, RankZeroWritesIt) {
    const SharedFolder folder;
    const std::vector<HistoryColumn> columns = {{"time", "s", "simulated time", 1}};
    HistoryWriter writer = HistoryWriter::create(folder / "history.h5", columns, {}, world());
    for (int i = 0; i < 5; ++i) writer.append({0.5 * i});
    writer.flush_if_due();
    writer.flush();
    EXPECT_EQ(writer.rows(), 5U);
    HistoryWriter resumed = HistoryWriter::resume(folder / "history.h5", columns, 3, {}, world());
    resumed.append({7.0});
    EXPECT_EQ(resumed.rows(), 4U);
    resumed.flush();
    on_root([&] {
        EXPECT_EQ(read_history(folder / "history.h5").values[0], (std::vector<double>{0.0, 0.5, 1.0, 7.0}));
    });
    EXPECT_THROW(HistoryWriter::resume(folder / "history.h5", columns, 9, {}, world()), IoError);
    EXPECT_THROW(HistoryWriter::create(folder / "none/history.h5", columns, {}, world()), IoError);
    EXPECT_THROW(RunLog(folder / "none/run.jsonl", false, world()), IoError);
}

TEST(RanksSummary, IsOfAllBodies) {
    const SharedFolder folder;
    State state = sample_state(50);
    const State whole = state;
    state.bodies = share(state.bodies, 2, Ghosts::some);
    const Summary summary = summarise(sample_scene(), {}, state, world());
    EXPECT_EQ(summary.bodies, 50U);
    EXPECT_EQ(summary.mass, summarise(sample_scene(), {}, whole).mass);
    EXPECT_EQ(summary.state_hash, state_hash(whole.bodies));
    write_summary(folder / "summary.yaml", summary, world());
    on_root([&] { EXPECT_TRUE(fs::exists(folder / "summary.yaml")); });
    EXPECT_THROW(write_summary(folder / "none/summary.yaml", summary, world()), IoError);
}

// A limit on the length of files of one rank: to write more fails as it does on a full disk.
class FullDisk {
  public:
    FullDisk(int rank, std::uint64_t bytes) {
        ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        if (rank == world().rank()) limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_{};
};

// Every rank gets an IoError that says the reason; nothing is left, and the next one succeeds.
void fails_on_all_ranks(const std::string& folder, std::uint64_t bytes, const std::function<void()>& write) {
    for (const int rank : {0, world().size() - 1}) {
        std::string message;
        {
            const FullDisk full(rank, bytes);
            try {
                write();
            } catch (const IoError& error) {
                message = error.what();
            }
        }
        EXPECT_THAT(message, HasSubstr("File too large"))
            << "full on rank " << rank << " from " << bytes << " bytes on";
        on_root([&] {
            for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
                EXPECT_FALSE(entry.path().string().ends_with(".tmp")) << entry.path();
            }
        });
    }
}

TEST(RanksFaults, AFullDiskOnOneRank) {
    const SharedFolder folder;
    const Dealt dealt(20000, true, true, 5);
    Scene scene = sample_scene();
    const auto checkpoint = [&] { write_checkpoint(folder.path(), dealt.part, {}, world()); };
    const auto snapshot = [&] { write_snapshot(folder / "000000.h5", 0, scene, dealt.part, {}, {}, world()); };
    for (const std::uint64_t bytes : {0U, 3000U, 100000U}) {
        // With few bodies a rank may have nothing to write beyond the limit; here each has.
        fails_on_all_ranks(folder.path(), bytes, checkpoint);
        scene.output.compression = 0;
        fails_on_all_ranks(folder.path(), bytes, snapshot);
    }
    checkpoint();
    snapshot();
    on_root([&] { EXPECT_EQ(list_checkpoints(folder.path()).size(), 1U); });
}

TEST(RanksFaults, AFullDiskForCompressedNumbers) {
    const SharedFolder folder;
    // Whole chunks: each rank must have one.
    const Dealt dealt(8192 * static_cast<std::size_t>(world().size()), true, true, 6);
    Scene scene = sample_scene();
    const auto snapshot = [&] { write_snapshot(folder / "000000.h5", 0, scene, dealt.part, {}, {}, world()); };
    for (const std::uint64_t bytes : {0U, 50000U}) fails_on_all_ranks(folder.path(), bytes, snapshot);
    snapshot();
    on_root([&] { EXPECT_TRUE(fs::exists(folder / "000000.h5")); });
}

TEST(RanksFaults, AFullDiskForWhatRankZeroWrites) {
    const SharedFolder folder;
    HistoryWriter history =
        HistoryWriter::create(folder / "history.h5", {{"time", "s", "simulated time", 1}}, {}, world());
    for (int i = 0; i < 100; ++i) history.append({0.5 * i});
    RunLog log(folder / "run.jsonl", false, world());
    {
        const FullDisk full(0, 0);
        EXPECT_THROW(history.flush(), IoError);
        if (!world().alone()) {
            EXPECT_NO_THROW(log.progress({}));  // no point where ranks agree
        }
        EXPECT_THROW(log.status("failed", "", 0.0, 0, 0), IoError);
    }
    history.flush();
    on_root([&] { EXPECT_EQ(read_history(folder / "history.h5").rows, 100U); });
}

TEST(RanksFaults, AFolderThatIsNotThere) {
    const SharedFolder folder;
    on_root([&] { std::ofstream(folder / "file") << "x"; });
    const Dealt dealt(3, true, true, 5);
    EXPECT_THROW(write_checkpoint(folder / "file", dealt.part, {}, world()), IoError);
    EXPECT_THROW(write_snapshot(folder / "none/a.h5", 0, sample_scene(), dealt.part, {}, {}, world()), IoError);
    EXPECT_THROW(read_checkpoint(folder / "none", nullptr, world()), IoError);
    EXPECT_THROW(SnapshotSeries(folder / "file", 0, world()), IoError);
}

}  // namespace
}  // namespace scree::io
