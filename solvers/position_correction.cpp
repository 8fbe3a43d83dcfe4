#include "solvers/position_correction.hpp"

#include <algorithm>

#include "solvers/kernels.hpp"

namespace scree::solvers {
namespace {

// Penetration below this share of the diameter is round-off and not worth a sweep.
constexpr double kNegligible = 1e-12;

Pack normal_impulse(const FrictionBatch& batch) {
    return dot(load3(batch.p), load3(batch.n));
}
Pack normal_impulse(const FrictionlessBatch& batch) {
    return Pack::load(batch.p[0]);
}

// Relative displacement of the centres of each lane in half a step.
template <class Batch, class Line>
Pack3 half_motion(const Batch& batch, const Line* line, double half_step) {
    Pack3 va, vb;
    Pack unused;
    gather4([&](int i) { return line[batch.a[i]].v; }, va.x, va.y, va.z, unused);
    gather4([&](int i) { return line[batch.b[i]].v; }, vb.x, vb.y, vb.z, unused);
    return Pack::all(half_step) * (va - vb);
}

}  // namespace

template <class Law>
double PositionCorrection<Law>::deepest(const ContactProblem<Law>& problem, const contact::ContactSet& contacts,
                                        const Layout& layout, const CorrectionSettings& settings, double step,
                                        const State& state) {
    const auto& batches = problem.batches();
    gaps_.resize(batches.size());
    const Pack zero = Pack::all(0.0), one = Pack::all(1.0), two = Pack::all(2.0), share = Pack::all(settings.share);
    Pack depth = zero;
    for (std::size_t k = 0; k < batches.size(); ++k) {
        Gaps& g = gaps_[k];
        g = Gaps{};
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t c = layout.lanes()[k][static_cast<std::size_t>(i)];
            if (c == kNoContact) continue;
            const contact::Contact& contact = contacts[c];
            const double radius = state.bodies.radius[contact.a];
            g.gap[i] = contact.gap;
            g.diameter[i] = contact.key.is_wall() ? 2.0 * radius : radius + state.bodies.radius[contact.b];
            const double distance = g.diameter[i] + contact.gap;
            g.curvature[i] = contact.key.is_wall() || distance <= 0.0 ? 0.0 : 1.0 / distance;
        }
        // |D n + s| - D with D = 1 / curvature, written so that a wall (curvature 0) gives n . s
        const Pack3 s = half_motion(batches[k], problem.lines().data(), 0.5 * step);
        const Pack sn = dot(s, load3(batches[k].n)), kappa = Pack::load(g.curvature);
        const Pack squared = one + kappa * (two * sn + kappa * dot(s, s));
        const Pack moved = (two * sn + kappa * dot(s, s)) / (sqrt(max(squared, zero)) + one);
        const Pack gap = Pack::load(g.gap) + moved;
        gap.store(g.gap);
        where_less(gap, zero, share * gap, gap).store(g.bias);
        const Pack diameter = Pack::load(g.diameter);
        depth = max(depth, where_less(zero, diameter, (zero - gap) / max(diameter, Pack::all(kTiny)), zero));
    }
    return max_lanes(depth);
}

template <class Law>
Penetration PositionCorrection<Law>::measure(const ContactProblem<Law>& problem) const {
    const Pack zero = Pack::all(0.0), one = Pack::all(1.0);
    Pack deepest = zero, deepest_relative = zero, sum = zero, sum_relative = zero, count = zero;
    for (std::size_t k = 0; k < gaps_.size(); ++k) {
        const auto& batch = problem.batches()[k];
        const SlidingPair pair(batch, line_.data());
        const Pack gap = Pack::load(gaps_[k].gap) + pair.normal_velocity(load3(batch.n));
        const Pack diameter = Pack::load(gaps_[k].diameter);
        const Pack depth = where_less(zero, diameter, max(zero - gap, zero), zero);
        const Pack relative = depth / max(diameter, Pack::all(kTiny));
        const Pack closed = where_less(zero, max(normal_impulse(batch), depth), one, zero);
        deepest = max(deepest, depth);
        deepest_relative = max(deepest_relative, relative);
        sum = sum + depth;
        sum_relative = sum_relative + relative;
        count = count + closed;
    }
    const double n = std::max(1.0, sum_lanes(count));
    return {max_lanes(deepest), sum_lanes(sum) / n, max_lanes(deepest_relative), sum_lanes(sum_relative) / n};
}

template <class Law>
CorrectionReport PositionCorrection<Law>::apply(const ContactProblem<Law>& problem, const contact::ContactSet& contacts,
                                                const Layout& layout, const CorrectionSettings& settings, double step,
                                                const Vec3& gravity, State& state) {
    CorrectionReport report;
    Bodies& bodies = state.bodies;
    const double depth = deepest(problem, contacts, layout, settings, step, state);
    line_.resize(problem.lines().size());
    for (std::size_t i = 0; i < line_.size(); ++i) line_[i] = {{0.0, 0.0, 0.0}, problem.lines()[i].inverse_mass};
    if (settings.on && depth > kNegligible) {
        for (; report.sweeps < settings.sweeps; ++report.sweeps) {
            for (std::size_t k = 0; k < gaps_.size(); ++k) {
                const auto& batch = problem.batches()[k];
                SlidingPair pair(batch, line_.data());
                const Pack3 n = load3(batch.n);
                const Pack p = Pack::load(gaps_[k].p);
                const Pack solved =
                    max(p - Pack::load(batch.inverse_w) * (pair.normal_velocity(n) + Pack::load(gaps_[k].bias)),
                        Pack::all(0.0));
                solved.store(gaps_[k].p);
                pair.push(batch, line_.data(), n, solved - p);
            }
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const Vec3 d(line_[i + 1].v[0], line_[i + 1].v[1], line_[i + 1].v[2]);
            bodies.position[i] += d;
            report.work -= bodies.mass[i] * gravity.dot(d);
        }
    }
    report.penetration = measure(problem);
    return report;
}

template <class Law>
void PositionCorrection<Law>::gaps(const Layout& layout, std::vector<double>& gap) const {
    for (std::size_t k = 0; k < gaps_.size(); ++k)
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t c = layout.lanes()[k][static_cast<std::size_t>(i)];
            if (c != kNoContact) gap[c] = gaps_[k].gap[i];
        }
}

template <class Law>
std::size_t PositionCorrection<Law>::bytes() const {
    return gaps_.capacity() * sizeof(Gaps) + line_.capacity() * sizeof(SlidingLine);
}

template class PositionCorrection<Frictional>;
template class PositionCorrection<Frictionless>;

}  // namespace scree::solvers
