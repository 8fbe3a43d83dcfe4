#include "solvers/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "contact/walls/wall_contact.hpp"
#include "solvers/energy.hpp"
#include "solvers/flows.hpp"
#include "solvers/substep.hpp"

namespace scree::solvers {
namespace {

constexpr int kMostHalvings = 20;
constexpr std::uint64_t kStepsOfBlocks = 256;  // between looks at the sizes of what inlets brought

// Fastest thin wall near body i [m/s]: a wall can pass a body as a body can pass a wall.
double thin_wall_speed(const Scene& scene, const State& state, std::size_t i, double step) {
    double fastest = 0.0;
    for (const Wall& wall : scene.walls)
        if (wall.motion.moves() && wall.present(state.time + 0.5 * step) && contact::is_thin(wall.shape))
            fastest = std::max(
                fastest, speed_bound(wall.motion, state.bodies.position[i], state.bodies.radius[i], state.time, step));
    return fastest;
}

// Of the largest ball within body i [m].
double inner_radius(const State& state, std::size_t i) {
    const Bodies& bodies = state.bodies;
    return bodies.is_sphere(i) ? bodies.radius[i] : state.shapes[raw(bodies.shape[i])].inner_radius;
}

// Into how many equal substeps this step is cut, a power of two: no body moves more than max_travel of its radius,
// relative to the thin walls.
int substeps(const Scene& scene, const Plan& plan, const State& state, const Communicator& ranks) {
    if (scene.time.max_travel <= 0.0) return 1;
    const double h = scene.time.step, g = scene.gravity.at(state.time + 0.5 * h).norm();
    double most = 0.0;  // radii moved in this step
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        double speed = state.bodies.velocity[i].norm() + h * g;
        if (plan.moving_walls) speed += thin_wall_speed(scene, state, i, h);
        most = std::max(most, h * speed / inner_radius(state, i));
    }
    most = ranks.max(most);
    if (most <= scene.time.max_travel) return 1;
    const bool can_pass =
        ranks.sum(static_cast<std::uint64_t>(state.bodies.owned())) > 1 ||
        std::any_of(scene.walls.begin(), scene.walls.end(), [](const Wall& w) { return contact::is_thin(w.shape); });
    if (!can_pass) return 1;
    int n = 1;
    for (int k = 0; k < kMostHalvings && most / n > scene.time.max_travel; ++k) n *= 2;
    return n;
}

void add_to_totals(const StepReport& report, RunTotals& totals) {
    ++totals.steps;
    totals.steps_not_converged += report.converged ? 0 : 1;
    totals.sweeps += static_cast<std::uint64_t>(report.sweeps);
    totals.sweeps_max = std::max(totals.sweeps_max, report.sweeps);
    totals.contact_updates += static_cast<std::uint64_t>(report.sweeps) * report.contacts;
    totals.momentum_error_max = std::max(totals.momentum_error_max, report.momentum_error);
    if (report.contacts == 0) return;
    ++totals.steps_with_contacts;
    totals.residual_sum += report.residual_rms;
    totals.residual_max = std::max(totals.residual_max, report.residual_rms);
    totals.penetration_max = std::max(totals.penetration_max, report.penetration.max);
    totals.penetration_max_relative = std::max(totals.penetration_max_relative, report.penetration.max_relative);
    totals.penetration_mean_sum += report.penetration.mean;
    totals.penetration_mean_relative_sum += report.penetration.mean_relative;
}

// The worst of the substeps stands for the step.
void merge(const StepReport& part, StepReport& whole) {
    whole.bodies = part.bodies;
    whole.contacts = part.contacts;
    whole.active = part.active;
    whole.step += part.step;
    whole.sweeps += part.sweeps;
    whole.residual_rms = std::max(whole.residual_rms, part.residual_rms);
    whole.residual_max = std::max(whole.residual_max, part.residual_max);
    whole.reference_velocity = part.reference_velocity;
    whole.converged = whole.converged && part.converged;
    whole.momentum_error = std::max(whole.momentum_error, part.momentum_error);
    whole.penetration = part.penetration;
}

}  // namespace

struct Stepper::Impl {
    const Scene& scene;
    const Plan& plan;
    const Communicator& ranks;
    Domain domain;
    std::variant<Substep<Frictional>, Substep<Frictionless>, Substep<RigidFrictional>, Substep<RigidFrictionless>>
        substep;
    std::vector<WallLoad> loads;
    double last_step = 0.0;
    std::vector<double> margin;  // scratch

    Impl(const Scene& s, const Plan& p, const Communicator& r)
        : scene(s), plan(p), ranks(r), domain(r), substep(std::in_place_type<Substep<Frictionless>>, s, p, domain) {
        if (p.polyhedra && p.friction)
            substep.emplace<Substep<RigidFrictional>>(s, p, domain);
        else if (p.polyhedra)
            substep.emplace<Substep<RigidFrictionless>>(s, p, domain);
        else if (p.friction)
            substep.emplace<Substep<Frictional>>(s, p, domain);
        loads.resize(s.walls.size());
    }
    void start(State& state);
    void choose_blocks(State& state);
    StepReport advance(State& state);
};

Stepper::Stepper(const Scene& scene, const Plan& plan, const Communicator& ranks)
    : impl_(std::make_unique<Impl>(scene, plan, ranks)) {}
Stepper::~Stepper() = default;

// Blocks follow the sizes of the bodies; those of inlets may be others than those of the start.
void Stepper::Impl::choose_blocks(State& state) {
    if (state.block_size > 0.0 && !(plan.inlets && state.step % kStepsOfBlocks == 0)) return;
    const double size =
        scene.solver.block_size > 0.0 ? scene.solver.block_size : choose_block_size(state.bodies, ranks);
    if (size == 0.0 || size == state.block_size) return;  // no bodies yet
    state.block_size = size;
    domain.forget();
}

void Stepper::Impl::start(State& state) {
    choose_blocks(state);
    if (domain.started() || state.block_size == 0.0) return;
    contact::contact_margins(scene, state, {state.time, scene.time.step}, margin);
    domain.start(state, margin, scene.time.step);
    std::visit([](auto& s) { s.bodies_changed(); }, substep);
}

StepReport Stepper::Impl::advance(State& state) {
    start(state);
    std::fill(loads.begin(), loads.end(), WallLoad{});
    const int parts = substeps(scene, plan, state, ranks);
    if (parts > 1) ++state.totals.substepped;
    const double begin = state.time, h = scene.time.step / parts;
    StepReport whole;
    for (int k = 0; k < parts; ++k) {
        state.time = begin + k * h;
        const StepReport part = std::visit([&](auto& s) { return s.advance(state, h, loads); }, substep);
        add_to_totals(part, state.totals);
        merge(part, whole);
    }
    ++state.step;
    state.time = static_cast<double>(state.step) * scene.time.step;
    last_step = scene.time.step;
    bool changed = plan.outlets && take_bodies(scene, state, ranks);
    changed = (plan.inlets && make_bodies(scene, plan, state, ranks)) || changed;
    if (changed) {
        domain.halo().follow(state.bodies);
        std::visit([](auto& s) { s.bodies_changed(); }, substep);
    }
    update_energies(scene, state, ranks);
    return whole;
}

void Stepper::start(State& state) {
    impl_->start(state);
}

RankReport Stepper::rank_report(const State& state) const {
    const Halo& halo = impl_->domain.halo();
    const Traffic traffic = std::visit([](auto& s) { return s.traffic(); }, impl_->substep);
    RankReport report;
    report.own = state.bodies.owned();
    report.ghosts = state.bodies.size() - report.own;
    report.contacts = std::visit([](const auto& s) { return s.contacts(); }, impl_->substep);
    report.neighbours = halo.neighbours().size();
    report.messages = traffic.messages;
    report.bytes = traffic.bytes;
    report.wait_seconds = traffic.wait_seconds;
    report.repartitions = impl_->domain.repartitions();
    report.migrated = halo.migrated();
    report.imbalance = impl_->domain.imbalance();
    return report;
}

StepReport Stepper::advance(State& state) {
    return impl_->advance(state);
}

const std::vector<ContactRecord>& Stepper::contacts() const {
    return std::visit([](const auto& s) -> const std::vector<ContactRecord>& { return s.records(); }, impl_->substep);
}
const std::vector<WallLoad>& Stepper::wall_loads() const {
    return impl_->loads;
}
double Stepper::last_step() const {
    return impl_->last_step;
}
std::size_t Stepper::bytes() const {
    return std::visit([](const auto& s) { return s.bytes(); }, impl_->substep);
}

}  // namespace scree::solvers
