#include "io/scenario/quantity.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace scree::io {
namespace {

TEST(Quantity, ABareNumberIsSi) {
    EXPECT_EQ(parse_quantity("0.006", Dimension::length).value, 0.006);
    EXPECT_EQ(parse_quantity("-1e-3", Dimension::length).value, -0.001);
    EXPECT_EQ(parse_quantity("+2", Dimension::none).value, 2.0);
    EXPECT_EQ(parse_quantity(" .5 ", Dimension::none).value, 0.5);
}

// The same bits as if the user had written the SI value.
TEST(Quantity, UnitsGiveTheNearestDouble) {
    EXPECT_EQ(parse_quantity("6 mm", Dimension::length).value, 0.006);
    EXPECT_EQ(parse_quantity("9mm", Dimension::length).value, 0.009);
    EXPECT_EQ(parse_quantity("35 um", Dimension::length).value, 35e-6);
    EXPECT_EQ(parse_quantity("2.65 g/cm3", Dimension::density).value, 2650.0);
    EXPECT_EQ(parse_quantity("2.65 g/cm^3", Dimension::density).value, 2650.0);
    EXPECT_EQ(parse_quantity("90 min", Dimension::time).value, 5400.0);
    EXPECT_EQ(parse_quantity("36 km/h", Dimension::velocity).value, 10.0);
    EXPECT_EQ(parse_quantity("9.81 m/s^2", Dimension::acceleration).value, 9.81);
    EXPECT_EQ(parse_quantity("180 deg", Dimension::angle).value, std::numbers::pi);
    EXPECT_DOUBLE_EQ(*parse_quantity("60 rpm", Dimension::angular_velocity).value, 2.0 * std::numbers::pi);
    EXPECT_EQ(parse_quantity("3.6 t/h", Dimension::mass_rate).value, 1.0);
}

TEST(Quantity, EveryUnitIsOneOfItsDimensionOnly) {
    for (int d = 1; d <= static_cast<int>(Dimension::energy); ++d) {
        const auto dimension = static_cast<Dimension>(d);
        const auto units = units_of(dimension);
        ASSERT_FALSE(units.empty());
        EXPECT_EQ(parse_quantity("1 " + units.front(), dimension).value, 1.0);  // the SI unit comes first
        for (const std::string& unit : units) {
            EXPECT_TRUE(parse_quantity("1 " + unit, dimension).value) << unit;
            const auto other = dimension == Dimension::length ? Dimension::mass : Dimension::length;
            EXPECT_FALSE(parse_quantity("1 " + unit, other).value) << unit;
        }
    }
}

TEST(Quantity, SaysWhatIsWrong) {
    EXPECT_EQ(parse_quantity("6 kg", Dimension::length).problem, "'6 kg' is a mass");
    EXPECT_EQ(parse_quantity("6 feet", Dimension::length).problem, "'feet' is not a unit");
    EXPECT_EQ(parse_quantity("six mm", Dimension::length).problem, "'six mm' is not a number");
    EXPECT_EQ(parse_quantity("", Dimension::length).problem, "'' is not a number");
    EXPECT_EQ(parse_quantity("-", Dimension::length).problem, "'-' is not a number");
    EXPECT_EQ(parse_quantity("--1", Dimension::length).problem, "'--1' is not a number");
    EXPECT_EQ(parse_quantity("-inf", Dimension::length).problem, "-inf is not finite");
    EXPECT_EQ(parse_quantity(".NaN", Dimension::none).problem, ".NaN is not finite");
    EXPECT_EQ(parse_quantity("1e400 m", Dimension::length).problem, "1e400 is beyond the range of double precision");
    EXPECT_EQ(parse_quantity("1e308 km", Dimension::length).problem,
              "1e308 km is beyond the range of double precision");
    EXPECT_EQ(parse_quantity("0x10", Dimension::none).problem, "'0x10' is not a number");
}

}  // namespace
}  // namespace scree::io
