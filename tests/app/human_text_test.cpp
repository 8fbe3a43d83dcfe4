#include "app/human_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace scree::app {
namespace {

TEST(HumanText, Durations) {
    EXPECT_EQ(duration_text(0.0), "0 s");
    EXPECT_EQ(duration_text(0.4249), "0.425 s");
    EXPECT_EQ(duration_text(59.9), "59.9 s");
    EXPECT_EQ(duration_text(59.96), "1 min 00 s");
    EXPECT_EQ(duration_text(185.0), "3 min 05 s");
    EXPECT_EQ(duration_text(7805.0), "2 h 10 min");
    EXPECT_EQ(duration_text(4 * 86400.0 + 3 * 3600.0), "4 d 03 h");
    EXPECT_EQ(duration_text(-2.0), "-2 s");
    EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "unknown");
}

TEST(HumanText, Bytes) {
    EXPECT_EQ(bytes_text(0), "0 B");
    EXPECT_EQ(bytes_text(999), "999 B");
    EXPECT_EQ(bytes_text(1e3), "1 kB");
    EXPECT_EQ(bytes_text(1.32e6), "1.32 MB");
    EXPECT_EQ(bytes_text(5e15), "5e+03 TB");
}

TEST(HumanText, Counts) {
    EXPECT_EQ(count_text(0), "0");
    EXPECT_EQ(count_text(9999), "9999");
    EXPECT_EQ(count_text(10000), "10 000");
    EXPECT_EQ(count_text(1234567), "1 234 567");
    EXPECT_EQ(plural(1, "body", "bodies"), "1 body");
    EXPECT_EQ(plural(0, "body", "bodies"), "0 bodies");
}

TEST(HumanText, Lengths) {
    EXPECT_EQ(length_text(0.0), "0 m");
    EXPECT_EQ(length_text(6e-3), "6 mm");
    EXPECT_EQ(length_text(-2.5e-5), "-25 um");
    EXPECT_EQ(length_text(1.5), "1.5 m");
    EXPECT_EQ(point_text(Vec3(538500.25, 5576504.0, 2000.5)), "(538500.25, 5576504, 2000.5) m");
}

TEST(HumanText, ClocksAsSlurmWritesThem) {
    EXPECT_EQ(parse_clock("23:50:00"), 23 * 3600.0 + 50 * 60.0);
    EXPECT_EQ(parse_clock("50:00"), 3000.0);
    EXPECT_EQ(parse_clock("90"), 90.0);
    EXPECT_EQ(parse_clock("1-12:00:00"), 129600.0);
    EXPECT_EQ(parse_clock("100:00:00"), 360000.0);
    for (const char* wrong :
         {"", ":", "1:2:3", "1:60", "-5", "1e3", "5 min", "1:00:00:00", "2-50", "12:", "1-2-03:00:00"}) {
        EXPECT_EQ(parse_clock(wrong), std::nullopt) << wrong;
    }
}

}  // namespace
}  // namespace scree::app
