#include "core/ledger.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(Ledger, DriftIsTheImbalanceOverTheRangeOfEnergies) {
    Ledger ledger;
    ledger.kinetic_0 = 1.0;
    ledger.potential_0 = 10.0;
    ledger.kinetic = 3.0;
    ledger.potential = 7.0;
    ledger[Work::friction] = -0.75;
    ledger[Work::restitution] = -0.5;
    EXPECT_DOUBLE_EQ(ledger.imbalance(), 0.25);

    ledger.kinetic_max = 2.0;
    ledger.potential_min = 5.0;
    ledger.potential_max = 10.0;
    EXPECT_DOUBLE_EQ(ledger.drift(), 0.05);
    ledger.kinetic_max = 10.0;
    EXPECT_DOUBLE_EQ(ledger.drift(), 0.025);
}

TEST(Ledger, DriftHasNoSign) {
    Ledger ledger;
    ledger.kinetic = -1.0;
    ledger.kinetic_max = 4.0;
    EXPECT_DOUBLE_EQ(ledger.drift(), 0.25);
}

// A pile at rest: its energy moved by round-off only, and nothing else gives a scale.
TEST(Ledger, RoundOffOfASceneAtRestIsNoDrift) {
    Ledger ledger;
    ledger.potential_0 = ledger.potential_min = 400.0;
    ledger.potential = ledger.potential_max = 400.0 + 2e-13;
    EXPECT_EQ(ledger.drift(), 0.0);
    ledger.potential = ledger.potential_max = 400.0 + 2e-11;
    EXPECT_DOUBLE_EQ(ledger.drift(), 1.0);
}

TEST(Ledger, ASceneWithoutEnergyHasNoDrift) {
    EXPECT_EQ(Ledger{}.drift(), 0.0);
}

}  // namespace
}  // namespace scree
