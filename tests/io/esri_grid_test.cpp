// Grids of heights in ESRI's format: what is written reads back, variants of the header, and every wrong file is
// refused with its line.
#include "io/terrain/esri_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/random.hpp"
#include "io/atomic_file.hpp"
#include "io/terrain/gzip.hpp"

namespace scree::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHeader = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n";

HeightGrid parse(const std::string& text) {
    return parse_esri_grid(text, "g.asc");
}

std::string refusal(const std::string& text) {
    try {
        parse(text);
    } catch (const IoError& error) {
        return error.what();
    }
    return "accepted";
}

std::string scratch(const std::string& name) {
    return (fs::path(testing::TempDir()) / name).string();
}

TEST(EsriGrid, NodesAreTheCentresOfCells) {
    const HeightGrid grid = parse(std::string(kHeader) + "NODATA_value -1\n1 2 3\n4 -1 6\n");
    EXPECT_EQ(grid.columns, 3U);
    EXPECT_EQ(grid.rows, 2U);
    EXPECT_EQ(grid.x, 105.0);
    EXPECT_EQ(grid.y, 205.0);
    EXPECT_EQ(grid.dx, 10.0);
    EXPECT_EQ(grid.at(0, 1), 1.0);  // the first line is the northernmost
    EXPECT_EQ(grid.at(2, 1), 3.0);
    EXPECT_EQ(grid.at(0, 0), 4.0);
    EXPECT_FALSE(grid.has(1, 0));
    EXPECT_TRUE(grid.has(2, 0));
}

TEST(EsriGrid, HeadersOfManyKinds) {
    const auto same = [](const std::string& text) {
        const HeightGrid grid = parse(text);
        EXPECT_EQ(grid.x, 105.0) << text;
        EXPECT_EQ(grid.y, 205.0) << text;
        EXPECT_EQ(grid.height, (std::vector<double>{4, 5, 6, 1, 2, 3})) << text;
    };
    same(std::string(kHeader) + "1 2 3\n4 5 6");
    same(std::string(kHeader) + "1 2 3 4 5 6\n");
    same(std::string(kHeader) + "1\n2 3\n\n4 5\n6\n\n");
    same(
        "NCOLS 3\r\nNROWS 2\r\nXLLCENTER 105\r\nYLLCENTER 205\r\nCELLSIZE 10\r\nNODATA_VALUE -9999\r\n1 2 3 \r\n4 5 6 "
        "\r\n");
    same("\xef\xbb\xbfncols\t3\n  nrows   2\nxllcentre 1.05e2\nyllcorner +200\ndx 10\ndy 10\n\n 1  2\t3\n4 5 6");
    same("nodata_value nan\ncellsize 10\nyllcorner 200\nxllcorner 100\nnrows 2\nncols 3\n1 2 3\n4 5 6");
    const HeightGrid grid = parse("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 3\ndy 4\n1 2\n-9999 4");
    EXPECT_EQ(grid.dx, 3.0);
    EXPECT_EQ(grid.dy, 4.0);
    EXPECT_EQ(grid.x, 1.5);
    EXPECT_FALSE(grid.has(0, 0));  // -9999 unless another is given
    const HeightGrid mixed = parse(
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -3.40282347e+38\n"
        "1 2\n-3.4028234663852886e+38 4");
    EXPECT_FALSE(mixed.has(0, 0));
    EXPECT_FALSE(
        parse("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value nan\n1 nan\n3 4").has(1, 1));
}

TEST(EsriGrid, WrongFilesAreRefusedWithTheirLine) {
    const std::string head = kHeader;
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"", "g.asc:1: the header lacks ncols"},
        {"1 2 3", "g.asc:1: the header lacks ncols"},
        {"ncols 3\nnrows 2\n1 2 3\n4 5 6", "lacks cellsize"},
        {"ncols 3\nnrows 2\ncellsize 1\n1 2 3\n4 5 6", "g.asc:3: the header lacks xllcorner and xllcenter"},
        {"ncols 3\nnrows 2\ncellsize 1\nxllcorner 0\nxllcenter 0\nyllcorner 0\n1 2 3\n4 5 6",
         "xllcorner and xllcenter are both given"},
        {"ncols 3\nncols 3\n", "g.asc:2: 'ncols' is given twice"},
        {"ncols three\nnrows 2\n", "g.asc:1: 'ncols' needs a number beside it, not 'three'"},
        {"ncols\n3\nnrows 2\n", "g.asc:1: 'ncols' needs a number beside it"},
        {"ncols 3.5\nnrows 2\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3",
         "g.asc:1: ncols is 3.5; a whole number from 2 on"},
        {"ncols 3\nnrows 1\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3",
         "g.asc:2: nrows is 1; a whole number from 2 on"},
        {"ncols -3\nnrows 2\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3", "ncols is -3"},
        {"ncols 3\nnrows 2\ncellsize 0\nxllcorner 0\nyllcorner 0\n1 2 3",
         "g.asc:3: the size of a cell is 0; it must be above 0"},
        {"ncols 3\nnrows 2\ncellsize inf\nxllcorner 0\nyllcorner 0\n1 2 3",
         "g.asc:3: 'cellsize' is inf; a finite number"},
        {"ncols 4000000000\nnrows 4000000000\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3",
         "4000000000 x 4000000000 heights are announced"},
        {"ncols 1e300\nnrows 2\ncellsize 1\nxllcorner 0\nyllcorner 0\n1 2 3", "ncols is 1e+300"},
        {"north 3\nncols 3\n", "g.asc:1: 'north' is no key of an ESRI grid"},
        {head + "1 2 3\n4 5", "g.asc:7: the file ends after 5 heights; 3 x 2 = 6 are expected"},
        {head + "1 2 3\n4 5 6 7\n", "g.asc:7: '7' follows after all 3 x 2 heights"},
        {head + "1 2 3\n4 5 6\n7\n", "g.asc:8: '7' follows after all"},
        {head + "1 2 3\n4 x 6\n", "g.asc:7: 'x' is no number; the height of column 2 is expected"},
        {head + "1 2 3\n4 5,5 6\n", "'5,5' is no number"},
        {head + "1 2 3\n4 nan 6\n", "g.asc:7: a height is nan; a finite number"},
        {head + "1 2 3\n4 1e999 6\n", "1e999"},
        {head + "1 2 inf\n4 5 6\n", "g.asc:6: a height is inf"},
        {"ncols 2\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n5\n7 8\n",
         "g.asc:8: 1 heights on this line; 2 are expected"},
        {std::string(200, 'x'), "..."},
        {std::string("\0\1\2", 3), "no key"},
    };
    for (const auto& [text, expected] : wrong) EXPECT_THAT(refusal(text), testing::HasSubstr(expected)) << text;
}

// Damaged in any way a file is read or refused; where it is read, there are as many heights as the header says.
TEST(EsriGrid, DamagedFiles) {
    std::string good = kHeader + std::string("NODATA_value -9999\n");
    for (int k = 0; k < 6; ++k) good += std::to_string(k * 1.5) + (k % 3 == 2 ? "\n" : " ");
    const std::string packed = gzip(good);
    int read = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(52, seed, 0);
        std::string bytes = seed % 4 == 0 ? packed : good;
        const int changes = 1 + static_cast<int>(random.uniform(0, 3));
        for (int c = 0; c < changes && !bytes.empty(); ++c) {
            const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size()));
            const double kind = random.uniform();
            const std::string_view signs = "0123456789.-+eE \n\tncolsrowNaif,";
            if (kind < 0.4)
                bytes[at] = signs[static_cast<std::size_t>(random.uniform() * static_cast<double>(signs.size()))];
            else if (kind < 0.6)
                bytes.erase(at, 1 + static_cast<std::size_t>(random.uniform(0, 8)));
            else if (kind < 0.8)
                bytes.insert(at, bytes.substr(0, static_cast<std::size_t>(random.uniform(0, 20))));
            else
                bytes[at] = static_cast<char>(random.uniform(0, 256));
        }
        try {
            const HeightGrid grid = parse(is_gzip(bytes) ? gunzip(bytes, "g") : bytes);
            ASSERT_EQ(grid.height.size(), std::size_t{grid.columns} * grid.rows);
            ASSERT_TRUE(grid.dx > 0.0 && grid.dy > 0.0 && std::isfinite(grid.x) && std::isfinite(grid.y));
            ++read;
        } catch (const IoError&) {
            ++refused;
        }
    }
    EXPECT_GT(read, 500);
    EXPECT_GT(refused, 5000);
}

bool same_bits(double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

TEST(EsriGrid, WhatIsWrittenReadsBackToTheSameBits) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(51, seed, 0);
        HeightGrid grid{static_cast<std::uint32_t>(random.uniform(2, 20)),
                        static_cast<std::uint32_t>(random.uniform(2, 20)),
                        random.uniform(-6e6, 6e6),
                        random.uniform(-6e6, 6e6),
                        random.uniform(1e-3, 100.0),
                        0.0,
                        {}};
        grid.dy = seed % 2 == 0 ? grid.dx : random.uniform(1e-3, 100.0);
        for (std::uint32_t k = 0; k < grid.columns * grid.rows; ++k) {
            grid.height.push_back(k % 7 == 3 ? std::nan("") : k % 11 == 5 ? -9999.0 : random.uniform(-1e3, 1e4));
        }
        const std::string path = scratch(seed % 3 == 0 ? "grid.asc.gz" : "grid.asc");
        write_esri_grid(path, grid);
        const HeightGrid back = read_esri_grid(path);
        EXPECT_EQ(is_gzip(read_text(path)), seed % 3 == 0);
        ASSERT_EQ(back.height.size(), grid.height.size());
        EXPECT_TRUE(same_bits(back.x, grid.x) && same_bits(back.y, grid.y));
        EXPECT_TRUE(same_bits(back.dx, grid.dx) && same_bits(back.dy, grid.dy));
        for (std::size_t k = 0; k < grid.height.size(); ++k)
            ASSERT_TRUE(same_bits(back.height[k], grid.height[k])) << k;
    }
}

TEST(Gzip, ThereAndBackAndDamaged) {
    std::string text;
    for (std::uint64_t i = 0; i < 2000000; ++i) text += static_cast<char>('0' + (i * i) % 10);
    for (const std::string& bytes : {std::string(), std::string("a"), text}) {
        const std::string packed = gzip(bytes);
        EXPECT_EQ(gunzip(packed, "p"), bytes);
        EXPECT_EQ(gunzip(packed + packed, "p"), bytes + bytes);
        EXPECT_EQ(gzip(bytes), packed);
        for (const std::size_t cut : {packed.size() - 1, packed.size() / 2, std::size_t{5}}) {
            EXPECT_THAT([&] { gunzip(packed.substr(0, cut), "p"); },
                        testing::ThrowsMessage<IoError>(testing::HasSubstr("p: the gzip data ends too early")));
        }
        std::string damaged = packed;
        damaged[packed.size() - 6] = static_cast<char>(damaged[packed.size() - 6] ^ 1);  // the checksum
        EXPECT_THAT([&] { gunzip(damaged, "p"); }, testing::ThrowsMessage<IoError>(testing::HasSubstr("damaged")));
    }
    EXPECT_THROW(gunzip(gzip("abc") + "junk", "p"), IoError);
}

}  // namespace
}  // namespace scree::io
