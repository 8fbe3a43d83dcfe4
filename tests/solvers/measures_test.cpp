// Measures on bodies placed by hand: each number against the one worked out from the placing.
#include "solvers/measures.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <numeric>

namespace scree::solvers {
namespace {

using std::numbers::pi;

struct Fixture {
    Scene scene;
    State state;
    std::vector<ContactRecord> contacts;
    std::vector<WallLoad> loads;
    StepReport report;
    double step = 0.1;

    void add(const Vec3& position, const Vec3& velocity = Vec3::Zero(), double radius = 0.1, double mass = 1.0) {
        state.bodies.id.push_back(BodyId{state.next_id++});
        state.bodies.position.push_back(position);
        state.bodies.velocity.push_back(velocity);
        state.bodies.radius.push_back(radius);
        state.bodies.mass.push_back(mass);
        state.bodies.material.push_back(MaterialIndex{0});
    }
    void remove(std::size_t i) {
        const auto at = static_cast<std::ptrdiff_t>(i);
        Bodies& b = state.bodies;
        b.id.erase(b.id.begin() + at);
        b.position.erase(b.position.begin() + at);
        b.velocity.erase(b.velocity.begin() + at);
        b.radius.erase(b.radius.begin() + at);
        b.mass.erase(b.mass.begin() + at);
        b.material.erase(b.material.begin() + at);
    }
    Measure& measure(const std::string& name, MeasureKind kind, double from = 0.0, double until = 100.0) {
        Measure m;
        m.name = name;
        m.kind = kind;
        m.from = from;
        m.until = until;
        scene.measures.push_back(m);
        return scene.measures.back();
    }
    StepOutcome outcome() const { return {contacts, loads, step}; }
    // Free motion for one step; `taken`: index of a body that an outlet takes, or -1.
    void advance(Measures& measures, int taken = -1) {
        measures.before_step(state);
        for (std::size_t i = 0; i < state.bodies.size(); ++i)
            state.bodies.position[i] += step * state.bodies.velocity[i];
        state.time += step;
        if (taken >= 0) remove(static_cast<std::size_t>(taken));
        measures.after_step(scene, state, outcome());
    }
    // The row by name of column.
    std::map<std::string, std::vector<double>> row(Measures& measures) {
        const std::vector<double> values = measures.row(scene, state, outcome(), report);
        std::map<std::string, std::vector<double>> named;
        auto at = values.begin();
        for (const HistoryColumn& column : history_columns(scene)) {
            EXPECT_FALSE(column.unit.empty() || column.description.empty()) << column.name;
            EXPECT_FALSE(named.contains(column.name)) << column.name;
            EXPECT_LE(column.width, values.end() - at) << column.name;
            named[column.name] = {at, at + column.width};
            at += column.width;
        }
        EXPECT_EQ(at, values.end());
        return named;
    }
    std::map<std::string, Measures::Mean> means() const {
        std::map<std::string, Measures::Mean> named;
        for (Measures::Mean& mean : Measures::means(scene, state)) named[mean.column] = mean;
        return named;
    }
};

Fixture quiet() {
    Fixture f;
    f.scene.gravity = TimeTable::constant(Vec3::Zero());
    return f;
}

TEST(Measures, EveryRunHasTheStandardColumns) {
    Fixture f;
    f.add(Vec3::Zero(), Vec3(3, 4, 0), 0.1, 2.0);
    f.add(Vec3(1, 0, 0), Vec3(0, 0, 1), 0.1, 0.5);
    f.state.time = 0.25;
    f.state.ledger.kinetic = 7.0;
    f.state.ledger.potential = -2.0;
    f.state.ledger[Work::friction] = -1.5;
    f.report.contacts = 11;
    f.report.active = 9;
    f.report.sweeps = 4;
    f.report.residual_rms = 1e-3;
    f.report.residual_max = 5e-3;
    f.report.penetration = {1e-5, 1e-6, 1e-3, 1e-4};
    f.report.momentum_error = 1e-16;
    Measures measures(f.scene);
    auto row = f.row(measures);
    const std::map<std::string, double> expected = {{"time", 0.25},
                                                    {"bodies", 2},
                                                    {"mass", 2.5},
                                                    {"contacts", 11},
                                                    {"active_contacts", 9},
                                                    {"sweeps", 4},
                                                    {"residual_rms", 1e-3},
                                                    {"residual_max", 5e-3},
                                                    {"penetration_max", 1e-5},
                                                    {"penetration_mean", 1e-6},
                                                    {"penetration_max_relative", 1e-3},
                                                    {"penetration_mean_relative", 1e-4},
                                                    {"kinetic_energy", 7},
                                                    {"potential_energy", -2},
                                                    {"work.friction", -1.5},
                                                    {"work.gravity", 0},
                                                    {"energy_imbalance", 6.5},
                                                    {"momentum_error", 1e-16},
                                                    {"max_speed", 5}};
    for (const auto& [name, value] : expected) EXPECT_EQ(row.at(name).at(0), value) << name;
    EXPECT_EQ(row.size(), 14 + kWorkCount + 3);
}

TEST(Measures, FlowRateCountsWhatChangesSides) {
    Fixture f = quiet();
    MeasureSurface& surface = f.measure("out", MeasureKind::flow_rate).surface;
    surface = {Vec3(0, 0, 0), Vec3(0, 0, -1), 1.0};
    f.add(Vec3(0, 0, 0.5), Vec3(0, 0, -2), 0.1, 3.0);       // passes after 0.25 s
    f.add(Vec3(0, 0, -0.25), Vec3(0, 0, 1), 0.1, 0.5);      // passes back at the same time
    f.add(Vec3(2, 0, 0.5), Vec3(0, 0, -2), 0.1, 10.0);      // passes beside the disc
    f.add(Vec3(0.95, 0, 0.05), Vec3(1, 0, -1), 0.1, 7.0);   // passes at the disc's rim: x = 1 at z = 0
    f.add(Vec3(0.96, 0, 0.05), Vec3(1, 0, -1), 0.1, 20.0);  // just beyond it
    Measures measures(f.scene);
    EXPECT_EQ(f.row(measures).at("out.mass_rate").at(0), 0.0);
    f.advance(measures);
    auto row = f.row(measures);
    EXPECT_DOUBLE_EQ(row.at("out.mass_rate").at(0), 7.0 / 0.1);
    EXPECT_DOUBLE_EQ(row.at("out.number_rate").at(0), 1.0 / 0.1);
    f.advance(measures);
    f.advance(measures);
    row = f.row(measures);
    EXPECT_NEAR(row.at("out.mass_rate").at(0), 2.5 / 0.2, 1e-12);
    EXPECT_EQ(row.at("out.number_rate").at(0), 0.0);
    EXPECT_EQ(row.at("out.passed_mass").at(0), 9.5);
    EXPECT_EQ(row.at("out.passed_number").at(0), 1.0);
    f.advance(measures);
    EXPECT_EQ(f.row(measures).at("out.mass_rate").at(0), 0.0);
}

TEST(Measures, FlowRateWindowIsExactInTime) {
    Fixture f = quiet();
    // The crossing is at 0.25 s, within the step from 0.2 to 0.3.
    for (const auto& [name, from, until] :
         {std::tuple{"early", 0.0, 0.24}, {"late", 0.24, 0.44}, {"after", 0.26, 100.0}}) {
        f.measure(name, MeasureKind::flow_rate, from, until).surface = {Vec3::Zero(), Vec3(0, 0, -1), {}};
    }
    f.add(Vec3(0, 0, 0.5), Vec3(0, 0, -2), 0.1, 3.0);
    Measures measures(f.scene);
    for (int i = 0; i < 6; ++i) f.advance(measures);
    const auto means = f.means();
    EXPECT_EQ(means.at("early.mass_rate").value.at(0), 0.0);
    EXPECT_NEAR(means.at("early.mass_rate").covered, 0.24, 1e-15);
    EXPECT_NEAR(means.at("late.mass_rate").value.at(0), 3.0 / 0.2, 1e-12);
    EXPECT_NEAR(means.at("late.number_rate").value.at(0), 1.0 / 0.2, 1e-12);
    EXPECT_EQ(means.at("after.mass_rate").value.at(0), 0.0);
    EXPECT_NEAR(means.at("after.mass_rate").covered, 0.34, 1e-15);
    EXPECT_FALSE(means.contains("late.passed_mass"));
}

TEST(Measures, FlowRateCountsWhatAnOutletTakes) {
    for (const double shift : {0.0, 0.37, 1000.1}) {  // the outlet's face is the surface: round-off must not decide
        Fixture f = quiet();
        const Vec3 normal = Vec3(1, 2, -2) / 3, point = shift * Vec3(1, 1, 1);
        f.measure("out", MeasureKind::flow_rate).surface = {point, normal, {}};
        f.scene.outlets.push_back({"sink", HalfSpaceRegion{point, -normal}});
        f.add(point - 0.01 * normal, 0.05 * normal);  // flies too slowly to reach it: pushed by contacts
        f.add(point - 0.01 * normal, 3.0 * normal);
        f.add(point - 0.5 * normal, 0.1 * normal);
        Measures measures(f.scene);
        f.advance(measures, 0);
        EXPECT_EQ(f.row(measures).at("out.passed_number").at(0), 2.0);  // the second passed without being taken
        f.advance(measures, 0);                                         // and is taken now, beyond the surface
        EXPECT_EQ(f.row(measures).at("out.passed_number").at(0), 2.0);
    }
    // An outlet far from the surface takes bodies that do not pass it.
    Fixture f = quiet();
    f.measure("out", MeasureKind::flow_rate).surface = {Vec3::Zero(), Vec3(0, 0, -1), {}};
    f.scene.outlets.push_back({"top", BoxRegion{Vec3(-1, -1, 1), Vec3(1, 1, 2)}});
    f.add(Vec3(0, 0, 1.1), Vec3(0, 0, -0.1));
    Measures measures(f.scene);
    f.advance(measures, 0);
    EXPECT_EQ(f.row(measures).at("out.passed_number").at(0), 0.0);
}

TEST(Measures, NewBodiesDoNotPass) {
    Fixture f = quiet();
    f.measure("out", MeasureKind::flow_rate).surface = {Vec3::Zero(), Vec3(0, 0, 1), {}};
    f.add(Vec3(0, 0, -1));
    Measures measures(f.scene);
    measures.before_step(f.state);
    f.add(Vec3(0, 0, 1));
    f.state.time += f.step;
    measures.after_step(f.scene, f.state, f.outcome());
    EXPECT_EQ(f.row(measures).at("out.passed_number").at(0), 0.0);
}

TEST(Measures, MassInARegionAndItsMean) {
    Fixture f = quiet();
    f.measure("bed", MeasureKind::mass_in, 0.05, 0.25).region = BoxRegion{Vec3(-1, -1, 0), Vec3(1, 1, 1)};
    f.add(Vec3(0, 0, 0.5), Vec3::Zero(), 0.1, 2.0);
    f.add(Vec3(0, 0, 0.15), Vec3(0, 0, -1), 0.1, 3.0);  // in at 0.1 s, out at 0.2 s
    Measures measures(f.scene);
    f.advance(measures);
    EXPECT_EQ(f.row(measures).at("bed.mass").at(0), 5.0);
    f.advance(measures);
    f.advance(measures);
    EXPECT_EQ(f.row(measures).at("bed.number").at(0), 1.0);
    const Measures::Mean mean = f.means().at("bed.mass");  // 0.05 s with 5 kg, then 0.15 s with 2 kg
    EXPECT_NEAR(mean.value.at(0), (0.05 * 5.0 + 0.15 * 2.0) / 0.2, 1e-12);
    EXPECT_NEAR(mean.covered, 0.2, 1e-15);
    EXPECT_EQ(mean.unit, "kg");
}

TEST(Measures, ForceOnAWall) {
    Fixture f = quiet();
    f.scene.walls.resize(2);
    f.scene.walls[1].name = "floor";
    f.measure("floor_force", MeasureKind::wall_force).wall = WallIndex{1};
    Measures measures(f.scene);
    EXPECT_EQ(f.row(measures).at("floor_force.force_z").at(0), 0.0);  // before the first step there are no loads
    f.loads.resize(2);
    f.loads[1] = {Vec3(0.1, 0.2, -0.3), Vec3(1, 2, 3), 4};
    f.advance(measures);
    auto row = f.row(measures);
    EXPECT_DOUBLE_EQ(row.at("floor_force.force_z").at(0), -3.0);
    EXPECT_DOUBLE_EQ(row.at("floor_force.torque_y").at(0), 20.0);
    EXPECT_EQ(row.at("floor_force.contacts").at(0), 4.0);
    f.loads[1].impulse.z() = -0.5;
    f.advance(measures);
    EXPECT_NEAR(f.means().at("floor_force.force_z").value.at(0), -4.0, 1e-12);
}

TEST(Measures, CoordinationCountsImpulses) {
    Fixture f = quiet();
    f.measure("all", MeasureKind::coordination);
    f.measure("left", MeasureKind::coordination).region = HalfSpaceRegion{Vec3(0.5, 0, 0), Vec3::UnitX()};
    for (int i = 0; i < 4; ++i) f.add(Vec3(i, 0, 0));
    const auto contact = [&](ContactKey key, double impulse) {
        f.contacts.push_back(
            {key, Vec3::Zero(), Vec3::UnitX(), 0.0, impulse * Vec3::UnitX(), 0.1, ContactStatus::sticking});
    };
    contact(ContactKey::bodies(BodyId{0}, BodyId{1}), 1.0);
    contact(ContactKey::wall(BodyId{0}, WallIndex{0}, 0), 1.0);
    contact(ContactKey::bodies(BodyId{1}, BodyId{2}), 1.0);
    contact(ContactKey::bodies(BodyId{2}, BodyId{3}), 0.0);   // open
    contact(ContactKey::bodies(BodyId{2}, BodyId{77}), 1.0);  // its partner is gone
    Measures measures(f.scene);
    f.state.time = 1.0;
    auto row = f.row(measures);
    EXPECT_DOUBLE_EQ(row.at("all.mean").at(0), (2 + 2 + 2 + 0) / 4.0);
    EXPECT_DOUBLE_EQ(row.at("all.rattlers").at(0), 0.25);
    EXPECT_DOUBLE_EQ(row.at("left.mean").at(0), 2.0);
    EXPECT_DOUBLE_EQ(f.means().at("all.mean").value.at(0), 1.5);
    f.state.bodies = {};
    EXPECT_TRUE(std::isnan(f.row(measures).at("all.mean").at(0)));
}

TEST(Measures, PackingFractionCutsSpheres) {
    Fixture f = quiet();
    f.measure("bed", MeasureKind::packing_fraction).region = BoxRegion{Vec3::Zero(), Vec3(1, 1, 1)};
    f.measure("below", MeasureKind::packing_fraction).region = HalfSpaceRegion{Vec3(0, 0, 0.5), Vec3::UnitZ()};
    const double ball = 4.0 / 3 * pi * 0.001;
    f.add(Vec3(0.5, 0.5, 0.5));
    f.add(Vec3(0, 0.5, 0.5));
    f.add(Vec3(1, 1, 1));
    f.add(Vec3(1.2, 0.5, 0.5));
    Measures measures(f.scene);
    auto row = f.row(measures);
    EXPECT_NEAR(row.at("bed.value").at(0), ball * (1 + 0.5 + 0.125), 1e-14);
    EXPECT_NEAR(row.at("below.solid_volume").at(0), ball * 1.5, 1e-14);
}

// Samples at rows stand for the time since the row before; the window's end is sampled by itself.
TEST(Measures, MeansOfSampledMeasuresCoverTheWindow) {
    Fixture f = quiet();
    f.measure("bed", MeasureKind::packing_fraction, 0.1, 0.6).region = BoxRegion{Vec3::Zero(), Vec3(1, 1, 1)};
    f.add(Vec3(0.5, 0.5, 0.5));
    Measures measures(f.scene);
    f.row(measures);
    const double share = 4.0 / 3 * pi * 0.001;
    for (int i = 1; i <= 8; ++i) {
        f.advance(measures);
        if (i == 4) {
            f.row(measures);                                 // 0.1 to 0.4 s: one ball
            f.state.bodies.position[0] = Vec3(0, 0.5, 0.5);  // then half of it
        }
    }
    const Measures::Mean mean = f.means().at("bed.value");
    EXPECT_NEAR(mean.covered, 0.5, 1e-12);
    EXPECT_NEAR(mean.value.at(0), share * (0.3 + 0.5 * 0.2) / 0.5, 1e-13);
}

TEST(Measures, ProfileSharesBodiesBetweenBins) {
    for (const double sign : {1.0, -1.0}) {
        Fixture f = quiet();
        const auto profile = [&](const char* name, const std::optional<Region>& region) {
            Measure& m = f.measure(name, MeasureKind::profile);
            m.region = region;
            m.axis = sign * Vec3::UnitZ();
            m.from_coordinate = -1.0;
            m.to_coordinate = 1.0;
            m.bins = 4;
        };
        profile("box", BoxRegion{Vec3(-2, -2, -1), Vec3(2, 2, 0.75)});
        profile("tube", CylinderRegion{Vec3(0, 0, -1), Vec3::UnitZ(), 1.0, 2.0});
        profile("free", std::nullopt);
        f.add(Vec3(0, 0, -0.75), Vec3(1, 0, 0), 0.1, 1.0);
        f.add(Vec3(0, 0, -0.5), Vec3(0, 2, 0), 0.1, 3.0);  // half in each of two bins
        f.add(Vec3(5, 0, 0.25), Vec3(0, 0, 1), 0.1, 1.0);  // only in the free profile
        Measures measures(f.scene);
        f.state.time = 1.0;
        auto row = f.row(measures);
        const auto bin = [&](std::size_t i) { return sign > 0 ? i : 3 - i; };
        const double ball = 4.0 / 3 * pi * 0.001;
        EXPECT_NEAR(row.at("box.packing_fraction").at(bin(0)), 1.5 * ball / 8.0, 1e-15);
        EXPECT_NEAR(row.at("box.packing_fraction").at(bin(1)), 0.5 * ball / 8.0, 1e-15);
        EXPECT_EQ(row.at("box.packing_fraction").at(bin(2)), 0.0);
        EXPECT_NEAR(row.at("tube.packing_fraction").at(bin(0)), 1.5 * ball / (pi * 0.5), 1e-15);
        EXPECT_NEAR(row.at("free.volume_per_length").at(bin(2)), ball / 0.5, 1e-15);
        EXPECT_NEAR(row.at("box.velocity_x").at(bin(0)), 1.0 / 2.5, 1e-14);
        EXPECT_NEAR(row.at("box.velocity_y").at(bin(0)), 3.0 / 2.5, 1e-14);
        EXPECT_NEAR(row.at("free.velocity_z").at(bin(2)), 1.0, 1e-14);
        EXPECT_TRUE(std::isnan(row.at("box.velocity_x").at(bin(3))));
        // The mean over two samples weighs velocities with the mass that was there.
        f.state.bodies.velocity[0].x() = 4.0;
        f.state.bodies.mass[0] = 2.0;
        f.state.time = 2.0;
        f.row(measures);
        EXPECT_NEAR(f.means().at("box.velocity_x").value.at(bin(0)), (1.0 + 8.0) / (2.5 + 3.5), 1e-14);
    }
}

TEST(Measures, ExtentIsAbsolute) {
    Fixture f = quiet();
    f.scene.origin = Vec3(100, 200, 300);
    f.measure("heap", MeasureKind::extent);
    Measure& none = f.measure("none", MeasureKind::extent);
    none.region = SphereRegion{Vec3(50, 0, 0), 1.0};
    f.add(Vec3(0, 0, 1), Vec3::Zero(), 0.5, 1.0);
    f.add(Vec3(0, 0, 3), Vec3::Zero(), 0.25, 3.0);
    Measures measures(f.scene);
    auto row = f.row(measures);
    EXPECT_DOUBLE_EQ(row.at("heap.lowest").at(0), 300.5);
    EXPECT_DOUBLE_EQ(row.at("heap.highest").at(0), 303.25);
    EXPECT_DOUBLE_EQ(row.at("heap.centre_of_mass").at(0), 302.5);
    EXPECT_TRUE(std::isnan(row.at("none.lowest").at(0)));
}

// All that a measure goes on with is in the state: a copy, with a new Measures, gives the same bits.
TEST(Measures, AnotherObjectGoesOnWithTheSameBits) {
    Fixture f = quiet();
    f.measure("out", MeasureKind::flow_rate, 0.15, 0.72).surface = {Vec3::Zero(), Vec3(0, 0, -1), {}};
    f.measure("bed", MeasureKind::packing_fraction, 0.13, 0.77).region = BoxRegion{Vec3::Zero(), Vec3(1, 1, 1)};
    f.measure("mass", MeasureKind::mass_in, 0.13, 0.77).region = BoxRegion{Vec3::Zero(), Vec3(1, 1, 1)};
    for (int i = 0; i < 20; ++i) f.add(Vec3(0.3, 0.05 * i, 0.04 * i), Vec3(0.1, 0, -0.7), 0.1, 0.1 * (i + 1));
    Measures whole(f.scene);
    for (int i = 0; i < 5; ++i) f.advance(whole);
    f.row(whole);
    f.advance(whole);
    Fixture resumed = f;
    Measures anew(resumed.scene);
    for (int i = 0; i < 4; ++i) {
        f.advance(whole);
        resumed.advance(anew);
    }
    EXPECT_EQ(f.row(whole), resumed.row(anew));
    const auto a = f.means(), b = resumed.means();
    ASSERT_EQ(a.size(), 6U);
    for (const auto& [name, mean] : a) EXPECT_EQ(mean.value, b.at(name).value) << name;
    EXPECT_GT(a.at("out.mass_rate").value.at(0), 0.0);
}

TEST(Measures, ASceneWithoutMeasuresKeepsNothing) {
    Fixture f = quiet();
    f.add(Vec3::Zero(), Vec3::UnitX());
    Measures measures(f.scene);
    f.advance(measures);
    EXPECT_TRUE(f.state.measures.empty());
    EXPECT_TRUE(f.means().empty());
}

}  // namespace
}  // namespace scree::solvers
