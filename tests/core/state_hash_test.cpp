#include "core/state_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace scree {
namespace {

Bodies three_bodies() {
    Bodies b;
    for (std::uint64_t i = 0; i < 3; ++i) {
        const auto x = static_cast<double>(i);
        b.id.push_back(BodyId{i});
        b.radius.push_back(0.1);
        b.mass.push_back(1.0);
        b.material.push_back(MaterialIndex{0});
        b.position.emplace_back(x, 2.0 * x, 3.0);
        b.velocity.emplace_back(0.1 * x, 0.0, 1.0);
        b.spin.emplace_back(0.0, x, 0.0);
        b.orientation.emplace_back(1.0, 0.0, 0.0, 0.0);
    }
    return b;
}

TEST(StateHash, EqualStatesHaveEqualHashes) {
    EXPECT_EQ(state_hash(three_bodies()), state_hash(three_bodies()));
}

TEST(StateHash, EveryChangeShows) {
    const std::vector<std::function<void(Bodies&)>> changes = {
        [](Bodies&) {},
        [](Bodies& b) { b.position[1].z() = std::nextafter(b.position[1].z(), 4.0); },
        [](Bodies& b) { b.velocity[2].x() = std::nextafter(b.velocity[2].x(), 1.0); },
        [](Bodies& b) { b.spin[0].x() = 5e-324; },
        [](Bodies& b) { b.orientation[0].w() = std::nextafter(1.0, 0.0); },
        [](Bodies& b) { b.id[2] = BodyId{7}; },
        [](Bodies& b) { std::swap(b.position[0], b.position[1]); },
        [](Bodies& b) { std::swap(b.velocity[0].x(), b.velocity[0].z()); },
        [](Bodies& b) { b.spin.clear(); },
        [](Bodies& b) { b.orientation.clear(); },
        [](Bodies& b) { b = Bodies{}; },
    };
    std::set<std::uint64_t> seen;
    for (const auto& change : changes) {
        Bodies b = three_bodies();
        change(b);
        seen.insert(state_hash(b));
    }
    EXPECT_EQ(seen.size(), changes.size());
}

TEST(StateHash, RadiusAndMassAreNotHashed) {
    Bodies b = three_bodies();
    b.radius[0] = 9.0;
    b.mass[0] = 9.0;
    EXPECT_EQ(state_hash(b), state_hash(three_bodies()));
}

}  // namespace
}  // namespace scree
