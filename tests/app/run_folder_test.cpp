#include "app/run_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/errors.hpp"

namespace scree::app {
namespace fs = std::filesystem;
namespace {

class RunFolderTest : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(root_); }
    void TearDown() override { fs::remove_all(root_); }
    static void touch(const fs::path& file) {
        fs::create_directories(file.parent_path());
        std::ofstream(file) << "something\n";
    }
    fs::path root_ = fs::path(testing::TempDir()) / ("run_folder_" + std::to_string(getpid()));
};

TEST_F(RunFolderTest, IsMadeWithItsParents) {
    RunFolder folder(root_ / "a" / "b");
    EXPECT_FALSE(folder.exists());
    folder.start(false);
    EXPECT_TRUE(folder.exists());
    EXPECT_FALSE(folder.holds_a_run());
}

TEST_F(RunFolderTest, ARunIsNotOverwritten) {
    touch(root_ / "history.h5");
    RunFolder folder(root_);
    EXPECT_TRUE(folder.holds_a_run());
    try {
        folder.start(false);
        FAIL() << "should have refused";
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("--resume"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos);
    }
    EXPECT_TRUE(fs::exists(root_ / "history.h5"));
}

TEST_F(RunFolderTest, ReplacingTakesOnlyWhatScreeMade) {
    touch(root_ / "history.h5");
    touch(root_ / "snapshots" / "000000.h5");
    touch(root_ / "notes.txt");
    RunFolder folder(root_);
    folder.start(true);
    EXPECT_FALSE(folder.holds_a_run());
    EXPECT_FALSE(fs::exists(root_ / "snapshots"));
    EXPECT_TRUE(fs::exists(root_ / "notes.txt"));
}

TEST_F(RunFolderTest, OtherFilesDoNotMakeARun) {
    touch(root_ / "silo.yaml");
    RunFolder folder(root_);
    EXPECT_NO_THROW(folder.start(false));
}

TEST_F(RunFolderTest, TwoProgramsCannotWriteToOne) {
    RunFolder first(root_);
    first.start(false);
    {
        RunFolder second(root_);
        EXPECT_THROW(second.start(false), IoError);
        EXPECT_THROW(second.resume(), IoError);
    }
    EXPECT_NO_THROW(first.resume());  // its own lock does not shut it out
}

TEST_F(RunFolderTest, AFileInTheWayIsAnError) {
    touch(root_ / "out");
    RunFolder folder(root_ / "out");
    EXPECT_THROW(folder.start(false), IoError);
    RunFolder below(root_ / "out" / "run");
    EXPECT_THROW(below.start(false), IoError);
}

TEST(RunFolder, IsNamedAfterTheScenario) {
    EXPECT_EQ(default_run_folder("some/where/silo_small.yaml"), fs::path("out/silo_small"));
}

}  // namespace
}  // namespace scree::app
