// Which contacts take part and with which bias: each branch of the law, and what it promises about the end gap.
#include "contact/laws/impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"

namespace scree::contact {
namespace {

constexpr double kStep = 0.01, kRest = 0.1;  // h [s], h g [m/s]
constexpr double kTouchGap = 1e-12;

struct Verdict {
    bool part;
    double bias;
};
Verdict judge(double gap, double approach, double restitution, double reach, double push = 0.0) {
    double bias = -123.0;
    const bool part = impact_law({gap, approach, approach + push, restitution, kTouchGap, reach}, {kStep, kRest}, bias);
    return {part, bias};
}

TEST(ImpactLaw, OverlappingContactsFollowNewton) {
    for (const double gap : {-0.1, 0.0, kTouchGap})
        for (const double e : {0.0, 0.5, 1.0}) {
            const Verdict v = judge(gap, -3.0, e, 0.0);
            EXPECT_TRUE(v.part);
            EXPECT_EQ(v.bias, -3.0 * e);
        }
}

TEST(ImpactLaw, AClosingContactFollowsNewtonIfFast) {
    const Verdict v = judge(0.01, -3.0, 0.5, 0.0);  // 3 m/s over half of 0.01 s: 15 mm > 10 mm
    EXPECT_TRUE(v.part);
    EXPECT_EQ(v.bias, -1.5);
    EXPECT_FALSE(judge(0.016, -3.0, 0.5, 0.0).part);  // stays open
}

TEST(ImpactLaw, PlasticAndSlowContactsCloseExactly) {
    for (const auto& [gap, approach, e] : {std::array{0.01, -3.0, 0.0}, {5e-4, -0.15, 0.9}}) {
        const Verdict v = judge(gap, approach, e, 0.0);
        EXPECT_TRUE(v.part);
        const double end_speed = -v.bias;  // the least that 0 <= u + c allows
        EXPECT_NEAR(gap + 0.5 * kStep * end_speed, 0.0, 1e-17);
    }
}

TEST(ImpactLaw, AnOpenContactWithinReachMayOnlyClose) {
    const Verdict v = judge(0.02, -1.0, 0.5, 0.03);
    EXPECT_TRUE(v.part);
    EXPECT_EQ(v.bias, 4.0);
    EXPECT_FALSE(judge(0.04, -1.0, 0.5, 0.03).part);
    EXPECT_FALSE(judge(0.02, -1.0, 1.0, 0.03).part);  // e = 1 is not held back
}

TEST(ImpactLaw, GravityThatClosesTheGapCounts) {
    EXPECT_FALSE(judge(1e-3, 0.0, 0.0, 0.0).part);
    EXPECT_TRUE(judge(1e-3, 0.0, 0.0, 0.0, -0.3).part);  // the free velocity closes it
}

// Whatever the input: a contact without overlap ends without overlap if its law is kept, and one that takes no part
// cannot overlap by free flight. Only an elastic hop that gravity turns within the step may: its speed is turned round,
// and with it the way that it could go in half a step.
TEST(ImpactLaw, NothingOverlapsUnseen) {
    Random random(5, 1, 0);
    for (int i = 0; i < 20000; ++i) {
        const double gap = random.uniform(0.0, 0.02), approach = random.uniform(-4.0, 2.0);
        const double push = random.uniform(-kRest, kRest), reach = random.uniform(0.0, 0.02);
        const double e = std::min(1.0, random.uniform(0.0, 1.2));
        const Verdict v = judge(gap, approach, e, reach, push);
        if (!v.part) {
            EXPECT_GE(gap + 0.5 * kStep * (approach + push), -1e-17);
        } else {
            const double end_speed = std::max(approach + push, -v.bias);
            const double hop = e == 1.0 && approach > 0.0 ? 0.5 * kStep * approach : 0.0;
            EXPECT_GE(gap + 0.5 * kStep * end_speed, -hop - 1e-17) << gap << ' ' << approach << ' ' << e;
        }
    }
}

}  // namespace
}  // namespace scree::contact
