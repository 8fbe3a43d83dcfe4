#include "solvers/contact_problem.hpp"

#include <array>
#include <cmath>

#include "solvers/body_lines.hpp"
#include "solvers/kernels.hpp"
#include "solvers/rigid_assembly.hpp"
#include "solvers/rigid_kernels.hpp"

namespace scree::solvers {
namespace {

constexpr double kRoundOff = 1e-12;  // of the largest velocity, in differences of velocities

}  // namespace

template <class Law>
void ContactProblem<Law>::free_lines() {
    const Bodies& bodies = state_->bodies;
    for (std::size_t i = 0; i < bodies_; ++i) {
        set_body(full_.line[layout_->line(i)], bodies, i, bodies.velocity[i] + dv_free_);
    }
}

template <class Law>
void ContactProblem<Law>::rebuild_lines() {
    if (!swept_) return;
    swept_ = false;
    free_lines();
    full_.over_blocks(*layout_, exchange_, [&](std::uint32_t k) { apply(full_.batch[k], full_.line.data()); });
    full_.complete(exchange_);
    if (exchange_ != nullptr) exchange_->spread(full_.line.data());
}

// Of a batch that knows the lane's lines. `point`: of bodies that are not spheres.
template <class Law>
void ContactProblem<Law>::fill_lane(Batch& batch, int lane, const contact::Contact& contact, const Vec3* point) {
    const Line &a = full_.line[batch.a[lane]], &b = full_.line[batch.b[lane]];
    if constexpr (Law::kRigid) {
        const Bodies& bodies = state_->bodies;
        const Vec3 to_a = *point - bodies.position[contact.a];
        const Vec3 to_b = contact.key.is_wall() ? Vec3(Vec3::Zero()) : Vec3(*point - bodies.position[contact.b]);
        set_lane(batch, lane, {contact.normal, to_a, to_b, contact.friction, contact.bias}, a, b);
    } else {
        for (int d = 0; d < 3; ++d) batch.n[d][lane] = contact.normal[d];
        batch.bias[lane] = contact.bias;
        batch.inverse_w[lane] = 1.0 / (a.inverse_mass + b.inverse_mass);
        if constexpr (Law::kImpulse == 3) batch.friction[lane] = contact.friction;
    }
    if constexpr (Law::kImpulse == 3) extremes_.friction = std::max(extremes_.friction, contact.friction);
}

template <class Law>
void ContactProblem<Law>::assemble(const contact::ContactSet& contacts, const Layout& layout, const State& state,
                                   const Vec3& dv_free, const std::vector<Vec3>& wall_velocity,
                                   const std::vector<Vec3>& points) {
    layout_ = &layout;
    state_ = &state;
    dv_free_ = dv_free;
    swept_ = is_single_ = false;
    extremes_ = {};
    all_contacts_ = ranks_.sum(static_cast<std::uint64_t>(contacts.size()));
    contacts_ = contacts.size();
    const Bodies& bodies = state.bodies;
    bodies_ = bodies.size();
    full_.line.resize(bodies_ + 1);
    full_.line[kGround] = Line{};
    free_lines();
    full_.batch.resize(layout.batches());
    for (std::size_t k = 0; k < full_.batch.size(); ++k) {
        Batch& batch = full_.batch[k];
        const auto& lanes = layout.lanes()[k];
        batch = Batch{};
        for (int i = 0; i < kLanes; ++i) {
            if (lanes[static_cast<std::size_t>(i)] == kNoContact) continue;
            const std::uint32_t index = lanes[static_cast<std::size_t>(i)];
            const contact::Contact& c = contacts[index];
            batch.a[i] = layout.line(c.a);
            if (!c.key.is_wall()) {
                batch.b[i] = layout.line(c.b);
            } else if (!wall_velocity.empty() && !wall_velocity[index].isZero(0.0)) {
                batch.b[i] = static_cast<std::uint32_t>(full_.line.size());
                full_.line.push_back(Line{});
                set_velocity(full_.line.back(), wall_velocity[index], 0.0);
            }
            fill_lane(batch, i, c, points.empty() ? nullptr : &points[index]);
        }
    }
}

template <class Law>
void ContactProblem<Law>::scale(double floor) {
    ExactSum squares;
    full_.sum_over_blocks(*layout_, nullptr, squares,
                          [&](std::uint32_t k) { return drive(full_.batch[k], full_.line.data()); });
    const double sum = ranks_.sum(squares);
    double fastest = 0.0;
    for (std::size_t i = 0; i < full_.line.size(); ++i) {
        const Line& line = full_.line[i];
        double here = 0.0;
        for (const double v : line.v) here = std::max(here, std::abs(v));
        fastest = std::max(fastest, here);
        if (i > layout_->touched_lines() && i <= bodies_) continue;  // no contact
        if constexpr (Law::kImpulse == 3 && !Law::kRigid)
            for (const double w : line.w) here = std::max(here, std::abs(w));
        extremes_.fastest = std::max(extremes_.fastest, here);
        if (line.inverse_mass == 0.0) continue;
        extremes_.lightest = std::max(extremes_.lightest, line.inverse_mass);
        extremes_.heaviest = std::max(extremes_.heaviest, 1.0 / line.inverse_mass);
    }
    if constexpr (Law::kRigid) {  // spins as velocities, and inverse inertias as inverse masses, at the farthest points
        const Bodies& bodies = state_->bodies;
        for (std::size_t i = 0; i < bodies_; ++i) {
            const double radius = bodies.radius[i], here = radius * bodies.spin[i].norm();
            fastest = std::max(fastest, here);
            if (layout_->line(i) > layout_->touched_lines()) continue;
            const Line& line = full_.line[layout_->line(i)];
            extremes_.fastest = std::max(extremes_.fastest, here);
            extremes_.lever = std::max(extremes_.lever, radius);
            for (int d = 0; d < 3; ++d) extremes_.lightest = std::max(extremes_.lightest, radius * radius * line.j[d]);
        }
    }
    std::array<double, 6> most{
        fastest, extremes_.fastest, extremes_.lightest, extremes_.heaviest, extremes_.friction, extremes_.lever};
    ranks_.max(most);
    extremes_ = {most[1], most[2], most[3], most[4], most[5]};
    driven_ = sum > 0.0;
    // differences of velocities cannot be told from zero below the round-off of the velocities
    v_ref_ = std::max(floor, kRoundOff * most[0]);
    if (all_contacts_ > 0) v_ref_ = std::max(v_ref_, std::sqrt(sum / static_cast<double>(all_contacts_)));
}

template <class Law>
void ContactProblem<Law>::warm_start(const std::vector<Vec3>& impulse, const std::vector<double>& normal) {
    full_.over_blocks(*layout_, exchange_, [&](std::uint32_t k) {
        Batch& batch = full_.batch[k];
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t c = layout_->lanes()[k][static_cast<std::size_t>(i)];
            if (c == kNoContact) continue;
            if constexpr (Law::kImpulse == 3 && Law::kRigid)
                set_world_impulse(batch, i, impulse[c]);
            else if constexpr (Law::kImpulse == 3)
                for (int d = 0; d < 3; ++d) batch.p[d][i] = impulse[c][d];
            else
                batch.p[0][i] = normal[c];
        }
        apply(batch, full_.line.data());
    });
    full_.complete(exchange_);
}

template <class Law>
bool ContactProblem<Law>::begin_single(const SolverSettings& settings) {
    is_single_ = driven_ && single_is_enough(settings, extremes_, v_ref_);
    if (is_single_) single_.load(full_, *layout_, extremes_, v_ref_);
    return is_single_;
}

template <class Law>
void ContactProblem<Law>::end_single() {
    single_.give_impulses(full_);
    is_single_ = false;
    rebuild_lines();
}

template <class Law>
void ContactProblem<Law>::reset_momentum() {
    if (is_single_)
        single_.sweeps.reset_momentum();
    else
        full_.reset_momentum();
}

template <class Law>
double ContactProblem<Law>::sweep(double beta, bool momentum) {
    ExactSum squares;
    swept_ = true;
    if (is_single_)
        single_.sweeps.sweep(single_, exchange_, layout_->touched_lines(), beta, momentum, squares);
    else
        full_.sweep(*layout_, exchange_, layout_->touched_lines(), beta, momentum, squares);
    const double sum = ranks_.sum(squares), unit = is_single_ ? single_.velocity_unit() : 1.0;
    if (is_single_)
        single_.sweeps.complete(exchange_);
    else
        full_.complete(exchange_);
    if (all_contacts_ == 0 || sum == 0.0) return 0.0;
    return std::sqrt(sum / static_cast<double>(all_contacts_)) / (v_ref_ / unit);
}

template <class Law>
Residual ContactProblem<Law>::residual() {
    ExactSum squares;
    const double largest = is_single_ ? single_.sweeps.residual(single_, squares) : full_.residual(*layout_, squares);
    const double sum = ranks_.sum(squares), most = ranks_.max(largest);
    if (all_contacts_ == 0 || sum == 0.0) return {};
    const double scale = v_ref_ / (is_single_ ? single_.velocity_unit() : 1.0);
    return {std::sqrt(sum / static_cast<double>(all_contacts_)) / scale, std::sqrt(most) / scale};
}

template <class Law>
void ContactProblem<Law>::add_work(const State& state, ContactWorkSums total) {
    line_mean_ = full_.line;
    const Bodies& bodies = state.bodies;
    for (std::size_t i = 0; i < bodies_; ++i) {
        Line& line = line_mean_[layout_->line(i)];
        for (int d = 0; d < 3; ++d) line.v[d] = 0.5 * (line.v[d] + bodies.velocity[i][d]);
        if constexpr (kSpins) {
            const Vec3 before = spin_in_line(line, bodies, i);
            for (int d = 0; d < 3; ++d) line.w[d] = 0.5 * (line.w[d] + before[d]);
        }
    }
    const Pack zero = Pack::all(0.0);
    for (const Block& block : blocks()) {
        Pack normal = zero, tangential = zero, gained = zero;
        for (std::uint32_t k = block.begin; k < block.end; ++k) {
            const WorkPacks w = solvers::work(full_.batch[k], line_mean_.data());
            normal = normal + w.normal;
            tangential = tangential + w.tangential;
            gained = gained + max(w.normal + w.tangential, zero);
        }
        total[0].add(sum_lanes(normal));
        total[1].add(sum_lanes(tangential));
        total[2].add(sum_lanes(gained));
    }
}

template <class Law>
void ContactProblem<Law>::velocities(State& state) const {
    Bodies& bodies = state.bodies;
    for (std::size_t i = 0; i < bodies_; ++i) {
        const Line& line = full_.line[layout_->line(i)];
        for (int d = 0; d < 3; ++d) bodies.velocity[i][d] = line.v[d];
        if constexpr (kSpins) bodies.spin[i] = spin_of_line(line, bodies, i);
    }
}

template <class Law>
void ContactProblem<Law>::impulses(std::vector<Vec3>& impulse, std::vector<double>& normal) const {
    if constexpr (Law::kImpulse == 3)
        impulse.resize(contacts_);
    else
        normal.resize(contacts_);
    for (std::size_t k = 0; k < full_.batch.size(); ++k)
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t c = layout_->lanes()[k][static_cast<std::size_t>(i)];
            if (c == kNoContact) continue;
            if constexpr (Law::kImpulse == 3 && Law::kRigid)
                impulse[c] = world_impulse(full_.batch[k], i);
            else if constexpr (Law::kImpulse == 3)
                impulse[c] = Vec3(full_.batch[k].p[0][i], full_.batch[k].p[1][i], full_.batch[k].p[2][i]);
            else
                normal[c] = full_.batch[k].p[0][i];
        }
}

template <class Law>
std::size_t ContactProblem<Law>::bytes() const {
    return full_.bytes() + single_.bytes() + line_mean_.capacity() * sizeof(Line);
}

template class ContactProblem<Frictional>;
template class ContactProblem<Frictionless>;
template class ContactProblem<RigidFrictional>;
template class ContactProblem<RigidFrictionless>;

}  // namespace scree::solvers
