// Measures on ranks: bodies and contacts dealt out anyhow, ghosts among them, give the bits of one rank that has them
// all.
#include "solvers/measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <optional>

#include "solvers/flows.hpp"
#include "tests/mpi/dealt.hpp"

namespace scree::solvers {
namespace {

using testing::cloud;
using testing::Ghosts;
using testing::owner;
using testing::share;
using testing::SmallScene;
using testing::world;

Measure measure_of(const std::string& name, MeasureKind kind, std::optional<Region> region = std::nullopt) {
    Measure m;
    m.name = name;
    m.kind = kind;
    m.region = std::move(region);
    m.from = 0.15;
    m.until = 0.55;
    return m;
}

std::vector<Measure> every_kind() {
    std::vector<Measure> measures;
    const BoxRegion box{Vec3(-0.5, -0.6, -0.7), Vec3(0.7, 0.6, 0.5)};
    const SphereRegion nothing{Vec3(50, 0, 0), 0.1};
    measures.push_back(measure_of("flow", MeasureKind::flow_rate));
    measures.back().surface = {Vec3::Zero(), Vec3::UnitX(), 0.8};
    measures.push_back(measure_of("taken", MeasureKind::flow_rate));
    measures.back().surface = {Vec3(0, 0, -0.8), -Vec3::UnitZ(), std::nullopt};
    measures.push_back(measure_of("mass", MeasureKind::mass_in, box));
    measures.push_back(measure_of("force", MeasureKind::wall_force));
    for (const std::optional<Region>& region :
         {std::optional<Region>(box), std::optional<Region>(nothing), std::optional<Region>()}) {
        const std::string n = std::to_string(measures.size());
        measures.push_back(measure_of("coordination" + n, MeasureKind::coordination, region));
        measures.push_back(measure_of("extent" + n, MeasureKind::extent, region));
        measures.push_back(measure_of("profile" + n, MeasureKind::profile, region));
        measures.back().from_coordinate = -0.9;
        measures.back().to_coordinate = 1.1;
        measures.back().bins = 5;
        if (region) measures.push_back(measure_of("packing" + n, MeasureKind::packing_fraction, region));
    }
    return measures;
}

// Contacts between any bodies, dealt to ranks that may have neither.
std::vector<ContactRecord> contacts_of(const Bodies& all, std::uint64_t seed, bool mine_only) {
    Random random(seed, 9, 0);
    std::vector<ContactRecord> contacts;
    for (std::size_t k = 0; k < all.size() / 2; ++k) {
        const auto a = all.id[random.bits() % all.size()], b = all.id[random.bits() % all.size()];
        const ContactKey key = k % 5 == 0 || a == b ? ContactKey::wall(a, WallIndex{0}, 0)
                                                    : ContactKey::bodies(std::min(a, b), std::max(a, b));
        const Vec3 impulse(k % 7 == 0 ? 0.0 : 1.0, 0.0, 0.0);
        const ContactRecord record{key, Vec3::Zero(), Vec3::UnitX(), 0.0, impulse, 0.1, ContactStatus::sticking};
        if (!mine_only || owner(k, seed) == world().rank()) contacts.push_back(record);
    }
    return contacts;
}

void expect_bits(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i]))
            << i << ": " << a[i] << ' ' << b[i];
}

// Bodies change hands in every step, between the start and the end of it, and some go through an outlet.
TEST(MeasuresOnRanks, EveryKindGivesTheBitsOfOneRank) {
    SmallScene w = cloud(400, 5);
    for (Vec3& v : w.state.bodies.velocity) v *= 2.0 / v.norm();  // fast enough for many to pass a surface
    w.add_floor();
    w.scene.measures = every_kind();
    w.scene.outlets.push_back({"below", HalfSpaceRegion{Vec3(0, 0, -0.8), Vec3::UnitZ()}, 0.0, kForever});
    w.state.outlets.resize(1);
    State mine = w.state;
    Measures one(w.scene), many(w.scene, world());
    const std::vector<WallLoad> loads(1, WallLoad{Vec3(1, 2, 3), Vec3(4, 5, 6), 7});
    const auto rows = [&](std::uint64_t step, bool whole) {
        const std::vector<ContactRecord> contacts = contacts_of(w.state.bodies, step, !whole);
        return (whole ? one : many).row(w.scene, whole ? w.state : mine, {contacts, loads, w.scene.time.step}, {});
    };
    for (std::uint64_t step = 0; step < 7; ++step) {
        mine.bodies = share(w.state.bodies, step, step % 2 == 0 ? Ghosts::some : Ghosts::none);
        one.before_step(w.state);
        many.before_step(mine);
        for (std::size_t i = 0; i < w.state.bodies.size(); ++i)
            w.state.bodies.position[i] += w.scene.time.step * w.state.bodies.velocity[i];
        w.state.time = mine.time = static_cast<double>(step + 1) * w.scene.time.step;
        mine.bodies = share(w.state.bodies, step % 3 == 0 ? step : step + 1, Ghosts::some);
        EXPECT_EQ(take_bodies(w.scene, w.state), take_bodies(w.scene, mine, world()));
        const std::vector<ContactRecord> all = contacts_of(w.state.bodies, step, false);
        const std::vector<ContactRecord> part = contacts_of(w.state.bodies, step, true);
        one.after_step(w.scene, w.state, {all, loads, w.scene.time.step});
        many.after_step(w.scene, mine, {part, loads, w.scene.time.step});
        if (step % 2 == 1) expect_bits(rows(step, true), rows(step, false));
    }
    EXPECT_GT(w.state.outlets[0].bodies, 0U);
    EXPECT_NE(w.state.measures[0].passed_mass, 0.0);
    EXPECT_EQ(w.state.outlets[0].bodies, mine.outlets[0].bodies);
    EXPECT_EQ(w.state.outlets[0].mass, mine.outlets[0].mass);
    EXPECT_EQ(w.state.ledger[Work::outlets], mine.ledger[Work::outlets]);
    const std::vector<Measures::Mean> means = Measures::means(w.scene, w.state),
                                      theirs = Measures::means(w.scene, mine);
    ASSERT_EQ(means.size(), theirs.size());
    for (std::size_t i = 0; i < means.size(); ++i) expect_bits(means[i].value, theirs[i].value);
}

}  // namespace
}  // namespace scree::solvers
