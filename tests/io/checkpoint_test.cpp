#include "io/results/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/results/sealed_file.hpp"
#include "io_fixtures.hpp"
#include "state_bytes.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
namespace fs = std::filesystem;

TEST(Checkpoint, EveryNumberComesBackToTheBit) {
    const TemporaryFolder folder;
    std::uint64_t seed = 1;
    for (const std::size_t bodies : {0U, 1U, 37U}) {
        for (const bool spins : {false, true}) {
            for (const bool orientations : {false, true}) {
                const State state = random_state(seed++, bodies, spins, orientations);
                const std::string path = write_checkpoint(folder / "checkpoint", state, sample_provenance());
                EXPECT_TRUE(StateBytes(read_checkpoint(path)) == StateBytes(state)) << bodies << spins << orientations;
            }
        }
    }
}

TEST(Checkpoint, AStateOfNothingComesBack) {
    const TemporaryFolder folder;
    const State state;
    EXPECT_TRUE(StateBytes(read_checkpoint(write_checkpoint(folder.path(), state, {}))) == StateBytes(state));
}

TEST(Checkpoint, CarriesItsProvenance) {
    const TemporaryFolder folder;
    const Provenance written = sample_provenance();
    Provenance read;
    read_checkpoint(write_checkpoint(folder.path(), sample_state(2), written), &read);
    EXPECT_EQ(read.run_id, written.run_id);
    EXPECT_EQ(read.scenario_resolved, written.scenario_resolved);
}

TEST(Checkpoint, TheLastTwoAreKept) {
    const TemporaryFolder folder;
    State state = sample_state(3);
    for (state.step = 10; state.step <= 40; state.step += 10) write_checkpoint(folder.path(), state, {});
    EXPECT_THAT(list_checkpoints(folder.path()),
                ::testing::ElementsAre(folder / "step_0000000040.h5", folder / "step_0000000030.h5"));
    // A run that starts again in the folder must not be continued from the older run's end.
    state.step = 5;
    write_checkpoint(folder.path(), state, {});
    EXPECT_THAT(list_checkpoints(folder.path()), ::testing::ElementsAre(folder / "step_0000000005.h5"));
}

TEST(Checkpoint, NoFolderIsNoCheckpoint) {
    const TemporaryFolder folder;
    EXPECT_FALSE(find_latest_checkpoint(folder / "checkpoint").has_value());
    EXPECT_FALSE(find_latest_checkpoint(folder.path()).has_value());
}

std::string error_of_reading(const std::string& path) {
    try {
        read_checkpoint(path);
    } catch (const IoError& error) {
        return error.what();
    }
    return "no IoError";
}

TEST(Checkpoint, ATruncatedFileIsNamedAndTheOtherOneTaken) {
    const TemporaryFolder folder;
    State state = sample_state(100);
    write_checkpoint(folder.path(), state, {});
    ++state.step;
    const std::string newer = write_checkpoint(folder.path(), state, {});
    fs::resize_file(newer, fs::file_size(newer) / 2);
    EXPECT_THAT(error_of_reading(newer), AllOf(HasSubstr(newer), HasSubstr("truncated")));
    const auto found = find_latest_checkpoint(folder.path());
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->state.step, state.step - 1);
    ASSERT_THAT(found->messages, SizeIs(1));
    EXPECT_THAT(found->messages[0], HasSubstr(newer));
}

TEST(Checkpoint, NoneReadableIsAnError) {
    const TemporaryFolder folder;
    const std::string path = write_checkpoint(folder.path(), sample_state(3), {});
    fs::resize_file(path, 0);
    EXPECT_THROW(find_latest_checkpoint(folder.path()), IoError);
}

TEST(Checkpoint, AnyFlippedBitIsFoundOut) {
    const TemporaryFolder folder;
    const std::string path = write_checkpoint(folder.path(), random_state(7, 40, true, true), sample_provenance());
    const std::string whole = read_text(path);
    Random random(1, 2, 3);
    for (std::size_t i = 0; i < 300; ++i) {
        std::string damaged = whole;
        damaged[random.bits() % damaged.size()] ^= static_cast<char>(1U << (random.bits() % 8));
        std::ofstream(path, std::ios::binary) << damaged;
        EXPECT_THAT(error_of_reading(path), HasSubstr(path));
    }
    std::ofstream(path, std::ios::binary) << whole;
    EXPECT_EQ(error_of_reading(path), "no IoError");
}

TEST(Checkpoint, AWrongNumberUnderAGoodSealIsFoundOut) {
    const TemporaryFolder folder;
    const State state = sample_state(40);
    const std::string path = write_checkpoint(folder.path(), state, {});
    std::string bytes = read_text(path);
    const double x = state.bodies.position[39].y();
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&x), sizeof(x)));
    ASSERT_NE(at, std::string::npos);
    bytes[at] ^= 1;
    std::ofstream(path, std::ios::binary) << bytes;
    seal(path);
    EXPECT_THAT(error_of_reading(path), AllOf(HasSubstr(path), HasSubstr("does not fit its numbers")));
}

TEST(Checkpoint, OtherFilesAreRefused) {
    const TemporaryFolder folder;
    std::ofstream(folder / "step_0000000001.h5") << "no";
    EXPECT_THAT(error_of_reading(folder / "step_0000000001.h5"), HasSubstr("not a checkpoint"));
    EXPECT_THROW(write_checkpoint(folder / "step_0000000001.h5/checkpoint", State{}, {}), IoError);
}

}  // namespace
}  // namespace scree::io
