// Bodies dealt out to ranks anyhow, for tests against one rank that has them all.
#pragma once

#include <cmath>

#include "core/parallel/communicator.hpp"
#include "core/random.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::testing {

inline const Communicator& world() {
    static const Communicator ranks = Communicator::world();
    return ranks;
}

enum class Ghosts { none, some, all };

// Of a body, in the deal of this number.
inline int owner(std::uint64_t id, std::uint64_t deal) {
    return static_cast<int>(mix64(id + 1000 * deal) % static_cast<std::uint64_t>(world().size()));
}

// This rank's share of the bodies: another one for each number `deal`.
inline Bodies share(const Bodies& all, std::uint64_t deal, Ghosts ghosts) {
    Bodies part;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::uint64_t id = raw(all.id[i]);
        const bool own = owner(id, deal) == world().rank();
        const bool seen =
            ghosts == Ghosts::all ||
            (ghosts == Ghosts::some && mix64(id * 31 + deal + 7 * static_cast<std::uint64_t>(world().rank())) % 3 == 0);
        if (!own && !seen) continue;
        part.id.push_back(all.id[i]);
        part.radius.push_back(all.radius[i]);
        part.mass.push_back(all.mass[i]);
        part.material.push_back(all.material[i]);
        part.position.push_back(all.position[i]);
        part.velocity.push_back(all.velocity[i]);
        if (all.has_spin()) part.spin.push_back(all.spin[i]);
        if (all.has_orientation()) part.orientation.push_back(all.orientation[i]);
        if (all.has_shapes()) part.shape.push_back(all.shape[i]);
        if (all.has_shapes()) part.inertia.push_back(all.inertia[i]);
        part.ghost.push_back(own ? 0 : 1);
    }
    if (part.owned() == part.size()) part.ghost.clear();
    return part;
}

// Of very different sizes and speeds: sums in another order would differ.
inline SmallScene cloud(int count, std::uint64_t seed) {
    SmallScene w(0.1, 0.3);
    w.gravity(Vec3(0.1, 0.2, -9.81));
    Random random(seed, 1, 0);
    const auto point = [&](double size) {
        return Vec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
    };
    for (int i = 0; i < count; ++i)
        w.add(point(1.0), std::exp2(random.uniform(-8.0, -3.0)), point(1.0) * std::exp2(random.uniform(-40.0, 3.0)),
              point(10.0));
    w.state.bodies.spin = w.given_spins;
    return w;
}

inline bool same(const Vec3& a, const Vec3& b) {
    return a == b;
}

}  // namespace scree::testing
