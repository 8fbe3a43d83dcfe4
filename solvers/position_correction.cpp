#include "solvers/position_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel/body_sums.hpp"
#include "solvers/kernels.hpp"

namespace scree::solvers {
namespace {

// Sweeps end when none moves a contact by more than this share of the smallest diameter.
constexpr double kSettled = 1e-4;
// Deep overlaps are those of impacts: all of them goes at once, but for this share of the diameter.
constexpr double kMostLeft = 3e-3;

}  // namespace

void PositionCorrection::assemble(const contact::ContactSet& contacts, const Bodies& bodies, double share) {
    line_.resize(bodies.size() + 1);
    line_[kGround] = SlidingLine{};
    for (std::size_t i = 0; i < bodies.size(); ++i) line_[layout_.line(i)] = {{0.0, 0.0, 0.0}, 1.0 / bodies.mass[i]};
    batch_.resize(layout_.batches());
    for (std::size_t k = 0; k < batch_.size(); ++k) {
        FrictionlessBatch& batch = batch_[k];
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
            batch.inverse_w[i] = 1.0 / (line_[batch.a[i]].inverse_mass + line_[batch.b[i]].inverse_mass);
        }
    }
}

Penetration PositionCorrection::measure(const contact::ContactSet& contacts, const Bodies& bodies,
                                        const Communicator& ranks, std::size_t closed) const {
    contact::OverlapSums sums = near_.shallow();
    for (const contact::Contact& c : contacts) {
        const SlidingLine& a = line_[layout_.line(c.a)];
        const SlidingLine& b = line_[c.key.is_wall() ? kGround : layout_.line(c.b)];
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
    const double settled = kSettled * ranks.min(smallest);
    const Pack none = Pack::all(0.0);
    for (int sweep = 1; sweep <= most; ++sweep) {
        Pack farthest = none;
        const auto run = [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t k = from; k < to; ++k)
                for (std::uint32_t b = layout_.blocks()[k].begin; b < layout_.blocks()[k].end; ++b)
                    farthest = max(farthest, update<false>(batch_[b], line_.data(), nullptr, none));
        };
        for (std::size_t phase = 0; phase < kPhases; ++phase) {
            const Layout::PhaseBlocks& range = layout_.phase(phase);
            run(range.begin, range.inner);
            exchange_.send(phase, line_.data());
            run(range.inner, range.end);
            exchange_.receive(phase, line_.data());
        }
        if (std::sqrt(ranks.max(max_lanes(farthest))) <= settled) return sweep;
    }
    return most;
}

CorrectionReport PositionCorrection::apply(const Scene& scene, double step, std::size_t closed,
                                           contact::CandidateList& candidates, Domain& domain, State& state) {
    CorrectionReport report;
    Bodies& bodies = state.bodies;
    const Communicator& ranks = domain.ranks();
    const contact::ContactSet& contacts = near_.find(scene, state, step, candidates, domain);
    if (!ranks.any(!contacts.empty())) {
        report.penetration = measure(contacts, bodies, ranks, closed);
        return report;
    }
    layout_.arrange(contacts, bodies, state.block_size, domain.halo().shared_flags());
    assemble(contacts, bodies, scene.correction.share);
    if (scene.correction.on) {
        exchange_.set_up(ranks, domain.halo(), contacts, layout_, 3);
        report.sweeps = sweep_until_settled(contacts, bodies, scene.correction.sweeps, ranks);
        exchange_.spread(line_.data());
        const Vec3 gravity = scene.gravity.at(state.time + step);
        ExactSum work;
        add_over_bodies(bodies, std::span<ExactSum, 1>(&work, 1), [&](std::size_t i) {
            const SlidingLine& line = line_[layout_.line(i)];
            return std::array<double, 1>{-bodies.mass[i] * gravity.dot(Vec3(line.v[0], line.v[1], line.v[2]))};
        });
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const SlidingLine& line = line_[layout_.line(i)];
            bodies.position[i] += Vec3(line.v[0], line.v[1], line.v[2]);
        }
        report.work = ranks.sum(work);
    }
    report.penetration = measure(contacts, bodies, ranks, closed);
    return report;
}

std::size_t PositionCorrection::bytes() const {
    return near_.bytes() + layout_.bytes() + batch_.capacity() * sizeof(FrictionlessBatch) +
           line_.capacity() * sizeof(SlidingLine);
}

}  // namespace scree::solvers
