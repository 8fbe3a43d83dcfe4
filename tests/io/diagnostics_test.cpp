#include "io/scenario/diagnostics.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace scree::io {
namespace {

TEST(Diagnostics, ErrorsComeInOrderOfPlaceWithTheirSourceLine) {
    Diagnostics diagnostics;
    diagnostics.add_source("b.yaml", "one: 1\ntwo: 2\n");
    diagnostics.add_source("a.yaml", "\tthree: 3\n");
    diagnostics.error({"a.yaml", 1, 2}, "third");
    diagnostics.error({"b.yaml", 2, 6}, "second");
    diagnostics.error({"b.yaml", 1, 1}, "first");
    EXPECT_EQ(diagnostics.report(),
              "b.yaml:1:1: error: first\n    one: 1\n    ^\n"
              "b.yaml:2:6: error: second\n    two: 2\n         ^\n"
              "a.yaml:1:2: error: third\n    \tthree: 3\n    \t^\n");
}

TEST(Diagnostics, ColumnsCountCharactersNotBytes) {
    Diagnostics diagnostics;
    diagnostics.add_source("a", "caf\u00e9: x");
    diagnostics.error({"a", 1, 7}, "here");
    EXPECT_EQ(diagnostics.report(), "a:1:7: error: here\n    caf\u00e9: x\n          ^\n");
}

TEST(Diagnostics, LongLinesAreCutAroundTheFault) {
    Diagnostics diagnostics;
    diagnostics.add_source("a", std::string(300, 'x') + "!" + std::string(300, 'y'));
    diagnostics.error({"a", 1, 301}, "here");
    EXPECT_EQ(diagnostics.report(), "a:1:301: error: here\n    ..." + std::string(110, 'x') + "!" +
                                        std::string(50, 'y') + "...\n    " + std::string(113, ' ') + "^\n");
}

TEST(Diagnostics, TextThatIsNoneIsMadeReadable) {
    Diagnostics diagnostics;
    diagnostics.add_source("a", "b: \x1b[31m\xff x");
    diagnostics.error({"a", 1, 10}, "here");
    EXPECT_EQ(diagnostics.report(), "a:1:10: error: here\n    b: ?[31m? x\n             ^\n");
}

TEST(Diagnostics, AHundredAreEnough) {
    Diagnostics diagnostics;
    for (int i = 1; i <= 150; ++i) diagnostics.error({"a", i, 1}, "again");
    EXPECT_EQ(diagnostics.error_count(), 150U);
    const std::string report = diagnostics.report();
    EXPECT_NE(report.find("a:100:1:"), std::string::npos);
    EXPECT_EQ(report.find("a:101:1:"), std::string::npos);
    EXPECT_NE(report.find("... and 50 more like these\n"), std::string::npos);
}

TEST(Diagnostics, ThrowsTheWholeReport) {
    Diagnostics diagnostics;
    diagnostics.warning({"a", 1, 1}, "careful");
    EXPECT_NO_THROW(diagnostics.throw_if_errors());
    EXPECT_EQ(diagnostics.warnings(), "a:1:1: warning: careful\n");
    diagnostics.error({"a", 0, 0}, "no place");
    try {
        diagnostics.throw_if_errors();
        FAIL();
    } catch (const ScenarioError& error) {
        EXPECT_STREQ(error.what(), "a: error: no place\n");
        EXPECT_EQ(error.code(), ExitCode::invalid_scenario);
    }
}

TEST(NearestName, TakesSlipsNotOtherWords) {
    const std::vector<std::string> names{"friction", "restitution", "density", "end"};
    EXPECT_EQ(nearest_name("frictoin", names), "friction");
    EXPECT_EQ(nearest_name("restitutoin", names), "restitution");
    EXPECT_EQ(nearest_name("densty", names), "density");
    EXPECT_EQ(nearest_name("edn", names), "end");
    EXPECT_EQ(nearest_name("colour", names), "");
    EXPECT_EQ(nearest_name("", {}), "");
}

}  // namespace
}  // namespace scree::io
