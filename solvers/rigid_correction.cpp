#include "solvers/rigid_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel/body_sums.hpp"
#include "solvers/body_lines.hpp"
#include "solvers/rigid_assembly.hpp"
#include "solvers/rigid_kernels.hpp"
#include "solvers/settle.hpp"

namespace scree::solvers {
namespace {

using contact::Contact;
using contact::NearContacts;

// Overlaps up to this share of the diameter stay. A body that rests on a face has more points of contact than it needs;
// were its overlaps, which are what the solver's tolerance leaves, taken away in full, some points would open by as
// much and lose their impulses, so that no two steps would have the same loads and nothing would ever come to rest.
constexpr double kRestDepth = 5e-5;

double resting_bias(double gap, double share, double diameter) {
    return gap >= 0.0 ? gap : std::min(0.0, correction_bias(gap + kRestDepth * diameter, share, diameter));
}

// [rad] Gaps are linear in turns up to half the square of this, 1e-3 of the arm. A body that would turn more (squeezed
// where it cannot fit, say) goes a part of the way, and the penetration that is reported is the one that is left.
constexpr double kMostTurn = 0.05;

void limit_turn(RigidLine& line) {
    const double turn = std::sqrt(line.w[0] * line.w[0] + line.w[1] * line.w[1] + line.w[2] * line.w[2]);
    if (turn <= kMostTurn) return;
    for (int d = 0; d < 3; ++d) line.v[d] *= kMostTurn / turn, line.w[d] *= kMostTurn / turn;
}

Vec3 displacement(const RigidLine& line) {
    return {line.v[0], line.v[1], line.v[2]};
}
Vec3 turn(const RigidLine& line) {
    return {line.w[0], line.w[1], line.w[2]};
}

}  // namespace

void RigidCorrection::find_gaps(const StepContacts& of_step, double step, const State& state) {
    const Bodies& bodies = state.bodies;
    const auto velocity = [&](std::uint32_t i, const Vec3& point) {
        return Vec3(bodies.velocity[i] + bodies.spin[i].cross(point - bodies.position[i]));
    };
    gap_.resize(of_step.contacts.size());
    for (std::size_t k = 0; k < gap_.size(); ++k) {
        const Contact& c = of_step.contacts[k];
        Vec3 u = velocity(c.a, of_step.points[k]);
        if (!c.key.is_wall())
            u -= velocity(c.b, of_step.points[k]);
        else if (!of_step.wall_velocity.empty())
            u -= of_step.wall_velocity[k];
        gap_[k] = c.gap + 0.5 * step * c.normal.dot(u);
    }
}

void RigidCorrection::assemble(const StepContacts& of_step, const Bodies& bodies, double share) {
    const Layout& layout = of_step.layout;
    sweeps_.line.resize(bodies.size() + 1);
    sweeps_.line[kGround] = RigidLine{};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        RigidLine& line = sweeps_.line[layout.line(i)];
        set_body(line, bodies, i, Vec3::Zero());
        std::fill(line.w, line.w + 3, 0.0);
    }
    sweeps_.batch.resize(layout.batches());
    for (std::size_t k = 0; k < sweeps_.batch.size(); ++k) {
        RigidFrictionlessBatch& batch = sweeps_.batch[k];
        batch = RigidFrictionlessBatch{};
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t index = layout.lanes()[k][static_cast<std::size_t>(i)];
            if (index == kNoContact) continue;
            const Contact& c = of_step.contacts[index];
            const Vec3& point = of_step.points[index];
            batch.a[i] = layout.line(c.a);
            batch.b[i] = c.key.is_wall() ? kGround : layout.line(c.b);
            const Vec3 to_a = point - bodies.position[c.a];
            const Vec3 to_b = c.key.is_wall() ? Vec3(Vec3::Zero()) : Vec3(point - bodies.position[c.b]);
            const double bias = resting_bias(gap_[index], share, NearContacts::diameter(c, bodies));
            set_lane(batch, i, {c.normal, to_a, to_b, 0.0, bias}, sweeps_.line[batch.a[i]], sweeps_.line[batch.b[i]]);
        }
    }
}

// Returns the work on the potential energy [J].
double RigidCorrection::displace(const Layout& layout, const Vec3& gravity, const Communicator& ranks,
                                 Bodies& bodies) const {
    ExactSum work;
    add_over_bodies(bodies, std::span<ExactSum, 1>(&work, 1), [&](std::size_t i) {
        return std::array{-bodies.mass[i] * gravity.dot(displacement(sweeps_.line[layout.line(i)]))};
    });
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const RigidLine& line = sweeps_.line[layout.line(i)];
        bodies.position[i] += displacement(line);
        const Vec3 by = turn(line);
        if (by.isZero(0.0)) continue;
        bodies.orientation[i] = turned(bodies.orientation[i], by);
        bodies.spin[i] = turned(Quat::Identity(), by) * bodies.spin[i];
    }
    return ranks.sum(work);
}

Penetration RigidCorrection::measure(const StepContacts& of_step, const State& state, const Communicator& ranks,
                                     std::size_t closed) const {
    contact::OverlapSums sums(state.block_size > 0.0 ? state.block_size : 1.0);
    const Bodies& bodies = state.bodies;
    // arms are those before the displacement, which is part of the bodies' positions by now
    const auto moved = [&](std::uint32_t i, const Vec3& point) {
        const RigidLine& line = sweeps_.line[of_step.layout.line(i)];
        const Vec3 d = displacement(line);
        return Vec3(d + turn(line).cross(point - (bodies.position[i] - d)));
    };
    for (std::size_t k = 0; k < gap_.size(); ++k) {
        const Contact& c = of_step.contacts[k];
        double gap = gap_[k];
        if (moved_) {
            gap += c.normal.dot(moved(c.a, of_step.points[k]));
            if (!c.key.is_wall()) gap -= c.normal.dot(moved(c.b, of_step.points[k]));
        }
        sums.add(-gap, NearContacts::diameter(c, bodies));
    }
    return sums.over(ranks, closed);
}

CorrectionReport RigidCorrection::apply(const Scene& scene, double step, std::size_t closed,
                                        const StepContacts& of_step, LineExchange& exchange, const Domain& domain,
                                        State& state) {
    CorrectionReport report;
    Bodies& bodies = state.bodies;
    const Communicator& ranks = domain.ranks();
    find_gaps(of_step, step, state);
    double deepest = 0.0, settled = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < gap_.size(); ++k) {
        const Contact& c = of_step.contacts[k];
        const double diameter = NearContacts::diameter(c, bodies);
        deepest = std::max(deepest, -gap_[k] / diameter);
        settled = std::min(settled, kSettled * diameter);
    }
    const double least = std::max(kRestDepth, NearContacts::least_push(state.step));
    moved_ = ranks.max(deepest) > least && scene.correction.on;
    if (moved_) {
        assemble(of_step, bodies, scene.correction.share);
        report.sweeps =
            sweep_until_settled(sweeps_, of_step.layout, exchange, settled, 1.0, scene.correction.sweeps, ranks);
        exchange.spread(sweeps_.line.data());
        for (RigidLine& line : sweeps_.line) limit_turn(line);
        report.work = displace(of_step.layout, scene.gravity.at(state.time + step), ranks, bodies);
    }
    report.penetration = measure(of_step, state, ranks, closed);
    return report;
}

}  // namespace scree::solvers
