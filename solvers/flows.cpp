#include "solvers/flows.hpp"

#include <algorithm>

#include "contact/walls/wall_contact.hpp"
#include "core/random.hpp"
#include "solvers/energy.hpp"

namespace scree::solvers {
namespace {

constexpr std::uint64_t kInletSizes = 0x1000, kInletPlaces = 0x2000;  // streams of random numbers
constexpr int kTriesAStep = 200;                                      // places tried for one body in one step

template <class T>
void keep(std::vector<T>& values, const std::vector<std::uint8_t>& goes) {
    if (values.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (goes[i] == 0) values[to++] = values[i];
    values.resize(to);
}

bool is_free(const Scene& scene, const State& state, const std::vector<std::uint32_t>& near, const Vec3& x,
             double radius) {
    for (const std::uint32_t j : near) {
        const double reach = radius + state.bodies.radius[j];
        if ((state.bodies.position[j] - x).squaredNorm() < reach * reach) return false;
    }
    for (const Wall& wall : scene.walls) {
        if (!wall.present(state.time)) continue;
        contact::WallContacts found;
        contact::find_contacts(wall.shape, pose_at(wall.motion, state.time).to_local(x), radius, 0.0, found);
        if (found.count > 0) return false;
    }
    return true;
}

void add_body(const Scene& scene, const Plan& plan, const Inlet& inlet, const Vec3& x, double radius, State& state) {
    Bodies& bodies = state.bodies;
    bodies.id.push_back(BodyId{state.next_id++});
    bodies.radius.push_back(radius);
    bodies.mass.push_back(Bodies::sphere_mass(radius, scene.materials[raw(inlet.material)].density));
    bodies.material.push_back(inlet.material);
    bodies.position.push_back(x);
    bodies.velocity.push_back(inlet.velocity);
    if (plan.friction) bodies.spin.push_back(Vec3::Zero());
    if (plan.orientation) bodies.orientation.push_back(Quat::Identity());
    state.ledger[Work::inlets] += energy_of(bodies, bodies.size() - 1, scene.gravity.at(state.time));
}

bool run_inlet(const Scene& scene, const Plan& plan, std::size_t index, State& state) {
    const Inlet& inlet = scene.inlets[index];
    InletState& made = state.inlets[index];
    const double open = std::clamp(state.time, inlet.from, inlet.until) - inlet.from;
    const double owed = std::min(inlet.mass_rate * open, inlet.max_mass);
    std::vector<std::uint32_t> near;
    bool any = false, listed = false;
    for (;;) {
        Random size(scene.seed, kInletSizes + index, made.bodies);
        const double radius = 0.5 * draw_diameter(inlet.size, size);
        const double mass = Bodies::sphere_mass(radius, scene.materials[raw(inlet.material)].density);
        if (made.mass + mass > owed) return any;
        if (!listed) {
            double widest = largest_diameter(inlet.size);
            for (const double r : state.bodies.radius) widest = std::max(widest, r + largest_diameter(inlet.size));
            for (std::uint32_t j = 0; j < state.bodies.size(); ++j) {
                const Vec3& x = state.bodies.position[j];
                if (((x - inlet.region.lower).array() > -widest).all() &&
                    ((inlet.region.upper - x).array() > -widest).all())
                    near.push_back(j);
            }
            listed = true;
        }
        bool placed = false;
        for (int attempt = 0; attempt < kTriesAStep && !placed; ++attempt) {
            Random place(scene.seed, kInletPlaces + index, made.attempts++);
            Vec3 x;
            for (int d = 0; d < 3; ++d)
                x[d] = place.uniform(inlet.region.lower[d] + radius, inlet.region.upper[d] - radius);
            if (!is_free(scene, state, near, x, radius)) continue;
            add_body(scene, plan, inlet, x, radius, state);
            near.push_back(static_cast<std::uint32_t>(state.bodies.size() - 1));
            ++made.bodies;
            made.mass += mass;
            placed = any = true;
        }
        if (!placed) return any;  // no room now: owed until a later step
    }
}

}  // namespace

bool take_bodies(const Scene& scene, State& state) {
    Bodies& bodies = state.bodies;
    std::vector<std::uint8_t> goes;
    for (std::size_t o = 0; o < scene.outlets.size(); ++o) {
        const Outlet& outlet = scene.outlets[o];
        if (state.time < outlet.from || state.time >= outlet.until) continue;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (!contains(outlet.region, bodies.position[i]) || (!goes.empty() && goes[i] != 0)) continue;
            goes.resize(bodies.size(), 0);
            goes[i] = 1;
            ++state.outlets[o].bodies;
            state.outlets[o].mass += bodies.mass[i];
            state.ledger[Work::outlets] -= energy_of(bodies, i, scene.gravity.at(state.time));
        }
    }
    if (goes.empty()) return false;
    keep(bodies.id, goes);
    keep(bodies.radius, goes);
    keep(bodies.mass, goes);
    keep(bodies.material, goes);
    keep(bodies.position, goes);
    keep(bodies.velocity, goes);
    keep(bodies.spin, goes);
    keep(bodies.orientation, goes);
    return true;
}

bool make_bodies(const Scene& scene, const Plan& plan, State& state) {
    bool any = false;
    for (std::size_t k = 0; k < scene.inlets.size(); ++k)
        if (state.time >= scene.inlets[k].from) any = run_inlet(scene, plan, k, state) || any;
    return any;
}

}  // namespace scree::solvers
