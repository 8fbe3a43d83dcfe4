#include "solvers/substep.hpp"

#include <cmath>

#include "solvers/energy.hpp"
#include "solvers/warm_start.hpp"

namespace scree::solvers {
namespace {

// q + half v, and the orientations, if any.
void move(Bodies& bodies, double half) {
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies.position[i] += half * bodies.velocity[i];
    for (std::size_t i = 0; i < bodies.orientation.size(); ++i) {
        const Vec3 turn = half * (bodies.has_spin() ? bodies.spin[i] : Vec3::Zero());
        const double angle = turn.norm();
        if (angle > 0.0)
            bodies.orientation[i] = (Quat(Eigen::AngleAxisd(angle, turn / angle)) * bodies.orientation[i]).normalized();
    }
}

}  // namespace

template <class Law>
StepReport Substep<Law>::advance(State& state, double step, std::vector<WallLoad>& loads) {
    PhaseClock clock(state.totals);
    const contact::StepTimes times{state.time, step};
    StepReport report;
    report.step = step;
    report.bodies = state.bodies.size();

    // bodies at the middle of the step, and their contacts there
    move(state.bodies, 0.5 * step);
    find_contacts(state, times);
    report.contacts = contacts_.size();
    clock.lap(Phase::detection);

    // the contact problem, started from the last step's impulses
    set_up(state, times);
    clock.lap(Phase::setup);
    const SolveReport solved = gauss_seidel(problem_, scene_.solver);
    problem_.rebuild_lines(state, step * scene_.gravity.at(times.middle()));
    report.sweeps = solved.sweeps;
    report.residual_rms = solved.residual.rms;
    report.residual_max = solved.residual.max;
    report.converged = solved.converged;
    report.reference_velocity = problem_.reference_velocity();
    clock.lap(Phase::solve);

    // work on the mean velocities, then the new velocities and positions
    keep_ledger(state, times, report, loads);
    move(state.bodies, 0.5 * step);
    clock.lap(Phase::integration);

    if (plan_.contact_records) make_records(state, times);
    const CorrectionReport corrected = correction_.apply(scene_, step, report.active, block_size_, candidates_, state);
    state.ledger[Work::correction] += corrected.work;
    report.penetration = corrected.penetration;
    clock.lap(Phase::correction);
    return report;
}

template <class Law>
void Substep<Law>::find_contacts(State& state, const contact::StepTimes& times) {
    contact::contact_margins(scene_, state, times, margin_);
    candidates_.update(scene_, state, times.step, margin_);
    contact::find_contacts(scene_, state, times, candidates_, contacts_);
}

template <class Law>
void Substep<Law>::set_up(State& state, const contact::StepTimes& times) {
    if (block_size_ == 0.0)
        block_size_ =
            scene_.solver.block_size > 0.0 ? scene_.solver.block_size : choose_block_size(state.bodies.radius);
    layout_.arrange(contacts_, state.bodies, block_size_);
    if (plan_.moving_walls) {
        wall_velocity_.assign(contacts_.size(), Vec3::Zero());
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const contact::Contact& contact = contacts_[c];
            if (!contact.key.is_wall() || !scene_.walls[contact.b].motion.moves()) continue;
            const Vec3 point = contact.point(state.bodies.position[contact.a], state.bodies.radius[contact.a]);
            wall_velocity_[c] = mean_velocity(scene_.walls[contact.b].motion, point, times.begin, times.step);
        }
    }
    const Vec3 gravity = scene_.gravity.at(times.middle());
    problem_.assemble(contacts_, layout_, state, times.step * gravity, wall_velocity_);
    problem_.scale(times.step * gravity.norm());
    if (plan_.warm_start && problem_.driven()) {
        match_warm_start(contacts_, state.warm_start, times.step, Law::kImpulse == 3, impulse_, impulse_normal_);
        problem_.warm_start(impulse_, impulse_normal_);
    }
}

template <class Law>
void Substep<Law>::keep_ledger(State& state, const contact::StepTimes& times, StepReport& report,
                               std::vector<WallLoad>& loads) {
    Ledger& ledger = state.ledger;
    const ContactWork work = problem_.work(state);
    ledger[Work::restitution] += work.normal;
    ledger[Work::friction] += work.tangential;
    ledger.gained += work.gained;
    const Momentum before = momentum_of(state.bodies);
    if (plan_.changing_gravity) {  // potential energy that comes with gravity itself, see core/ledger.hpp
        const Vec3 begin = scene_.gravity.at(times.begin), middle = scene_.gravity.at(times.middle()),
                   end = scene_.gravity.at(times.begin + times.step);
        const Vec3 at_middle = weighted_position(state.bodies);
        const Vec3 old = at_middle - 0.5 * times.step * before.sum;
        problem_.velocities(state);
        const Vec3 last = at_middle + 0.5 * times.step * momentum_of(state.bodies).sum;
        ledger[Work::gravity] -= (end - middle).dot(last) + (middle - begin).dot(old);
    } else {
        problem_.velocities(state);
    }
    problem_.impulses(impulse_, impulse_normal_);
    keep_for_warm_start(contacts_, impulse_, impulse_normal_, times.step, state.warm_start);
    report.active = state.warm_start.key.size();

    Vec3 from_walls = Vec3::Zero();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const contact::Contact& contact = contacts_[c];
        if (!contact.key.is_wall()) continue;
        const Vec3 p = Law::kImpulse == 3 ? impulse_[c] : Vec3(impulse_normal_[c] * contact.normal);
        if (p.isZero(0.0)) continue;
        from_walls += p;
        WallLoad& load = loads[contact.b];
        load.impulse -= p;
        load.angular -= contact.point(state.bodies.position[contact.a], state.bodies.radius[contact.a]).cross(p);
        ++load.contacts;
        if (!wall_velocity_.empty()) ledger[Work::walls] += p.dot(wall_velocity_[c]);
    }
    const Momentum after = momentum_of(state.bodies);
    if (!std::isfinite(after.size))
        throw PhysicsError("the velocities are no longer finite at t = " + std::to_string(times.begin) + " s");
    const Vec3 error =
        after.sum - before.sum - times.step * after.mass * scene_.gravity.at(times.middle()) - from_walls;
    // bodies at rest have no momentum to compare with: the step's weight stands in
    const double size = after.size + times.step * after.mass * scene_.gravity.at(times.middle()).norm();
    if (size > 0.0) report.momentum_error = error.norm() / size;
}

template <class Law>
void Substep<Law>::make_records(const State& state, const contact::StepTimes& times) {
    records_.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const contact::Contact& contact = contacts_[c];
        const Vec3 p = Law::kImpulse == 3 ? impulse_[c] : Vec3(impulse_normal_[c] * contact.normal);
        const double pn = p.dot(contact.normal);
        ContactStatus status = ContactStatus::open;
        if (pn > 0.0) {
            const double tangential = (p - pn * contact.normal).norm();
            status =
                tangential < (1.0 - 1e-9) * contact.friction * pn ? ContactStatus::sticking : ContactStatus::sliding;
        }
        // the contact point of the middle of the step: the bodies have moved on by half a step since
        const Bodies& bodies = state.bodies;
        const Vec3 moved_a = 0.5 * times.step * bodies.velocity[contact.a];
        const Vec3 middle_a = bodies.position[contact.a] - moved_a;
        double gap = contact.gap;  // at the end of the step; at a wall to first order of the motion
        if (!contact.key.is_wall())
            gap = (bodies.position[contact.a] - bodies.position[contact.b]).norm() -
                  (bodies.radius[contact.a] + bodies.radius[contact.b]);
        else
            gap += contact.normal.dot(
                moved_a - (wall_velocity_.empty() ? Vec3::Zero() : Vec3(0.5 * times.step * wall_velocity_[c])));
        records_.push_back({contact.key, contact.point(middle_a, bodies.radius[contact.a]), contact.normal, gap, p,
                            times.step, status});
    }
}

template <class Law>
void Substep<Law>::bodies_changed() {
    candidates_.invalidate();
    block_size_ = 0.0;
}

template <class Law>
std::size_t Substep<Law>::bytes() const {
    return candidates_.bytes() + contacts_.capacity() * sizeof(contact::Contact) + layout_.bytes() + problem_.bytes() +
           correction_.bytes() + margin_.capacity() * sizeof(double) +
           (wall_velocity_.capacity() + impulse_.capacity()) * sizeof(Vec3) +
           impulse_normal_.capacity() * sizeof(double) + records_.capacity() * sizeof(ContactRecord);
}

template class Substep<Frictional>;
template class Substep<Frictionless>;

}  // namespace scree::solvers
