#include "solvers/find_overlaps.hpp"

#include <algorithm>

#include "contact/cell_grid.hpp"
#include "contact/contact_home.hpp"
#include "contact/polyhedra/narrow_phase.hpp"
#include "core/parallel/domain.hpp"
#include "solvers/layout.hpp"

namespace scree::solvers {

namespace {

// The bodies of `state` and those of other ranks that may touch them.
State with_neighbours(const Scene& scene, const State& state, Domain& domain) {
    State near;
    near.time = state.time;
    near.bodies = state.bodies;
    near.shapes = state.shapes;
    near.block_size = state.block_size;
    if (near.block_size == 0.0) near.block_size = scene.solver.block_size;
    if (near.block_size == 0.0) near.block_size = choose_block_size(near.bodies, domain.ranks());
    if (near.block_size == 0.0) near.block_size = 1.0;  // no bodies
    domain.start(near, std::vector<double>(near.bodies.size(), 0.0), 0.0);
    return near;
}

// What touches, bodies of any shape, by the narrow phase of the step.
class Touching {
  public:
    Touching(const State& state, std::size_t pairs) : state_(state) { narrow_.place(state, pairs); }

    template <class Add>
    void pair(std::uint32_t i, std::uint32_t j, const Add& add) {
        const Bodies& bodies = state_.bodies;
        for (const contact::ManifoldPoint& p : narrow_.pair(i, j, 0.0, Vec3::Zero()))
            add(contact::Contact{ContactKey::bodies(bodies.id[i], bodies.id[j], p.key), i, j, p.normal, p.gap, 0.0,
                                 0.0},
                p.point);
    }
    template <class Add>
    void wall(const Wall& wall, std::uint32_t w, std::uint32_t i, const Add& add) {
        const contact::WallFrame frame{true, wall.motion.moves(), pose_at(wall.motion, state_.time), {}, false};
        for (const contact::WallPoint& p : narrow_.wall(wall.shape, frame, i, 0.0))
            add(contact::Contact{ContactKey::wall(state_.bodies.id[i], WallIndex{w}, p.feature, p.part), i, w, p.normal,
                                 p.gap, 0.0, 0.0},
                p.point);
    }

  private:
    const State& state_;
    contact::NarrowPhase narrow_;
};

}  // namespace

std::vector<Overlap> find_overlaps(const Scene& scene, const State& state, double relative, const Communicator& ranks) {
    Domain domain(ranks);
    const State near = ranks.alone() ? State{} : with_neighbours(scene, state, domain);
    const State& here = ranks.alone() ? state : near;
    const Bodies& bodies = here.bodies;
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
    Touching touching(here, pairs.size());
    const auto add = [&](const contact::Contact& c, const Vec3& point) {
        const double radius = bodies.radius[c.a];
        const double smaller = c.key.is_wall() ? radius : std::min(radius, bodies.radius[c.b]);
        if (-c.gap <= relative * smaller || !contact::solved_here(c, here, domain, [&] { return point; })) return;
        const bool same = !overlaps.empty() && overlaps.back().key.a == c.key.a && overlaps.back().key.b == c.key.b;
        if (same && !bodies.is_sphere(c.a) && overlaps.back().depth >= -c.gap) return;  // one a pair: the deepest point
        if (same && !bodies.is_sphere(c.a)) overlaps.pop_back();
        overlaps.push_back({c.key, -c.gap, point});
    };
    for (const auto& [i, j] : pairs) touching.pair(i, j, add);
    for (std::uint32_t w = 0; w < scene.walls.size(); ++w) {
        if (!scene.walls[w].present(here.time)) continue;
        for (std::uint32_t i = 0; i < bodies.size(); ++i) touching.wall(scene.walls[w], w, i, add);
    }
    return overlaps;
}

}  // namespace scree::solvers
