#include "core/size_distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace scree {
namespace {

constexpr std::size_t kDraws = 20000;

std::vector<double> draws(const SizeDistribution& distribution) {
    std::vector<double> d;
    for (std::size_t i = 0; i < kDraws; ++i) {
        Random random(11, 5, i);
        d.push_back(draw_diameter(distribution, random));
    }
    return d;
}

// Kolmogorov and Smirnov's distance between the draws and the distribution function. Its 0.999 quantile for n draws is
// 1.95 / sqrt(n); the seed is fixed, so the test gives the same answer always.
void expect_distribution(const SizeDistribution& distribution, const std::function<double(double)>& cumulative) {
    std::vector<double> d = draws(distribution);
    std::sort(d.begin(), d.end());
    EXPECT_GE(d.front(), smallest_diameter(distribution));
    EXPECT_LE(d.back(), largest_diameter(distribution));
    double distance = 0.0;
    const auto n = static_cast<double>(d.size());
    for (std::size_t i = 0; i < d.size(); ++i) {
        const double f = cumulative(d[i]), k = static_cast<double>(i);
        distance = std::max({distance, (k + 1.0) / n - f, f - k / n});
    }
    EXPECT_LT(distance, 1.95 / std::sqrt(n));
}

double normal_cdf(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

void expect_truncated_normal(double mean, double deviation, double lower, double upper) {
    const double a = (lower - mean) / deviation, b = (upper - mean) / deviation;
    expect_distribution(NormalSize{mean, deviation, lower, upper}, [&](double d) {
        const double x = (d - mean) / deviation;
        // from the side of the tail, so that the far tails below keep their digits
        if (a > 0.0) return (normal_cdf(-a) - normal_cdf(-x)) / (normal_cdf(-a) - normal_cdf(-b));
        return (normal_cdf(x) - normal_cdf(a)) / (normal_cdf(b) - normal_cdf(a));
    });
}

TEST(SizeDistribution, Fixed) {
    for (const double d : draws(FixedSize{0.25})) ASSERT_EQ(d, 0.25);
}
TEST(SizeDistribution, Uniform) {
    expect_distribution(UniformSize{2.0, 5.0}, [](double d) { return (d - 2.0) / 3.0; });
}
TEST(SizeDistribution, NormalCutAtThreeDeviations) {
    expect_truncated_normal(6.0, 0.5, 4.5, 7.5);
}
TEST(SizeDistribution, NormalCutOnOneSide) {
    expect_truncated_normal(6.0, 2.0, 5.8, 30.0);
}
TEST(SizeDistribution, NormalInANarrowWindow) {
    expect_truncated_normal(6.0, 2.0, 5.9, 6.2);
}
TEST(SizeDistribution, NormalInTheUpperTail) {
    expect_truncated_normal(6.0, 0.5, 9.0, 20.0);
}
TEST(SizeDistribution, NormalInTheLowerTail) {
    expect_truncated_normal(20.0, 0.5, 1.0, 16.0);
}
TEST(SizeDistribution, NormalFarInTheTailAndNarrow) {
    expect_truncated_normal(6.0, 0.5, 11.0, 11.02);
}

TEST(SizeDistribution, LogNormal) {
    const double a = std::log(0.5) / 0.8, b = std::log(8.0) / 0.8;
    expect_distribution(LogNormalSize{1.0, 0.8, 0.5, 8.0}, [&](double d) {
        return (normal_cdf(std::log(d) / 0.8) - normal_cdf(a)) / (normal_cdf(b) - normal_cdf(a));
    });
}

TEST(SizeDistribution, PowerLaws) {
    for (const double n : {-2.0, 0.0, 0.999999, 2.5, 4.0, 90.0}) {
        const double k = 1.0 - n;
        expect_distribution(PowerLawSize{0.5, 5.0, n}, [&](double d) {
            return (std::pow(d, k) - std::pow(0.5, k)) / (std::pow(5.0, k) - std::pow(0.5, k));
        });
    }
    expect_distribution(PowerLawSize{0.5, 5.0, 1.0}, [](double d) { return std::log(d / 0.5) / std::log(10.0); });
}

TEST(SizeDistribution, PowerLawWithAnExtremeExponentStaysFinite) {
    for (const double d : draws(PowerLawSize{1e-3, 10.0, -100.0})) ASSERT_TRUE(d >= 1e-3 && d <= 10.0);
    for (const double d : draws(PowerLawSize{1e-3, 10.0, 100.0})) ASSERT_TRUE(d >= 1e-3 && d <= 10.0);
}

TEST(SizeDistribution, Table) {
    expect_distribution(TableSize{{1.0, 2.0, 4.0}, {0.0, 0.25, 1.0}},
                        [](double d) { return d < 2.0 ? 0.25 * (d - 1.0) : 0.25 + 0.375 * (d - 2.0); });
}

TEST(SizeDistribution, TableThatDoesNotBeginAtZeroHasBodiesOfItsFirstSize) {
    const std::vector<double> d = draws(TableSize{{1.0, 2.0}, {0.4, 1.0}});
    const auto first = std::count(d.begin(), d.end(), 1.0);
    EXPECT_NEAR(static_cast<double>(first) / kDraws, 0.4, 4.0 * std::sqrt(0.24 / kDraws));
}

TEST(SizeDistribution, ADrawDependsOnItsCountersOnly) {
    const SizeDistribution size = NormalSize{6.0, 0.5, 4.5, 7.5};
    Random a(1, 2, 3), b(1, 2, 3), other(1, 2, 4);
    const double first = draw_diameter(size, a);
    EXPECT_EQ(first, draw_diameter(size, b));
    EXPECT_NE(first, draw_diameter(size, other));
}

}  // namespace
}  // namespace scree
