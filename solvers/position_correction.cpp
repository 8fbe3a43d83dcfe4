#include "solvers/position_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel/body_sums.hpp"
#include "solvers/kernels.hpp"
#include "solvers/settle.hpp"

namespace scree::solvers {
void PositionCorrection::assemble(const contact::ContactSet& contacts, const Bodies& bodies, double share) {
    full_.line.resize(bodies.size() + 1);
    full_.line[kGround] = SlidingLine{};
    for (std::size_t i = 0; i < bodies.size(); ++i)
        full_.line[layout_.line(i)] = {{0.0, 0.0, 0.0}, 1.0 / bodies.mass[i]};
    full_.batch.resize(layout_.batches());
    for (std::size_t k = 0; k < full_.batch.size(); ++k) {
        FrictionlessBatch& batch = full_.batch[k];
        batch = FrictionlessBatch{};
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t index = layout_.lanes()[k][static_cast<std::size_t>(i)];
            if (index == kNoContact) continue;
            const contact::Contact& c = contacts[index];
            batch.a[i] = layout_.line(c.a);
            batch.b[i] = c.key.is_wall() ? kGround : layout_.line(c.b);
            for (int d = 0; d < 3; ++d) batch.n[d][i] = c.normal[d];
            batch.bias[i] = correction_bias(c.gap, share, contact::NearContacts::diameter(c, bodies));
            batch.inverse_w[i] = 1.0 / (full_.line[batch.a[i]].inverse_mass + full_.line[batch.b[i]].inverse_mass);
        }
    }
}

Penetration PositionCorrection::measure(const contact::ContactSet& contacts, const Bodies& bodies,
                                        const Communicator& ranks, std::size_t closed) const {
    contact::OverlapSums sums = near_.shallow();
    for (const contact::Contact& c : contacts) {
        const SlidingLine& a = full_.line[layout_.line(c.a)];
        const SlidingLine& b = full_.line[c.key.is_wall() ? kGround : layout_.line(c.b)];
        double gap = c.gap;
        for (int d = 0; d < 3; ++d) gap += c.normal[d] * (a.v[d] - b.v[d]);
        sums.add(-gap, contact::NearContacts::diameter(c, bodies));
    }
    return sums.over(ranks, closed);
}

// Displacements are differences of gaps that are known exactly: single precision loses nothing that counts.
int PositionCorrection::sweep(const Scene& scene, const contact::ContactSet& contacts, const State& state,
                              const Communicator& ranks) {
    double settled = std::numeric_limits<double>::max();
    for (const contact::Contact& c : contacts) settled = std::min(settled, kSettled * 2.0 * state.bodies.radius[c.a]);
    const int most = scene.correction.sweeps;
    if (scene.solver.precision == SolverPrecision::full) {
        const int sweeps = sweep_until_settled(full_, layout_, exchange_, settled, 1.0, most, ranks);
        exchange_.spread(full_.line.data());
        return sweeps;
    }
    const auto [lightest, heaviest] = std::minmax_element(state.bodies.mass.begin(), state.bodies.mass.end());
    const Extremes extremes{0.0, contacts.empty() ? 1.0 : 1.0 / *lightest, contacts.empty() ? 1.0 : *heaviest, 0.0};
    single_.load(full_, layout_, extremes, state.block_size);
    const double unit = single_.velocity_unit();
    const int sweeps = sweep_until_settled(single_.sweeps, single_, exchange_, settled, unit, most, ranks);
    exchange_.spread(single_.sweeps.line.data());
    for (std::size_t i = 0; i < full_.line.size(); ++i)
        for (int d = 0; d < 3; ++d) full_.line[i].v[d] = unit * static_cast<double>(single_.sweeps.line[i].v[d]);
    return sweeps;
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
        report.sweeps = sweep(scene, contacts, state, ranks);
        const Vec3 gravity = scene.gravity.at(state.time + step);
        ExactSum work;
        add_over_bodies(bodies, std::span<ExactSum, 1>(&work, 1), [&](std::size_t i) {
            const SlidingLine& line = full_.line[layout_.line(i)];
            return std::array<double, 1>{-bodies.mass[i] * gravity.dot(Vec3(line.v[0], line.v[1], line.v[2]))};
        });
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const SlidingLine& line = full_.line[layout_.line(i)];
            bodies.position[i] += Vec3(line.v[0], line.v[1], line.v[2]);
        }
        report.work = ranks.sum(work);
    }
    report.penetration = measure(contacts, bodies, ranks, closed);
    return report;
}

std::size_t PositionCorrection::bytes() const {
    return near_.bytes() + layout_.bytes() + full_.bytes() + single_.bytes();
}

}  // namespace scree::solvers
