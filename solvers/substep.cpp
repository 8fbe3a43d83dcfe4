#include "solvers/substep.hpp"

#include <array>
#include <cmath>

#include "solvers/energy.hpp"
#include "solvers/rotation.hpp"
#include "solvers/warm_start.hpp"

namespace scree::solvers {
namespace {

constexpr std::size_t kLoadSums = 6;           // a wall: impulse and angular impulse
constexpr std::uint64_t kContactWork = 4;      // of a contact in a step, where a body is 1
constexpr std::uint64_t kStepsOfBalance = 64;  // between looks at how work is shared, at the most

}  // namespace

template <class Law>
StepReport Substep<Law>::advance(State& state, double step, std::vector<WallLoad>& loads) {
    PhaseClock clock(state.totals);
    const contact::StepTimes times{state.time, step};
    StepReport report;
    report.step = step;

    // bodies at the middle of the step, and their contacts there
    rotation_gain_ = ExactSum{};
    move(state.bodies, 0.5 * step);
    find_contacts(state, times);
    clock.lap(Phase::detection);

    // the contact problem, started from the last step's impulses
    set_up(state, times);
    clock.lap(Phase::setup);
    const SolveReport solved = gauss_seidel(problem_, scene_.solver);
    problem_.rebuild_lines();
    report.contacts = problem_.contacts();
    report.sweeps = solved.sweeps;
    report.residual_rms = solved.residual.rms;
    report.residual_max = solved.residual.max;
    report.converged = solved.converged;
    report.reference_velocity = problem_.reference_velocity();
    clock.lap(Phase::solve);

    // work on the mean velocities, then the new velocities and positions
    keep_ledger(state, times, report, loads);
    CorrectionReport corrected;
    if constexpr (kRigid) corrected = correct(state, step);  // where normals and arms are known
    move(state.bodies, 0.5 * step);
    clock.lap(Phase::integration);

    if (plan_.contact_records) make_records(state, times);
    if constexpr (!kRigid) corrected = correct(state, step);
    state.ledger[Work::correction] += corrected.work;
    report.penetration = corrected.penetration;
    if constexpr (kRigid) state.ledger[Work::rotation] += domain_.ranks().sum(rotation_gain_);
    clock.lap(Phase::correction);
    return report;
}

// Positions and, if anybody needs them, orientations, by `time` times the velocities.
template <class Law>
void Substep<Law>::move(Bodies& bodies, double time) {
    if constexpr (kRigid) {
        move_freely(bodies, time, rotation_gain_);
        return;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies.position[i] += time * bodies.velocity[i];
    for (std::size_t i = 0; i < bodies.orientation.size(); ++i)
        if (bodies.has_spin()) bodies.orientation[i] = turned(bodies.orientation[i], time * bodies.spin[i]);
}

template <class Law>
CorrectionReport Substep<Law>::correct(State& state, double step) {
    if constexpr (kRigid)
        return correction_.apply(scene_, step, active_, {contacts_, points_, wall_velocity_, layout_}, exchange_,
                                 domain_, state);
    else
        return correction_.apply(scene_, step, active_, candidates_, domain_, state);
}

// Half-way between the surfaces, of contact c, with the bodies at the middle of the step.
template <class Law>
Vec3 Substep<Law>::point_of(std::size_t c, const Bodies& bodies) const {
    if constexpr (kRigid) return points_[c];
    const contact::Contact& contact = contacts_[c];
    return contact.point(bodies.position[contact.a], bodies.radius[contact.a]);
}

template <class Law>
void Substep<Law>::find_contacts(State& state, const contact::StepTimes& times) {
    const Communicator& ranks = domain_.ranks();
    const bool finite = contact::contact_margins(scene_, state, times, margin_);
    std::array<std::uint64_t, 2> lacks{finite ? 0U : 1U, domain_.covers(state, margin_) ? 0U : 1U};
    ranks.max(lacks);
    if (lacks[0] != 0)
        throw PhysicsError("the velocities are no longer finite at t = " + std::to_string(times.begin) + " s");
    const bool lapsed = lacks[1] != 0, look = lapsed || state.step % kStepsOfBalance == 0;
    const bool cut = look && domain_.balance(state, [this](std::vector<BlockWork>& work) { add_work(work); });
    if (lapsed || cut) {
        domain_.settle(state, margin_, times.step);
        candidates_.invalidate();
        contact::contact_margins(scene_, state, times, margin_);
    }
    candidates_.update(scene_, state, times.step, margin_, ranks);
    if constexpr (kRigid)
        finder_.find(scene_, state, times, candidates_, domain_, contacts_, points_);
    else
        contact::find_contacts(scene_, state, times, candidates_, domain_, contacts_);
}

template <class Law>
void Substep<Law>::set_up(State& state, const contact::StepTimes& times) {
    layout_.arrange(contacts_, state.bodies, state.block_size, domain_.halo().shared_flags(), points_);
    exchange_.set_up(domain_.ranks(), domain_.halo(), contacts_, layout_, kFrictional || kRigid ? 6 : 3);
    if (plan_.moving_walls) {
        wall_velocity_.assign(contacts_.size(), Vec3::Zero());
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const contact::Contact& contact = contacts_[c];
            if (!contact.key.is_wall() || !scene_.walls[contact.b].motion.moves()) continue;
            wall_velocity_[c] =
                mean_velocity(scene_.walls[contact.b].motion, point_of(c, state.bodies), times.begin, times.step);
        }
    }
    const Vec3 gravity = scene_.gravity.at(times.middle());
    problem_.assemble(contacts_, layout_, state, times.step * gravity, wall_velocity_, points_);
    problem_.scale(times.step * gravity.norm());
    if (plan_.warm_start && problem_.driven()) {
        start_impulses(state, times.step);
        problem_.warm_start(impulse_, impulse_normal_);
    }
}

// The last step's impulses, in impulse_ or impulse_normal_; contacts that are new get 0.
template <class Law>
void Substep<Law>::start_impulses(const State& state, double step) {
    if (kFrictional)
        impulse_.assign(contacts_.size(), Vec3::Zero());
    else
        impulse_normal_.assign(contacts_.size(), 0.0);
    unmatched_.clear();
    match_warm_start(contacts_, state.warm_start, step, kFrictional, impulse_, impulse_normal_,
                     domain_.alone() ? nullptr : &unmatched_);
    if (domain_.alone()) return;
    const WarmStart came = domain_.halo().pass_on(state.warm_start, unmatched_, state.bodies);
    match_warm_start(contacts_, came, step, kFrictional, impulse_, impulse_normal_);
}

template <class Law>
void Substep<Law>::keep_ledger(State& state, const contact::StepTimes& times, StepReport& report,
                               std::vector<WallLoad>& loads) {
    const Communicator& ranks = domain_.ranks();
    const Vec3 gravity = scene_.gravity.at(times.middle());
    // all sums over bodies and contacts of this step, in one reduction
    constexpr std::size_t kWork = 0, kBefore = 3, kAfter = kBefore + kMomentumSums, kPlace = kAfter + kMomentumSums,
                          kWalls = kPlace + kPositionSums, kSums = kWalls + 4;
    sums_.assign(kSums + kLoadSums * loads.size(), ExactSum{});
    const std::span<ExactSum, kSums> all = std::span(sums_).template first<kSums>();
    problem_.add_work(state, all.template subspan<kWork, 3>());
    add_momentum(state.bodies, all.template subspan<kBefore, kMomentumSums>());
    if (plan_.changing_gravity) add_weighted_position(state.bodies, all.template subspan<kPlace, kPositionSums>());
    problem_.velocities(state);
    add_momentum(state.bodies, all.template subspan<kAfter, kMomentumSums>());
    problem_.impulses(impulse_, impulse_normal_);
    keep_for_warm_start(contacts_, impulse_, impulse_normal_, times.step, state.warm_start);
    active_ = state.warm_start.key.size();
    counts_.assign(2 + loads.size(), 0);
    counts_[0] = state.bodies.owned();
    counts_[1] = active_;
    add_wall_loads(state, all.template subspan<kWalls, 4>(), std::span(sums_).subspan(kSums),
                   std::span(counts_).subspan(2));
    ranks.sum(std::span<ExactSum>(sums_));
    ranks.sum(std::span<std::uint64_t>(counts_));
    report.bodies = counts_[0];
    report.active = counts_[1];
    for (std::size_t w = 0; w < loads.size(); ++w) {
        const ExactSum* load = sums_.data() + kSums + kLoadSums * w;
        loads[w].impulse -= Vec3(load[0].value(), load[1].value(), load[2].value());
        loads[w].angular -= Vec3(load[3].value(), load[4].value(), load[5].value());
        loads[w].contacts += counts_[2 + w];
    }

    Ledger& ledger = state.ledger;
    ledger[Work::restitution] += all[kWork].value();
    ledger[Work::friction] += all[kWork + 1].value();
    ledger.gained += all[kWork + 2].value();
    ledger[Work::walls] += all[kWalls + 3].value();
    const Momentum before = read_momentum(all.template subspan<kBefore, kMomentumSums>());
    const Momentum after = read_momentum(all.template subspan<kAfter, kMomentumSums>());
    if (plan_.changing_gravity) {  // potential energy that comes with gravity itself, see core/ledger.hpp
        const Vec3 begin = scene_.gravity.at(times.begin), end = scene_.gravity.at(times.begin + times.step);
        const Vec3 at_middle = read_weighted_position(all.template subspan<kPlace, kPositionSums>());
        const Vec3 old = at_middle - 0.5 * times.step * before.sum, last = at_middle + 0.5 * times.step * after.sum;
        ledger[Work::gravity] -= (end - gravity).dot(last) + (gravity - begin).dot(old);
    }
    if (!std::isfinite(after.size))
        throw PhysicsError("the velocities are no longer finite at t = " + std::to_string(times.begin) + " s");
    const Vec3 from_walls(all[kWalls].value(), all[kWalls + 1].value(), all[kWalls + 2].value());
    const Vec3 error = after.sum - before.sum - times.step * after.mass * gravity - from_walls;
    // bodies at rest have no momentum to compare with: the step's weight stands in
    const double size = after.size + times.step * after.mass * gravity.norm();
    if (size > 0.0) report.momentum_error = error.norm() / size;
}

// Adds what this rank's contacts did to the walls; `sums`: impulse from the walls (3) and their work; `load`: impulse
// and angular impulse of each wall, `contacts`: how many.
template <class Law>
void Substep<Law>::add_wall_loads(const State& state, std::span<ExactSum, 4> sums, std::span<ExactSum> load,
                                  std::span<std::uint64_t> contacts) const {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const contact::Contact& contact = contacts_[c];
        if (!contact.key.is_wall()) continue;
        const Vec3 p = kFrictional ? impulse_[c] : Vec3(impulse_normal_[c] * contact.normal);
        if (p.isZero(0.0)) continue;
        const Vec3 turn = point_of(c, state.bodies).cross(p);
        ExactSum* of_wall = load.data() + kLoadSums * contact.b;
        for (int d = 0; d < 3; ++d) {
            of_wall[d].add(p[d]);
            of_wall[3 + d].add(turn[d]);
        }
        ++contacts[contact.b];
        if (!wall_velocity_.empty()) sums[3].add(p.dot(wall_velocity_[c]));
    }
    for (std::size_t w = 0; w < contacts.size(); ++w)
        for (std::size_t d = 0; d < 3; ++d) sums[d].add(load[kLoadSums * w + d]);
}

template <class Law>
void Substep<Law>::make_records(const State& state, const contact::StepTimes& times) {
    records_.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const contact::Contact& contact = contacts_[c];
        const Vec3 p = kFrictional ? impulse_[c] : Vec3(impulse_normal_[c] * contact.normal);
        const double pn = p.dot(contact.normal);
        ContactStatus status = ContactStatus::open;
        if (pn > 0.0) {
            const double tangential = (p - pn * contact.normal).norm();
            status =
                tangential < (1.0 - 1e-9) * contact.friction * pn ? ContactStatus::sticking : ContactStatus::sliding;
        }
        // the contact point of the middle of the step, the gap of its end
        const Bodies& bodies = state.bodies;
        if constexpr (kRigid) {
            records_.push_back({contact.key, points_[c], contact.normal, correction_.gaps()[c], p, times.step, status});
            continue;
        }
        const Vec3 moved_a = 0.5 * times.step * bodies.velocity[contact.a];
        const Vec3 middle_a = bodies.position[contact.a] - moved_a;
        double gap = contact.gap;  // at a wall to first order of the motion
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
void Substep<Law>::add_work(std::vector<BlockWork>& work) const {
    for (const contact::ContactHome& home : layout_.homes()) work.push_back({home.block, kContactWork});
}

template <class Law>
Traffic Substep<Law>::traffic() {
    Traffic all = domain_.halo().traffic();
    for (const Traffic& t : {exchange_.traffic(), correction_.traffic()}) {
        all.messages += t.messages;
        all.bytes += t.bytes;
        all.wait_seconds += t.wait_seconds;
    }
    return all;
}

template <class Law>
std::size_t Substep<Law>::bytes() const {
    return candidates_.bytes() + contacts_.capacity() * sizeof(contact::Contact) + layout_.bytes() + problem_.bytes() +
           correction_.bytes() + margin_.capacity() * sizeof(double) +
           (wall_velocity_.capacity() + impulse_.capacity()) * sizeof(Vec3) +
           impulse_normal_.capacity() * sizeof(double) + points_.capacity() * sizeof(Vec3) +
           records_.capacity() * sizeof(ContactRecord);
}

template class Substep<Frictional>;
template class Substep<Frictionless>;
template class Substep<RigidFrictional>;
template class Substep<RigidFrictionless>;

}  // namespace scree::solvers
