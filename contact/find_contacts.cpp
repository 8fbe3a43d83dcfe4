#include "contact/find_contacts.hpp"

#include <cmath>

#include "contact/contact_home.hpp"
#include "contact/laws/impact.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/walls/wall_contact.hpp"

namespace scree::contact {
bool contact_margins(const Scene& scene, const State& state, const StepTimes& times, std::vector<double>& margin) {
    const Bodies& bodies = state.bodies;
    margin.resize(bodies.size());
    const double half = 0.5 * times.step * std::max(1.0, scene.solver.look_ahead);
    const double fall = times.step * scene.gravity.at(times.middle()).norm();
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        margin[i] = half * bodies.velocity[i].norm() + times.step * fall;
        sum += margin[i] + bodies.position[i].sum();
    }
    for (std::size_t i = 0; i < bodies.shape.size(); ++i) {
        const double turning = half * bodies.spin[i].norm() * bodies.radius[i];
        margin[i] += turning;
        sum += turning;
    }
    return std::isfinite(sum);
}

void find_contacts(const Scene& scene, const State& state, const StepTimes& times, const CandidateList& candidates,
                   const Domain& domain, ContactSet& contacts) {
    const Bodies& bodies = state.bodies;
    const double h = times.step;
    const Vec3 gravity = scene.gravity.at(times.middle());
    const ImpactStep step{h, h * gravity.norm()};
    const double look = 0.5 * h * scene.solver.look_ahead;
    const std::vector<WallFrame>& frame = candidates.wall_frames();
    contacts.clear();
    const auto keep_if_own = [&] {
        if (!domain.alone() && !solved_here(contacts.back(), state, domain)) contacts.pop_back();
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3& x = bodies.position[i];
        const double radius = bodies.radius[i];
        const Vec3& v = bodies.velocity[i];
        for (const std::uint32_t j : candidates.partners(i)) {
            // most candidates are too far at any speed: no root for them
            const double radii = radius + bodies.radius[j];
            const double farthest = (1.0 + kTouch) * (radii + candidates.margin(i) + candidates.margin(j));
            if ((x - bodies.position[j]).squaredNorm() > farthest * farthest) continue;
            const Vec3 relative = v - bodies.velocity[j];
            const double speed = relative.norm();
            const double reach = look * speed + h * step.resting_speed;
            const SphereGap pair = sphere_sphere(x, bodies.position[j], radii, relative);
            const double touch = kTouch * radii;
            if (pair.gap > std::max({touch, reach, 0.5 * h * speed})) continue;
            const PairLaw& law = scene.pairs(bodies.material[i], bodies.material[j]);
            const double approach = relative.dot(pair.normal);
            double bias = 0.0;
            if (!impact_law({pair.gap, approach, approach, law.restitution, touch, reach}, step, bias)) continue;
            contacts.push_back({ContactKey::bodies(bodies.id[i], bodies.id[j]), static_cast<std::uint32_t>(i), j,
                                pair.normal, pair.gap, law.friction, bias});
            keep_if_own();
        }
        for (const std::uint32_t w : candidates.walls(i)) {
            if (!frame[w].present) continue;
            const Wall& wall = scene.walls[w];
            const PairLaw& law_of_wall = scene.pairs(bodies.material[i], wall.material);
            const double margin = 0.5 * h * v.norm() * std::max(1.0, scene.solver.look_ahead) + h * step.resting_speed +
                                  kTouch * radius + (frame[w].moves ? radius : 0.0);
            WallContacts found;
            find_contacts(wall.shape, frame[w].moves ? frame[w].pose.to_local(x) : x, radius, margin, found);
            for (int k = 0; k < found.count; ++k) {
                const WallContact& c = found.item[static_cast<std::size_t>(k)];
                const Vec3 normal = frame[w].moves ? Vec3(frame[w].pose.rotation * c.normal) : c.normal;
                Vec3 relative = v;
                if (frame[w].moves)
                    relative -= mean_velocity(wall.motion, x - (radius + 0.5 * c.gap) * normal, times.begin, h);
                const double approach = relative.dot(normal);
                const double free_approach = approach + h * gravity.dot(normal);
                const double reach = look * relative.norm() + h * step.resting_speed;
                const PairLaw& law =
                    frame[w].zones ? scene.pairs(bodies.material[i], material_at(wall, c.feature)) : law_of_wall;
                double bias = 0.0;
                if (!impact_law({c.gap, approach, free_approach, law.restitution, kTouch * radius, reach}, step, bias))
                    continue;
                contacts.push_back({ContactKey::wall(bodies.id[i], WallIndex{w}, c.feature),
                                    static_cast<std::uint32_t>(i), w, normal, c.gap, law.friction, bias});
                keep_if_own();
            }
        }
    }
}

}  // namespace scree::contact
