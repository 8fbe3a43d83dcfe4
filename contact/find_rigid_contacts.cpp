#include "contact/find_rigid_contacts.hpp"

#include <algorithm>

#include "contact/contact_home.hpp"
#include "contact/laws/impact.hpp"
#include "core/terrain.hpp"

namespace scree::contact {
namespace {

// Of a wall with zones.
MaterialIndex material_of(const Wall& wall, const WallPoint& point, bool sphere) {
    if (sphere) return material_at(wall, point.feature);
    return std::get<TerrainWall>(wall.shape).terrain->material_of(point.part, wall.material);
}

// One walk over the candidates of a step.
struct Walk {
    const Scene& scene;
    const State& state;
    const StepTimes& times;
    const Domain& domain;
    ContactSet& contacts;
    std::vector<Vec3>& points;
    double look = 0.5 * times.step * scene.solver.look_ahead;
    Vec3 fall = times.step * scene.gravity.at(times.middle());  // [m/s] that gravity gives in the step
    ImpactStep step{times.step, fall.norm()};

    // Fastest point of a body, seen from one that moves with `frame`.
    double speed(std::size_t i, const Vec3& frame) const {
        const Bodies& bodies = state.bodies;
        return (bodies.velocity[i] - frame).norm() + bodies.spin[i].norm() * bodies.radius[i];
    }
    Vec3 velocity_at(std::size_t i, const Vec3& point) const {
        const Bodies& bodies = state.bodies;
        return bodies.velocity[i] + bodies.spin[i].cross(point - bodies.position[i]);
    }
    // How far apart surfaces may be that come together at this speed at most.
    double margin(double speed, double touch) const {
        return std::max({touch, look * speed + times.step * step.resting_speed, 0.5 * times.step * speed});
    }
    void add(const Contact& contact, const Vec3& point) {
        if (!domain.alone() && !solved_here(contact, state, domain, [&] { return point; })) return;
        contacts.push_back(contact);
        points.push_back(point);
    }
    void pairs_of(std::uint32_t i, const CandidateList& candidates, NarrowPhase& narrow);
    void walls_of(std::uint32_t i, const CandidateList& candidates, NarrowPhase& narrow);
};

void Walk::pairs_of(std::uint32_t i, const CandidateList& candidates, NarrowPhase& narrow) {
    const Bodies& bodies = state.bodies;
    for (const std::uint32_t j : candidates.partners(i)) {
        const double radii = bodies.radius[i] + bodies.radius[j], touch = kTouch * radii;
        const Vec3 d = bodies.position[i] - bodies.position[j];
        const double far = (1.0 + kTouch) * (radii + candidates.margin(i) + candidates.margin(j));
        if (d.squaredNorm() > far * far) continue;
        const Vec3 coming = bodies.velocity[j] - bodies.velocity[i];
        const double fastest = speed(i, bodies.velocity[j]) + speed(j, bodies.velocity[j]);
        const double most = margin(fastest, touch);
        if (d.squaredNorm() > (radii + most) * (radii + most)) continue;
        const PairLaw& law = scene.pairs(bodies.material[i], bodies.material[j]);
        for (const ManifoldPoint& p : narrow.pair(i, j, most, coming)) {
            const Vec3 u = velocity_at(i, p.point) - velocity_at(j, p.point);
            const double approach = u.dot(p.normal), reach = look * u.norm() + times.step * step.resting_speed;
            double bias = 0.0;
            if (!impact_law({p.gap, approach, approach, law.restitution, touch, reach}, step, bias)) continue;
            add({ContactKey::bodies(bodies.id[i], bodies.id[j], p.key), i, j, p.normal, p.gap, law.friction, bias},
                p.point);
        }
    }
}

void Walk::walls_of(std::uint32_t i, const CandidateList& candidates, NarrowPhase& narrow) {
    const Bodies& bodies = state.bodies;
    const double radius = bodies.radius[i], touch = kTouch * radius;
    for (const std::uint32_t w : candidates.walls(i)) {
        const WallFrame& frame = candidates.wall_frames()[w];
        if (!frame.present) continue;
        const Wall& wall = scene.walls[w];
        const PairLaw& law_of_wall = scene.pairs(bodies.material[i], wall.material);
        const double most = margin(speed(i, Vec3::Zero()), touch) + (frame.moves ? radius : 0.0);
        for (const WallPoint& p : narrow.wall(wall.shape, frame, i, most)) {
            Vec3 u = velocity_at(i, p.point);
            if (frame.moves) u -= mean_velocity(wall.motion, p.point, times.begin, times.step);
            const double approach = u.dot(p.normal), reach = look * u.norm() + times.step * step.resting_speed;
            const PairLaw& law =
                frame.zones ? scene.pairs(bodies.material[i], material_of(wall, p, bodies.is_sphere(i))) : law_of_wall;
            double bias = 0.0;
            if (!impact_law({p.gap, approach, approach + fall.dot(p.normal), law.restitution, touch, reach}, step,
                            bias))
                continue;
            add({ContactKey::wall(bodies.id[i], WallIndex{w}, p.feature, p.part), i, w, p.normal, p.gap, law.friction,
                 bias},
                p.point);
        }
    }
}

// The contacts of one body, from `first` on: pairs and walls come in order, their points nearly so.
void sort_by_key(ContactSet& contacts, std::vector<Vec3>& points, std::size_t first) {
    for (std::size_t k = first + 1; k < contacts.size(); ++k)
        for (std::size_t m = k; m > first && contacts[m].key < contacts[m - 1].key; --m) {
            std::swap(contacts[m], contacts[m - 1]);
            std::swap(points[m], points[m - 1]);
        }
}

}  // namespace

void RigidContactFinder::find(const Scene& scene, const State& state, const StepTimes& times,
                              const CandidateList& candidates, const Domain& domain, ContactSet& contacts,
                              std::vector<Vec3>& points) {
    contacts.clear();
    points.clear();
    narrow_.place(state, candidates.pairs());
    Walk walk{scene, state, times, domain, contacts, points};
    for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
        const std::size_t first = contacts.size();
        walk.pairs_of(i, candidates, narrow_);
        walk.walls_of(i, candidates, narrow_);
        sort_by_key(contacts, points, first);
    }
}

}  // namespace scree::contact
