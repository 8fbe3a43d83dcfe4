#include "io/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

template <class Action>
std::string io_error(const Action& action) {
    try {
        action();
    } catch (const IoError& error) {
        return error.what();
    }
    return "no IoError";
}

TEST(AtomicFile, ReplacesTheOldFileOnlyAtCommit) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    write_text_atomically(path, "old");
    {
        AtomicFile file(path);
        std::ofstream(file.temporary()) << "new";
        EXPECT_EQ(read_text(path), "old");
        file.commit();
    }
    EXPECT_EQ(read_text(path), "new");
    EXPECT_FALSE(fs::exists(path + ".tmp"));
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
    const TemporaryFolder folder;
    {
        AtomicFile file(folder / "a.txt");
        std::ofstream(file.temporary()) << "half";
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(AtomicFile, ErrorsNameThePathAndTheReason) {
    const TemporaryFolder folder;
    write_text_atomically(folder / "file", "x");
    EXPECT_THAT(io_error([&] { write_text_atomically(folder / "file/below", "y"); }),
                AllOf(HasSubstr(folder / "file/below"), HasSubstr("Not a directory")));
    EXPECT_THAT(io_error([&] { make_folder(folder / "file/below"); }),
                AllOf(HasSubstr(folder / "file/below"), HasSubstr("Not a directory")));
    EXPECT_THAT(io_error([&] { make_folder(folder / "file"); }), HasSubstr("folder cannot be made"));
    EXPECT_THAT(io_error([&] { read_text(folder / "none"); }), HasSubstr("No such file"));
    EXPECT_THAT(io_error([&] { read_text(folder.path()); }), HasSubstr("Is a directory"));
    EXPECT_EQ(read_text(folder / "file"), "x");
}

TEST(AtomicFile, ATargetThatIsAFolderIsAnError) {
    const TemporaryFolder folder;
    make_folder(folder / "summary.yaml");
    EXPECT_THAT(io_error([&] { write_text_atomically(folder / "summary.yaml", "y"); }),
                HasSubstr("cannot be replaced"));
    EXPECT_FALSE(fs::exists(folder / "summary.yaml.tmp"));
}

TEST(AtomicFile, AFullDiskIsAnError) {
    const TemporaryFolder folder;
    write_text_atomically(folder / "a.txt", "old");
    fs::create_symlink("/dev/full", folder / "a.txt.tmp");  // every write to it fails as on a full disk
    EXPECT_THAT(io_error([&] { write_text_atomically(folder / "a.txt", "new"); }),
                HasSubstr("No space left on device"));
    EXPECT_EQ(read_text(folder / "a.txt"), "old");
}

TEST(AtomicFile, CopiesGiveTheSystemsReason) {
    const TemporaryFolder folder;
    const std::string text(3000000, 'x');
    write_text_atomically(folder / "a", text);
    copy_file(folder / "a", folder / "b");
    EXPECT_EQ(read_text(folder / "b"), text);
    EXPECT_THAT(io_error([&] { copy_file(folder / "a", "/dev/full"); }),
                HasSubstr("/dev/full: cannot be written: No space"));
    EXPECT_THAT(io_error([&] { copy_file(folder / "none", folder / "c"); }),
                HasSubstr("none: cannot be opened: No such file"));
}

TEST(AtomicFile, LeftoversOfAKilledProgramAreRemoved) {
    const TemporaryFolder folder;
    write_text_atomically(folder / "a.h5", "whole");
    std::ofstream(folder / "b.h5.tmp") << "half";
    remove_leftovers(folder.path());
    EXPECT_TRUE(fs::exists(folder / "a.h5"));
    EXPECT_FALSE(fs::exists(folder / "b.h5.tmp"));
}

}  // namespace
}  // namespace scree::io
