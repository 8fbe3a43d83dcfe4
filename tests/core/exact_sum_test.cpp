// The exact sum: against integer arithmetic, long double, and itself in other orders.
#include "core/exact_sum.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/random.hpp"

namespace scree {
namespace {

double sum(const std::vector<double>& terms) {
    ExactSum s;
    for (const double x : terms) s.add(x);
    return s.value();
}

// Doubles of either sign over the whole range of exponents that a sum of 100 does not overflow, subnormals included.
std::vector<double> wide_doubles(std::uint64_t seed, int count) {
    Random random(seed, 1, 0);
    std::vector<double> x;
    for (int i = 0; i < count; ++i)
        x.push_back(std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(-1074.0, 1000.0))));
    return x;
}

RC_GTEST_PROP(ExactSum, DoesNotDependOnTheOrder, ()) {
    std::vector<double> terms = wide_doubles(*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange(0, 100));
    const double first = sum(terms);
    Random random(*rc::gen::arbitrary<std::uint64_t>(), 2, 0);
    for (std::size_t i = terms.size(); i > 1; --i) std::swap(terms[i - 1], terms[random.bits() % i]);
    RC_ASSERT(sum(terms) == first);
    ExactSum left, right;  // in two parts, as two workers would
    for (std::size_t i = 0; i < terms.size(); ++i) (i % 3 == 0 ? left : right).add(terms[i]);
    right.add(left);
    RC_ASSERT(right.value() == first);
}

RC_GTEST_PROP(ExactSum, TermsAndTheirOppositesCancel, ()) {
    const std::vector<double> terms = wide_doubles(*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange(1, 50));
    ExactSum s;
    for (const double x : terms) s.add(x);
    for (std::size_t i = terms.size(); i-- > 1;) s.add(-terms[i]);
    RC_ASSERT(s.value() == terms[0]);  // exact: what is left is one double
}

RC_GTEST_PROP(ExactSum, IntegersAreExact, ()) {
    const auto terms = *rc::gen::container<std::vector<std::int64_t>>(
        rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << 45), std::int64_t{1} << 45));
    std::int64_t expected = 0;
    ExactSum s;
    for (const std::int64_t k : terms) {
        expected += k;
        s.add(static_cast<double>(k));
    }
    RC_PRE(std::abs(expected) < std::int64_t{1} << 53);
    RC_ASSERT(s.value() == static_cast<double>(expected));
}

TEST(ExactSum, KeepsWhatADoubleWouldLose) {
    EXPECT_EQ(sum({1e300, 1.0, -1e300}), 1.0);
    EXPECT_EQ(sum({-1e300, -1.0, 1e300}), -1.0);
    EXPECT_EQ(sum({1.0, 0x1p-60, -1.0}), 0x1p-60);
    EXPECT_EQ(sum({}), 0.0);
    EXPECT_EQ(sum({0.0, -0.0}), 0.0);
    const double least = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(sum({least, least, least}), 3 * least);
    EXPECT_EQ(sum({-least}), -least);
    EXPECT_EQ(sum({std::numeric_limits<double>::min(), -least}), std::numeric_limits<double>::min() - least);
    EXPECT_EQ(sum({std::numeric_limits<double>::max(), -1.0, 1.0}), std::numeric_limits<double>::max());
}

TEST(ExactSum, AgreesWithLongDouble) {
    Random random(7, 3, 0);
    for (int round = 0; round < 50; ++round) {
        std::vector<double> terms;
        long double expected = 0.0L, size = 0.0L;
        for (int i = 0; i < 2000; ++i) {
            terms.push_back(random.normal() * 3.0 - 1.0);  // sums of either sign are covered, most are negative
            expected += terms.back();
            size += std::abs(terms.back());
        }
        // long double: at most n 2^-64 of the sum of sizes; the value itself is rounded digit by digit, from the
        // largest on, to within two units in the last place
        const long double bound = 2000 * 0x1p-64L * size + 2 * 0x1p-52L * std::abs(expected);
        EXPECT_LE(std::abs(static_cast<long double>(sum(terms)) - expected), bound);
    }
}

TEST(ExactSum, ManyEqualTermsDoNotOverflowADigit) {
    ExactSum s;
    for (int i = 0; i < 1'000'000; ++i) s.add(-0x1.fffffffffffffp-3);
    EXPECT_DOUBLE_EQ(s.value(), -1e6 * 0x1.fffffffffffffp-3);
}

}  // namespace
}  // namespace scree
