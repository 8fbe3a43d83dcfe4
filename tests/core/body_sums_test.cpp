// Sums over bodies: the same bits in any order, in any parts, over any range of sizes.
#include "core/parallel/body_sums.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

#include "core/random.hpp"

namespace scree {
namespace {

// One term a body: its radius.
Bodies bodies_with(const std::vector<double>& terms) {
    Bodies bodies;
    bodies.radius = terms;
    bodies.id.resize(terms.size());
    return bodies;
}
void add(const Bodies& bodies, ExactSum& sum) {
    add_over_bodies(bodies, std::span<ExactSum, 1>(&sum, 1),
                    [&](std::size_t i) { return std::array{bodies.radius[i]}; });
}
double sum_of(const std::vector<double>& terms) {
    ExactSum sum;
    add(bodies_with(terms), sum);
    return sum.value();
}
double one_by_one(const std::vector<double>& terms) {
    ExactSum sum;
    for (const double x : terms) sum.add(x);
    return sum.value();
}

// Of either sign, with exponents in [low, high).
std::vector<double> terms_within(std::uint64_t seed, int count, double low, double high) {
    Random random(seed, 1, 0);
    std::vector<double> x;
    for (int i = 0; i < count; ++i)
        x.push_back(std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(low, high))));
    return x;
}

RC_GTEST_PROP(BodySums, AgreeWithTheSumTermByTerm, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const int count = *rc::gen::inRange(0, 2000);
    const auto [low, high] =
        *rc::gen::element(std::pair{-3.0, 3.0}, std::pair{-60.0, 10.0}, std::pair{-150.0, 150.0},
                          std::pair{-1074.0, -1000.0}, std::pair{-1074.0, 1010.0}, std::pair{970.0, 985.0});
    const std::vector<double> terms = terms_within(seed, count, low, high);
    RC_ASSERT(sum_of(terms) == one_by_one(terms));
}

RC_GTEST_PROP(BodySums, NeitherOrderNorPartsMatter, ()) {
    std::vector<double> terms = terms_within(*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange(0, 1500), -80.0,
                                             *rc::gen::inRange(-79, 80));
    const double whole = sum_of(terms);
    Random random(*rc::gen::arbitrary<std::uint64_t>(), 2, 0);
    for (std::size_t i = terms.size(); i > 1; --i) std::swap(terms[i - 1], terms[random.bits() % i]);
    RC_ASSERT(sum_of(terms) == whole);
    const std::size_t parts = *rc::gen::inRange<std::size_t>(1, 8);
    std::vector<std::vector<double>> part(parts);
    for (const double x : terms) part[random.bits() % parts].push_back(x);
    ExactSum sum;
    for (const std::vector<double>& p : part) {
        ExactSum own;
        add(bodies_with(p), own);
        sum.add(own);
    }
    RC_ASSERT(sum.value() == whole);
}

TEST(BodySums, Extremes) {
    EXPECT_EQ(sum_of({}), 0.0);
    EXPECT_EQ(sum_of(std::vector<double>(1000, 0.0)), 0.0);
    std::vector<double> terms(1000, 1.0);
    terms[700] = 1e300;
    EXPECT_EQ(sum_of(terms), 1e300);
    terms.push_back(-1e300);
    EXPECT_EQ(sum_of(terms), 999.0);
    const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
    EXPECT_EQ(sum_of(std::vector<double>(1000, least)), 1000 * least);
    EXPECT_EQ(sum_of({most, least, -most}), least);
    EXPECT_EQ(sum_of(std::vector<double>(2048, -0.5)), -1024.0);
}

TEST(BodySums, WhatIsNotFiniteIsNotLost) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad :
         {infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::quiet_NaN()})
        for (const std::size_t at : {0, 511, 512, 1299}) {
            std::vector<double> terms(1300, 1.0);
            terms[at] = bad;
            EXPECT_TRUE(std::isnan(sum_of(terms)));
        }
    EXPECT_TRUE(std::isnan(sum_of({infinity, -infinity})));
}

TEST(BodySums, GhostsDoNotCount) {
    std::vector<double> terms = terms_within(3, 1777, -5.0, 5.0), own;
    Bodies bodies = bodies_with(terms);
    for (std::size_t i = 0; i < terms.size(); ++i) {
        bodies.ghost.push_back(i % 3 == 1 ? 1 : 0);
        if (bodies.is_ghost(i))
            bodies.radius[i] = std::numeric_limits<double>::quiet_NaN();
        else
            own.push_back(terms[i]);
    }
    ExactSum sum;
    add(bodies, sum);
    EXPECT_EQ(sum.value(), one_by_one(own));
}

}  // namespace
}  // namespace scree
