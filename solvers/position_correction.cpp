#include "solvers/position_correction.hpp"

#include <algorithm>
#include <cmath>

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
                                        std::size_t closed) const {
    const contact::NearContacts::Shallow& shallow = near_.shallow();
    Penetration result{shallow.max, shallow.sum, shallow.max_relative, shallow.sum_relative};
    std::size_t overlaps = shallow.count;
    for (const contact::Contact& c : contacts) {
        const SlidingLine& a = line_[layout_.line(c.a)];
        const SlidingLine& b = line_[c.key.is_wall() ? kGround : layout_.line(c.b)];
        double gap = c.gap;
        for (int d = 0; d < 3; ++d) gap += c.normal[d] * (a.v[d] - b.v[d]);
        if (gap >= 0.0) continue;
        const double relative = -gap / contact::NearContacts::diameter(c, bodies);
        ++overlaps;
        result.max = std::max(result.max, -gap);
        result.max_relative = std::max(result.max_relative, relative);
        result.mean -= gap;
        result.mean_relative += relative;
    }
    const auto count = static_cast<double>(std::max({overlaps, closed, std::size_t{1}}));
    result.mean /= count;
    result.mean_relative /= count;
    return result;
}

int PositionCorrection::sweep_until_settled(const contact::ContactSet& contacts, const Bodies& bodies, int most) {
    double smallest = 2.0 * bodies.radius[contacts.front().a];
    for (const contact::Contact& c : contacts) smallest = std::min(smallest, 2.0 * bodies.radius[c.a]);
    const double settled = kSettled * smallest;
    const Pack none = Pack::all(0.0);
    for (int sweep = 1; sweep <= most; ++sweep) {
        Pack farthest = none;
        for (FrictionlessBatch& batch : batch_)
            farthest = max(farthest, update<false>(batch, line_.data(), nullptr, none));
        if (std::sqrt(max_lanes(farthest)) <= settled) return sweep;
    }
    return most;
}

CorrectionReport PositionCorrection::apply(const Scene& scene, double step, std::size_t closed, double block_size,
                                           contact::CandidateList& candidates, State& state) {
    CorrectionReport report;
    Bodies& bodies = state.bodies;
    const contact::ContactSet& contacts = near_.find(scene, state, step, candidates);
    if (contacts.empty()) {
        report.penetration = measure(contacts, bodies, closed);
        return report;
    }
    layout_.arrange(contacts, bodies, block_size);
    assemble(contacts, bodies, scene.correction.share);
    if (scene.correction.on) {
        report.sweeps = sweep_until_settled(contacts, bodies, scene.correction.sweeps);
        const Vec3 gravity = scene.gravity.at(state.time + step);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const SlidingLine& line = line_[layout_.line(i)];
            const Vec3 d(line.v[0], line.v[1], line.v[2]);
            bodies.position[i] += d;
            report.work -= bodies.mass[i] * gravity.dot(d);
        }
    }
    report.penetration = measure(contacts, bodies, closed);
    return report;
}

std::size_t PositionCorrection::bytes() const {
    return near_.bytes() + layout_.bytes() + batch_.capacity() * sizeof(FrictionlessBatch) +
           line_.capacity() * sizeof(SlidingLine);
}

}  // namespace scree::solvers
