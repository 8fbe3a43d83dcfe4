#include "solvers/find_overlaps.hpp"

#include <algorithm>

#include "contact/cell_grid.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/walls/wall_contact.hpp"

namespace scree::solvers {

std::vector<Overlap> find_overlaps(const Scene& scene, const State& state, double relative) {
    const Bodies& bodies = state.bodies;
    std::vector<contact::Ball> balls(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3& x = bodies.position[i];
        balls[i] = {x.x(), x.y(), x.z(), bodies.radius[i]};
    }
    std::vector<contact::BodyPair> pairs;
    contact::CellGrid grid;
    grid.find_pairs(balls, pairs);
    std::sort(pairs.begin(), pairs.end());
    std::vector<Overlap> overlaps;
    for (const auto& [i, j] : pairs) {
        if (bodies.is_ghost(std::min(i, j))) continue;
        const contact::SphereGap g = contact::sphere_sphere(bodies.position[i], bodies.position[j],
                                                            bodies.radius[i] + bodies.radius[j], Vec3::Zero());
        if (-g.gap > relative * std::min(bodies.radius[i], bodies.radius[j]))
            overlaps.push_back({ContactKey::bodies(bodies.id[i], bodies.id[j]), -g.gap,
                                bodies.position[i] - (bodies.radius[i] + 0.5 * g.gap) * g.normal});
    }
    for (std::uint32_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        if (!wall.present(state.time)) continue;
        const WallPose pose = pose_at(wall.motion, state.time);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (bodies.is_ghost(i)) continue;
            contact::WallContacts found;
            contact::find_contacts(wall.shape, pose.to_local(bodies.position[i]), bodies.radius[i], 0.0, found);
            for (int k = 0; k < found.count; ++k) {
                const contact::WallContact& c = found.item[static_cast<std::size_t>(k)];
                if (-c.gap > relative * bodies.radius[i])
                    overlaps.push_back(
                        {ContactKey::wall(bodies.id[i], WallIndex{w}, c.feature), -c.gap,
                         bodies.position[i] - (bodies.radius[i] + 0.5 * c.gap) * (pose.rotation * c.normal)});
            }
        }
    }
    return overlaps;
}

}  // namespace scree::solvers
