#include "solvers/position_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel/body_sums.hpp"
#include "solvers/kernels.hpp"

namespace scree::solvers {
namespace {

// Sweeps end when none moves a contact by more than this share of the smallest diameter.
constexpr double kSettled = 1e-4;
constexpr int kSweepsALook = 4;  // a look is a maximum over all ranks
// Deep overlaps are those of impacts: all of them goes at once, but for this share of the diameter.
constexpr double kMostLeft = 3e-3;

}  // namespace

void PositionCorrection::assemble(const contact::ContactSet& contacts, const Bodies& bodies, double share) {
    sweeps_.line.resize(bodies.size() + 1);
    sweeps_.line[kGround] = SlidingLine{};
    for (std::size_t i = 0; i < bodies.size(); ++i)
        sweeps_.line[layout_.line(i)] = {{0.0, 0.0, 0.0}, 1.0 / bodies.mass[i]};
    sweeps_.batch.resize(layout_.batches());
    for (std::size_t k = 0; k < sweeps_.batch.size(); ++k) {
        FrictionlessBatch& batch = sweeps_.batch[k];
        batch = FrictionlessBatch{};
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t index = layout_.lanes()[k][static_cast<std::size_t>(i)];
            if (index == kNoContact) continue;
            const contact::Contact& c = contacts[index];
            batch.a[i] = layout_.line(c.a);
            batch.b[i] = c.key.is_wall() ? kGround : layout_.line(c.b);
            for (int d = 0; d < 3; ++d) batch.n[d][i] = c.normal[d];
            const double most_left = kMostLeft * contact::NearContacts::diameter(c, bodies);
            batch.bias[i] = c.gap < 0.0 ? std::min(share * c.gap, c.gap + most_left) : c.gap;
            batch.inverse_w[i] = 1.0 / (sweeps_.line[batch.a[i]].inverse_mass + sweeps_.line[batch.b[i]].inverse_mass);
        }
    }
}

Penetration PositionCorrection::measure(const contact::ContactSet& contacts, const Bodies& bodies,
                                        const Communicator& ranks, std::size_t closed) const {
    contact::OverlapSums sums = near_.shallow();
    for (const contact::Contact& c : contacts) {
        const SlidingLine& a = sweeps_.line[layout_.line(c.a)];
        const SlidingLine& b = sweeps_.line[c.key.is_wall() ? kGround : layout_.line(c.b)];
        double gap = c.gap;
        for (int d = 0; d < 3; ++d) gap += c.normal[d] * (a.v[d] - b.v[d]);
        sums.add(-gap, contact::NearContacts::diameter(c, bodies));
    }
    return sums.over(ranks, closed);
}

int PositionCorrection::sweep_until_settled(const contact::ContactSet& contacts, const Bodies& bodies, int most,
                                            const Communicator& ranks) {
    double smallest = std::numeric_limits<double>::max();
    for (const contact::Contact& c : contacts) smallest = std::min(smallest, 2.0 * bodies.radius[c.a]);
    const Pack none = Pack::all(0.0);
    for (int sweep = 1; sweep <= most; ++sweep) {
        Pack farthest = none;
        sweeps_.over_blocks(layout_, &exchange_, [&](std::uint32_t k) {
            farthest = max(farthest, update<false>(sweeps_.batch[k], sweeps_.line.data(), nullptr, none));
        });
        std::array<double, 2> of_all{max_lanes(farthest), -smallest};
        const bool look = sweep % kSweepsALook == 0;
        if (look) ranks.max(of_all);
        sweeps_.complete(&exchange_);
        if (look && std::sqrt(of_all[0]) <= -kSettled * of_all[1]) return sweep;
    }
    return most;
}

CorrectionReport PositionCorrection::apply(const Scene& scene, double step, std::size_t closed,
                                           contact::CandidateList& candidates, Domain& domain, State& state) {
    CorrectionReport report;
    Bodies& bodies = state.bodies;
    const Communicator& ranks = domain.ranks();
    const contact::ContactSet& contacts = near_.find(scene, state, step, candidates, domain);
    if (near_.none()) {
        report.penetration = measure(contacts, bodies, ranks, closed);
        return report;
    }
    layout_.arrange(contacts, bodies, state.block_size, domain.halo().shared_flags());
    assemble(contacts, bodies, scene.correction.share);
    if (scene.correction.on) {
        exchange_.set_up(ranks, domain.halo(), contacts, layout_, 3);
        report.sweeps = sweep_until_settled(contacts, bodies, scene.correction.sweeps, ranks);
        exchange_.spread(sweeps_.line.data());
        const Vec3 gravity = scene.gravity.at(state.time + step);
        ExactSum work;
        add_over_bodies(bodies, std::span<ExactSum, 1>(&work, 1), [&](std::size_t i) {
            const SlidingLine& line = sweeps_.line[layout_.line(i)];
            return std::array<double, 1>{-bodies.mass[i] * gravity.dot(Vec3(line.v[0], line.v[1], line.v[2]))};
        });
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const SlidingLine& line = sweeps_.line[layout_.line(i)];
            bodies.position[i] += Vec3(line.v[0], line.v[1], line.v[2]);
        }
        report.work = ranks.sum(work);
    }
    report.penetration = measure(contacts, bodies, ranks, closed);
    return report;
}

std::size_t PositionCorrection::bytes() const {
    return near_.bytes() + layout_.bytes() + sweeps_.bytes();
}

}  // namespace scree::solvers
