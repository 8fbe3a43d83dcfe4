#include "io/hdf5/hdf5_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "core/errors.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

TEST(Hdf5File, RowsOfEveryTypeComeBack) {
    const TemporaryFolder folder;
    const std::vector<double> f = {0.1, -0.0, 5e-324};
    const std::vector<std::uint64_t> u = {0, std::numeric_limits<std::uint64_t>::max()};
    const std::vector<std::int64_t> i = {-1, std::numeric_limits<std::int64_t>::min()};
    const std::vector<Vec3> v = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
    Hdf5File out = Hdf5File::create(folder / "a.h5");
    write_rows(out.root(), "f", rows_of(f), {"m", "numbers"}, {.gzip = 4});
    write_rows(out.root(), "deep/u", rows_of(u), {"1", "ids"});
    write_rows(out.root(), "deep/i", rows_of(i), {"1", "ids"});
    write_rows(out.root(), "v", rows_of(v), {"m", "vectors", "world"}, {.gzip = 1});
    out.close();

    const Hdf5File in = Hdf5File::open(folder / "a.h5");
    EXPECT_EQ(read_numbers(in.root(), "f"), f);
    EXPECT_TRUE(std::signbit(read_numbers(in.root(), "f")[1]));
    std::vector<std::uint64_t> u_back(2);
    read_elements(in.root(), "deep/u", ElementType::u64, u_back.data());
    EXPECT_EQ(u_back, u);
    std::vector<std::int64_t> i_back(2);
    read_elements(in.root(), "deep/i", ElementType::i64, i_back.data());
    EXPECT_EQ(i_back, i);
    EXPECT_THAT(read_numbers(in.root(), "v"), ElementsAre(1, 2, 3, 4, 5, 6));
    const DatasetInfo info = in.root().dataset("v");
    EXPECT_THAT(info.shape, ElementsAre(2, 3));
    EXPECT_EQ(info.unit, "m");
    EXPECT_EQ(info.description, "vectors");
    std::vector<std::string> names;
    for (const DatasetInfo& d : in.root().datasets()) names.push_back(d.name);
    EXPECT_THAT(names, ElementsAre("deep/i", "deep/u", "f", "v"));
}

TEST(Hdf5File, EmptyArraysAreDatasetsToo) {
    const TemporaryFolder folder;
    Hdf5File out = Hdf5File::create(folder / "a.h5");
    write_rows(out.root(), "v", rows_of(std::vector<Vec3>{}), {"m", "none"}, {.gzip = 4});
    write_texts(out.root(), "names", {}, "none");
    write_text(out.root(), "text", "", "empty");
    out.close();
    const Hdf5File in = Hdf5File::open(folder / "a.h5");
    EXPECT_THAT(in.root().dataset("v").shape, ElementsAre(0, 3));
    EXPECT_THAT(read_numbers(in.root(), "v"), IsEmpty());
    EXPECT_THAT(read_texts(in.root(), "names"), IsEmpty());
    EXPECT_EQ(read_text(in.root(), "text"), "");
}

TEST(Hdf5File, TextAndAttributesComeBack) {
    const TemporaryFolder folder;
    const std::string long_text(200000, 'x');  // longer than an attribute may be
    Hdf5File out = Hdf5File::create(folder / "a.h5");
    write_text(out.root(), "long", long_text, "long");
    write_texts(out.root(), "names", {"a", "schön", ""}, "names");
    out.root().attribute("x", 0.1);
    out.root().attribute("n", std::numeric_limits<std::uint64_t>::max());
    out.root().attribute("t", "größer");
    out.root().attribute("t", "anew");
    out.close();
    const Hdf5File in = Hdf5File::open(folder / "a.h5");
    EXPECT_EQ(read_text(in.root(), "long"), long_text);
    EXPECT_THAT(read_texts(in.root(), "names"), ElementsAre("a", "schön", ""));
    EXPECT_EQ(in.root().number_attribute("x"), 0.1);
    EXPECT_EQ(in.root().integer_attribute("n"), std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(in.root().text_attribute("t"), "anew");
}

TEST(Hdf5File, RowsAreAppendedAndCut) {
    const TemporaryFolder folder;
    Hdf5File out = Hdf5File::create(folder / "a.h5");
    write_rows(out.root(), "v", rows_of(std::vector<Vec3>{}), {"m", "grows"}, {.extendible = true});
    append_rows(out.root(), "v", rows_of(std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)}));
    append_rows(out.root(), "v", rows_of(std::vector<Vec3>{Vec3(7, 8, 9)}));
    cut_rows(out.root(), "v", 1);
    append_rows(out.root(), "v", rows_of(std::vector<Vec3>{Vec3(0, 0, 1)}));
    EXPECT_THAT(read_numbers(out.root(), "v"), ElementsAre(1, 2, 3, 0, 0, 1));
    EXPECT_THROW(cut_rows(out.root(), "v", 3), IoError);
    EXPECT_THROW(append_rows(out.root(), "v", rows_of(std::vector<double>{1.0})), IoError);
}

TEST(Hdf5File, ErrorsNameFileAndReason) {
    const TemporaryFolder folder;
    const auto message = [](const auto& action) -> std::string {
        try {
            action();
        } catch (const IoError& error) {
            return error.what();
        }
        return "no IoError";
    };
    EXPECT_THAT(message([&] { Hdf5File::open(folder / "none.h5"); }),
                HasSubstr("none.h5: cannot be read: No such file or directory"));
    std::ofstream(folder / "text.h5") << "this is not HDF5";
    EXPECT_THAT(message([&] { Hdf5File::open(folder / "text.h5"); }), HasSubstr("text.h5: cannot be read"));
    EXPECT_THAT(message([&] { Hdf5File::create(folder / "text.h5/below.h5"); }),
                HasSubstr("below.h5: cannot be created: Not a directory"));
    Hdf5File out = Hdf5File::create(folder / "a.h5");
    EXPECT_THAT(message([&] { read_numbers(out.root(), "x"); }), HasSubstr("a.h5: has no dataset 'x'"));
    EXPECT_THAT(message([&] { out.root().existing_group("g"); }), HasSubstr("a.h5: has no group '/g'"));
    EXPECT_THAT(message([&] { out.root().text_attribute("t"); }), HasSubstr("a.h5: has no attribute 't'"));
}

TEST(Hdf5File, TheLibraryPrintsNothing) {
    ::testing::internal::CaptureStderr();
    const TemporaryFolder folder;
    EXPECT_THROW(Hdf5File::open(folder / "none.h5"), IoError);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5File, FormatIsChecked) {
    const TemporaryFolder folder;
    Hdf5File out = Hdf5File::create(folder / "a.h5");
    write_format(out.root(), "scree history");
    EXPECT_NO_THROW(check_format(out.root(), "scree history"));
    EXPECT_THROW(check_format(out.root(), "scree checkpoint"), IoError);
    const std::uint64_t later[] = {kFormatMajor + 1, 0};
    out.root().attribute("format_version", later);
    EXPECT_THROW(check_format(out.root(), "scree history"), IoError);
}

}  // namespace
}  // namespace scree::io
