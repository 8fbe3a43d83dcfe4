#include "solvers/find_overlaps.hpp"

#include <algorithm>

#include "contact/cell_grid.hpp"
#include "contact/contact_home.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/walls/wall_contact.hpp"
#include "core/parallel/domain.hpp"
#include "solvers/layout.hpp"

namespace scree::solvers {

namespace {

// The bodies of `state` and those of other ranks that may touch them.
State with_neighbours(const Scene& scene, const State& state, Domain& domain) {
    State near;
    near.time = state.time;
    near.bodies = state.bodies;
    near.block_size = state.block_size;
    if (near.block_size == 0.0) near.block_size = scene.solver.block_size;
    if (near.block_size == 0.0) near.block_size = choose_block_size(near.bodies, domain.ranks());
    if (near.block_size == 0.0) near.block_size = 1.0;  // no bodies
    domain.start(near, std::vector<double>(near.bodies.size(), 0.0), 0.0);
    return near;
}

}  // namespace

std::vector<Overlap> find_overlaps(const Scene& scene, const State& state, double relative, const Communicator& ranks) {
    Domain domain(ranks);
    const State near = ranks.alone() ? State{} : with_neighbours(scene, state, domain);
    const State& here = ranks.alone() ? state : near;
    const Bodies& bodies = here.bodies;
    std::vector<Overlap> overlaps;
    const auto add = [&](const contact::Contact& c, double smaller_radius) {
        if (-c.gap > relative * smaller_radius && contact::solved_here(c, here, domain))
            overlaps.push_back({c.key, -c.gap, c.point(bodies.position[c.a], bodies.radius[c.a])});
    };
    std::vector<contact::Ball> balls(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3& x = bodies.position[i];
        balls[i] = {x.x(), x.y(), x.z(), bodies.radius[i]};
    }
    std::vector<contact::BodyPair> pairs;
    contact::CellGrid grid;
    grid.find_pairs(balls, pairs);
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [i, j] : pairs) {
        const contact::SphereGap g = contact::sphere_sphere(bodies.position[i], bodies.position[j],
                                                            bodies.radius[i] + bodies.radius[j], Vec3::Zero());
        add({ContactKey::bodies(bodies.id[i], bodies.id[j]), i, j, g.normal, g.gap, 0.0, 0.0},
            std::min(bodies.radius[i], bodies.radius[j]));
    }
    for (std::uint32_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        if (!wall.present(here.time)) continue;
        const WallPose pose = pose_at(wall.motion, here.time);
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            contact::WallContacts found;
            contact::find_contacts(wall.shape, pose.to_local(bodies.position[i]), bodies.radius[i], 0.0, found);
            for (int k = 0; k < found.count; ++k) {
                const contact::WallContact& c = found.item[static_cast<std::size_t>(k)];
                add({ContactKey::wall(bodies.id[i], WallIndex{w}, c.feature), i, w, pose.rotation * c.normal, c.gap,
                     0.0, 0.0},
                    bodies.radius[i]);
            }
        }
    }
    return overlaps;
}

}  // namespace scree::solvers
