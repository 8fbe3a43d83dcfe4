#include "solvers/flows.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "contact/walls/wall_contact.hpp"
#include "core/random.hpp"
#include "solvers/energy.hpp"

namespace scree::solvers {
namespace {

constexpr std::uint64_t kInletSizes = 0x1000, kInletPlaces = 0x2000;  // streams of random numbers
constexpr std::size_t kTriesAStep = 200;                              // places tried for one body in one step
// Places that ranks agree on at once: the first few are often free.
constexpr std::size_t kFirstPlaces = 8, kPlacesAtOnce = 96;

template <class T>
void keep(std::vector<T>& values, const std::vector<std::uint8_t>& goes) {
    if (values.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (goes[i] == 0) values[to++] = values[i];
    values.resize(to);
}
void remove(const std::vector<std::uint8_t>& goes, Bodies& bodies) {
    keep(bodies.id, goes);
    keep(bodies.radius, goes);
    keep(bodies.mass, goes);
    keep(bodies.material, goes);
    keep(bodies.position, goes);
    keep(bodies.velocity, goes);
    keep(bodies.spin, goes);
    keep(bodies.orientation, goes);
    keep(bodies.shape, goes);
    keep(bodies.inertia, goes);
    keep(bodies.ghost, goes);
}

// A body that came in this step. It is on rank 0, but what comes after it must not overlap it, on any rank.
struct Arrival {
    Vec3 position;
    double radius;
};

bool apart(const Vec3& a, const Vec3& b, double reach) {
    return (a - b).squaredNorm() >= reach * reach;
}

// What an inlet's new bodies may meet on this rank.
struct Surroundings {
    const Scene& scene;
    const State& state;
    std::vector<std::uint32_t> near;  // bodies
    const std::vector<Arrival>& arrivals;

    bool is_free(const Vec3& x, double radius) const {
        const Bodies& bodies = state.bodies;
        for (const std::uint32_t j : near)
            if (!apart(bodies.position[j], x, radius + bodies.radius[j])) return false;
        for (const Arrival& a : arrivals)
            if (!apart(a.position, x, radius + a.radius)) return false;
        for (const Wall& wall : scene.walls) {
            if (!wall.present(state.time)) continue;
            contact::WallContacts found;
            contact::find_contacts(wall.shape, pose_at(wall.motion, state.time).to_local(x), radius, 0.0, found);
            if (found.count > 0) return false;
        }
        return true;
    }
};

// Bodies from which a new body of this inlet may be no further than they touch.
std::vector<std::uint32_t> bodies_near(const Inlet& inlet, const Bodies& bodies) {
    std::vector<std::uint32_t> near;
    const double largest = largest_diameter(inlet.size);
    for (std::uint32_t j = 0; j < bodies.size(); ++j) {
        const Vec3& x = bodies.position[j];
        const double reach = bodies.radius[j] + largest;
        if (((x - inlet.region.lower).array() > -reach).all() && ((inlet.region.upper - x).array() > -reach).all())
            near.push_back(j);
    }
    return near;
}

// The next of the inlet's random places where a sphere is free on every rank. Ranks agree on several places at once;
// the places after the one taken are drawn again for the next body.
std::optional<Vec3> find_place(const Surroundings& around, std::size_t index, double radius, std::uint64_t& attempts,
                               const Communicator& ranks) {
    const BoxRegion& region = around.scene.inlets[index].region;
    std::array<Vec3, kPlacesAtOnce> place;
    std::array<std::uint64_t, kPlacesAtOnce> blocked{};
    std::size_t at_once = ranks.alone() ? 1 : kFirstPlaces;
    for (std::size_t tried = 0; tried < kTriesAStep;) {
        const std::size_t n = std::min(at_once, kTriesAStep - tried);
        for (std::size_t k = 0; k < n; ++k) {
            Random draw(around.scene.seed, kInletPlaces + index, attempts + k);
            for (int d = 0; d < 3; ++d) place[k][d] = draw.uniform(region.lower[d] + radius, region.upper[d] - radius);
            blocked[k] = around.is_free(place[k], radius) ? 0 : 1;
        }
        ranks.max(std::span(blocked).first(n));
        for (std::size_t k = 0; k < n; ++k) {
            ++attempts;
            if (blocked[k] == 0) return place[k];
        }
        tried += n;
        if (!ranks.alone()) at_once = kPlacesAtOnce;
    }
    return std::nullopt;
}

void add_body(const Plan& plan, const Inlet& inlet, const Arrival& made, double mass, Bodies& bodies, BodyId id) {
    bodies.id.push_back(id);
    bodies.radius.push_back(made.radius);
    bodies.mass.push_back(mass);
    bodies.material.push_back(inlet.material);
    bodies.position.push_back(made.position);
    bodies.velocity.push_back(inlet.velocity);
    if (plan.spin) bodies.spin.push_back(Vec3::Zero());
    if (plan.orientation) bodies.orientation.push_back(Quat::Identity());
    if (plan.polyhedra) {  // inlets make spheres
        bodies.shape.push_back(kSphere);
        bodies.inertia.push_back(Vec3::Constant(Bodies::kSphereInertia * mass * made.radius * made.radius));
    }
    if (!bodies.ghost.empty()) bodies.ghost.push_back(0);
}

// Every rank draws the same bodies and agrees on their places; rank 0 gets them.
void run_inlet(const Scene& scene, const Plan& plan, std::size_t index, State& state, std::vector<Arrival>& arrivals,
               const Communicator& ranks) {
    const Inlet& inlet = scene.inlets[index];
    InletState& made = state.inlets[index];
    const double open = std::clamp(state.time, inlet.from, inlet.until) - inlet.from;
    const double owed = std::min(inlet.mass_rate * open, inlet.max_mass);
    Surroundings around{scene, state, {}, arrivals};
    for (bool listed = false;; listed = true) {
        Random size(scene.seed, kInletSizes + index, made.bodies);
        const double radius = 0.5 * draw_diameter(inlet.size, size);
        const double mass = Bodies::sphere_mass(radius, scene.materials[raw(inlet.material)].density);
        if (made.mass + mass > owed) return;
        if (!listed) around.near = bodies_near(inlet, state.bodies);
        const std::optional<Vec3> place = find_place(around, index, radius, made.attempts, ranks);
        if (!place) return;  // no room now: owed until a later step
        arrivals.push_back({*place, radius});
        const BodyId id{state.next_id++};
        if (ranks.root()) add_body(plan, inlet, arrivals.back(), mass, state.bodies, id);
        ++made.bodies;
        made.mass += mass;
        state.ledger[Work::inlets] +=
            0.5 * mass * inlet.velocity.squaredNorm() - mass * scene.gravity.at(state.time).dot(*place);
    }
}

}  // namespace

bool take_bodies(const Scene& scene, State& state, const Communicator& ranks) {
    Bodies& bodies = state.bodies;
    const auto is_open = [&](const Outlet& o) { return state.time >= o.from && state.time < o.until; };
    if (std::none_of(scene.outlets.begin(), scene.outlets.end(), is_open)) return false;
    std::vector<std::uint8_t> goes;
    std::vector<ExactSum> taken(2 * scene.outlets.size() + 1);  // number and mass, one pair an outlet; energy
    for (std::size_t o = 0; o < scene.outlets.size(); ++o) {
        if (!is_open(scene.outlets[o])) continue;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (!contains(scene.outlets[o].region, bodies.position[i]) || (!goes.empty() && goes[i] != 0)) continue;
            goes.resize(bodies.size(), 0);
            goes[i] = 1;
            if (bodies.is_ghost(i)) continue;  // it goes from its own rank too, which counts it
            taken[2 * o].add(1.0);
            taken[2 * o + 1].add(bodies.mass[i]);
            taken.back().add_any(energy_of(bodies, i, scene.gravity.at(state.time)));
        }
    }
    ranks.sum(taken);
    bool any = false;
    for (std::size_t o = 0; o < scene.outlets.size(); ++o) {
        const double number = taken[2 * o].value();
        state.outlets[o].bodies += static_cast<std::uint64_t>(number);
        state.outlets[o].mass += taken[2 * o + 1].value();
        any = any || number > 0.0;
    }
    state.ledger[Work::outlets] -= taken.back().value();
    if (!goes.empty()) remove(goes, bodies);
    return any;
}

bool make_bodies(const Scene& scene, const Plan& plan, State& state, const Communicator& ranks) {
    std::vector<Arrival> arrivals;
    for (std::size_t k = 0; k < scene.inlets.size(); ++k)
        if (state.time >= scene.inlets[k].from) run_inlet(scene, plan, k, state, arrivals, ranks);
    return !arrivals.empty();
}

}  // namespace scree::solvers
