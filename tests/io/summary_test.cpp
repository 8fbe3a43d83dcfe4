#include "io/results/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/state_hash.hpp"
#include "io/atomic_file.hpp"
#include "io_fixtures.hpp"

namespace scree::io {
namespace {

using namespace testing;

Summary sample_summary() {
    Plan plan;
    plan.lines = {{"friction", true, "friction between glass and glass is 0.5"},
                  {"inlets", false, "the scenario has no inlets: none"}};
    State state = sample_state(4);
    state.totals.steps = 260;
    state.totals.sweeps = 2600;
    state.totals.sweeps_max = 25;
    state.totals.residual_sum = 2.6;
    state.totals.steps_with_contacts = 130;
    state.totals.penetration_mean_sum = 1.3e-5;
    state.totals.wall_time = 0.5;
    state.ledger.work[1] = -0.125;
    Summary s = summarise(sample_scene(), plan, state);
    s.status = "complete";
    s.measures = {{"outflow.mass_rate", "kg/s", {0.72}, 0.1, 0.8, 0.7},
                  {"bed.profile", "1", {0.5, 0.6}, 0, kForever, 1}};
    s.warnings = {"3 steps did not converge: see residual.", "#2 \"quoted\"\nsecond line"};
    s.provenance = sample_provenance();
    return s;
}

TEST(Summary, AYamlParserFindsEverything) {
    const TemporaryFolder folder;
    Summary s = sample_summary();
    write_summary(folder / "summary.yaml", s);
    const YAML::Node y = YAML::LoadFile(folder / "summary.yaml");
    EXPECT_EQ(y["title"].as<std::string>(), sample_scene().title);
    EXPECT_EQ(y["status"].as<std::string>(), "complete");
    EXPECT_EQ(y["steps"].as<int>(), 250);
    EXPECT_EQ(y["substeps"].as<int>(), 260);
    EXPECT_EQ(y["simulated_time"].as<double>(), 0.25);
    EXPECT_EQ(y["wall_time"].as<double>(), 0.5);
    EXPECT_TRUE(y["time_by_phase"]["detection"].IsDefined());
    EXPECT_EQ(y["sweeps"]["mean"].as<double>(), 10.0);
    EXPECT_EQ(y["sweeps"]["max"].as<int>(), 25);
    EXPECT_EQ(y["residual"]["mean"].as<double>(), 0.01);
    EXPECT_EQ(y["residual"]["steps_not_converged"].as<int>(), 0);
    EXPECT_EQ(y["penetration"]["mean"].as<double>(), 1e-7);
    EXPECT_EQ(y["energy"]["by_law"]["friction"].as<double>(), -0.125);
    EXPECT_EQ(y["mass"]["outlets"]["hole"]["mass"].as<double>(), 0.75);
    EXPECT_NEAR(y["mass"]["start"].as<double>(), 4 * 2.8e-4 + 0.75, 1e-9);
    EXPECT_EQ(y["measures"]["outflow.mass_rate"]["mean"].as<double>(), 0.72);
    EXPECT_EQ(y["measures"]["outflow.mass_rate"]["unit"].as<std::string>(), "kg/s");
    EXPECT_EQ(y["measures"]["bed.profile"]["mean"].as<std::vector<double>>(), (std::vector<double>{0.5, 0.6}));
    EXPECT_EQ(y["measures"]["bed.profile"]["window"][1].as<double>(), kForever);
    EXPECT_EQ(y["plan"]["on"]["friction"].as<std::string>(), "friction between glass and glass is 0.5");
    EXPECT_EQ(y["plan"]["left_out"]["inlets"].as<std::string>(), "the scenario has no inlets: none");
    EXPECT_EQ(y["warnings"].as<std::vector<std::string>>(), s.warnings);
    EXPECT_EQ(y["provenance"]["run_id"].as<std::string>(), s.provenance.run_id);
    EXPECT_EQ(y["error_vs_time"]["wall_s_per_simulated_s"].as<double>(), 2.0);
    for (const char* key : {"state_hash", "bodies", "contacts", "momentum_error", "output"}) {
        EXPECT_TRUE(y[key].IsDefined()) << key;
    }
}

TEST(Summary, AHashThatLooksLikeANumberStaysText) {
    Summary s = sample_summary();
    s.state_hash = 0x0000000000001e10ULL;
    EXPECT_EQ(YAML::Load(to_yaml(s))["state_hash"].as<std::string>(), "0000000000001e10");
    EXPECT_THAT(to_yaml(s), ::testing::HasSubstr("state_hash: \"0000000000001e10\""));
}

TEST(Summary, TheHashIsThatOfTheBodies) {
    EXPECT_EQ(sample_summary().state_hash, state_hash(sample_state(4).bodies));
}

TEST(Summary, ARunWithoutAStepIsASummaryToo) {
    Summary s = summarise(Scene{}, Plan{}, State{});
    s.status = "failed";
    s.reason = "no step was made: 'x'";
    const YAML::Node y = YAML::Load(to_yaml(s));
    EXPECT_EQ(y["sweeps"]["mean"].as<double>(), 0.0);
    EXPECT_EQ(y["energy"]["drift"].as<double>(), 0.0);
    EXPECT_EQ(y["warnings"].size(), 0U);
    EXPECT_EQ(y["reason"].as<std::string>(), s.reason);
}

}  // namespace
}  // namespace scree::io
