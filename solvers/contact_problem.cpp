#include "solvers/contact_problem.hpp"

#include <cmath>

#include "solvers/kernels.hpp"

namespace scree::solvers {
namespace {

constexpr std::size_t kFetchAhead = 4;  // batches
constexpr double kRoundOff = 1e-12;     // of the largest velocity, in differences of velocities

void set_spin(SpinningLine& line, const Vec3& w, double inverse_inertia) {
    for (int k = 0; k < 3; ++k) line.w[k] = w[k];
    line.inverse_inertia = inverse_inertia;
}

template <class Line>
void set_velocity(Line& line, const Vec3& v, double inverse_mass) {
    for (int k = 0; k < 3; ++k) line.v[k] = v[k];
    line.inverse_mass = inverse_mass;
}

// now + beta (now - previous), and previous = now, over whole lines as flat numbers: masses do not change, so their
// difference is zero and they stay as they are.
void extrapolate(double* now, double* previous, std::size_t count, double beta) {
    for (std::size_t i = 0; i < count; ++i) {
        const double x = now[i];
        now[i] = x + beta * (x - previous[i]);
        previous[i] = x;
    }
}

}  // namespace

// Phase by phase; one sum a block in the order of its batches, then an exact sum over the blocks: no order of blocks
// and no split over ranks changes a bit. With `kMoves`, lines of shared bodies travel after each phase.
template <class Law>
template <bool kMoves, class PerBatch>
void ContactProblem<Law>::over_blocks(ExactSum& total, PerBatch per_batch) {
    const auto run = [&](std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t k = from; k < to; ++k) {
            Pack sum = Pack::all(0.0);
            for (std::uint32_t b = blocks()[k].begin; b < blocks()[k].end; ++b) sum = sum + per_batch(b);
            total.add(sum_lanes(sum));
        }
    };
    for (std::size_t phase = 0; phase < kPhases; ++phase) {
        const Layout::PhaseBlocks& range = layout_->phase(phase);
        run(range.begin, range.inner);
        if constexpr (kMoves)
            if (exchange_ != nullptr) exchange_->send(phase, line_.data());
        run(range.inner, range.end);
        if constexpr (kMoves)
            if (exchange_ != nullptr) exchange_->receive(phase, line_.data());
    }
}

template <class Law>
void ContactProblem<Law>::free_lines(const State& state, const Vec3& dv_free) {
    const Bodies& bodies = state.bodies;
    for (std::size_t i = 0; i < bodies_; ++i) {
        Line& line = line_[layout_->line(i)];
        const double inverse_mass = 1.0 / bodies.mass[i];
        set_velocity(line, bodies.velocity[i] + dv_free, inverse_mass);
        if constexpr (Law::kImpulse == 3)
            set_spin(line, bodies.radius[i] * bodies.spin[i], inverse_mass / Bodies::kSphereInertia);
    }
}

template <class Law>
void ContactProblem<Law>::rebuild_lines(const State& state, const Vec3& dv_free) {
    free_lines(state, dv_free);
    ExactSum none;
    over_blocks<true>(none, [&](std::uint32_t k) {
        apply(batch_[k], line_.data());
        return Pack::all(0.0);
    });
    if (exchange_ != nullptr) exchange_->spread(line_.data());
}

template <class Law>
void ContactProblem<Law>::assemble(const contact::ContactSet& contacts, const Layout& layout, const State& state,
                                   const Vec3& dv_free, const std::vector<Vec3>& wall_velocity) {
    layout_ = &layout;
    all_contacts_ = ranks_.sum(static_cast<std::uint64_t>(contacts.size()));
    contacts_ = contacts.size();
    const Bodies& bodies = state.bodies;
    bodies_ = bodies.size();
    line_.resize(bodies_ + 1);
    line_[kGround] = Line{};
    free_lines(state, dv_free);
    batch_.resize(layout.batches());
    for (std::size_t k = 0; k < batch_.size(); ++k) {
        Batch& batch = batch_[k];
        const auto& lanes = layout.lanes()[k];
        batch = Batch{};
        for (int i = 0; i < kLanes; ++i) {
            if (lanes[static_cast<std::size_t>(i)] == kNoContact) continue;
            const contact::Contact& c = contacts[lanes[static_cast<std::size_t>(i)]];
            batch.a[i] = layout.line(c.a);
            double w = line_[batch.a[i]].inverse_mass;
            if (!c.key.is_wall()) {
                batch.b[i] = layout.line(c.b);
                w += line_[batch.b[i]].inverse_mass;
            } else if (!wall_velocity.empty()) {
                const Vec3& v = wall_velocity[lanes[static_cast<std::size_t>(i)]];
                if (!v.isZero(0.0)) {
                    batch.b[i] = static_cast<std::uint32_t>(line_.size());
                    line_.push_back(Line{});
                    set_velocity(line_.back(), v, 0.0);
                }
            }
            for (int d = 0; d < 3; ++d) batch.n[d][i] = c.normal[d];
            batch.bias[i] = c.bias;
            batch.inverse_w[i] = 1.0 / w;
            if constexpr (Law::kImpulse == 3) batch.friction[i] = c.friction;
        }
    }
}

template <class Law>
void ContactProblem<Law>::scale(double floor) {
    ExactSum squares;
    over_blocks<false>(squares, [&](std::uint32_t k) { return drive(batch_[k], line_.data()); });
    const double sum = ranks_.sum(squares);
    // differences of velocities cannot be told from zero below the round-off of the velocities
    double fastest = 0.0;
    for (const Line& line : line_)
        for (const double v : line.v) fastest = std::max(fastest, std::abs(v));
    driven_ = sum > 0.0;
    v_ref_ = std::max(floor, kRoundOff * ranks_.max(fastest));
    if (all_contacts_ > 0) v_ref_ = std::max(v_ref_, std::sqrt(sum / static_cast<double>(all_contacts_)));
}

template <class Law>
void ContactProblem<Law>::warm_start(const std::vector<Vec3>& impulse, const std::vector<double>& normal) {
    ExactSum none;
    over_blocks<true>(none, [&](std::uint32_t k) {
        Batch& batch = batch_[k];
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t c = layout_->lanes()[k][static_cast<std::size_t>(i)];
            if (c == kNoContact) continue;
            if constexpr (Law::kImpulse == 3)
                for (int d = 0; d < 3; ++d) batch.p[d][i] = impulse[c][d];
            else
                batch.p[0][i] = normal[c];
        }
        apply(batch, line_.data());
        return Pack::all(0.0);
    });
}

template <class Law>
void ContactProblem<Law>::reset_momentum() {
    previous_.resize(batch_.size());
    for (std::size_t k = 0; k < batch_.size(); ++k)
        for (int d = 0; d < Law::kImpulse; ++d) Pack::load(batch_[k].p[d]).store(previous_[k].p[d]);
    line_previous_ = line_;
}

template <class Law>
double ContactProblem<Law>::sweep(double beta, bool momentum) {
    Line* line = line_.data();
    const Pack b = Pack::all(beta);
    // the lines of a later batch on their way while this one is solved
    const std::size_t batches = batch_.size();
    const auto fetch = [&](std::size_t k) {
        if (k >= batches) return;
        const Batch& next = batch_[k];
        for (int i = 0; i < kLanes; ++i) {
            __builtin_prefetch(line + next.a[i], 1);
            __builtin_prefetch(line + next.b[i], 1);
        }
    };
    ExactSum squares;
    if (momentum) {
        constexpr std::size_t kNumbers = sizeof(Line) / sizeof(double);
        extrapolate(line_[1].v, line_previous_[1].v, layout_->touched_lines() * kNumbers, beta);
        over_blocks<true>(squares, [&](std::uint32_t k) {
            fetch(k + kFetchAhead);
            return update<true>(batch_[k], line, previous_[k].p, b);
        });
    } else {
        over_blocks<true>(squares, [&](std::uint32_t k) {
            fetch(k + kFetchAhead);
            return update<false>(batch_[k], line, nullptr, b);
        });
    }
    const double sum = ranks_.sum(squares);
    if (all_contacts_ == 0 || sum == 0.0) return 0.0;
    return std::sqrt(sum / static_cast<double>(all_contacts_)) / v_ref_;
}

template <class Law>
Residual ContactProblem<Law>::residual() {
    Pack largest = Pack::all(0.0);
    ExactSum squares;
    over_blocks<false>(squares, [&](std::uint32_t k) {
        const Pack f = natural_map(batch_[k], line_.data());
        largest = max(largest, f);
        return f;
    });
    const double sum = ranks_.sum(squares), most = ranks_.max(max_lanes(largest));
    if (all_contacts_ == 0 || sum == 0.0) return {};
    return {std::sqrt(sum / static_cast<double>(all_contacts_)) / v_ref_, std::sqrt(most) / v_ref_};
}

template <class Law>
void ContactProblem<Law>::add_work(const State& state, ContactWorkSums total) {
    line_mean_ = line_;
    const Bodies& bodies = state.bodies;
    for (std::size_t i = 0; i < bodies_; ++i) {
        Line& line = line_mean_[layout_->line(i)];
        for (int d = 0; d < 3; ++d) line.v[d] = 0.5 * (line.v[d] + bodies.velocity[i][d]);
        if constexpr (Law::kImpulse == 3)
            for (int d = 0; d < 3; ++d) line.w[d] = 0.5 * (line.w[d] + bodies.radius[i] * bodies.spin[i][d]);
    }
    const Pack zero = Pack::all(0.0);
    for (const Block& block : blocks()) {
        Pack normal = zero, tangential = zero, gained = zero;
        for (std::uint32_t k = block.begin; k < block.end; ++k) {
            const WorkPacks w = solvers::work(batch_[k], line_mean_.data());
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
        const Line& line = line_[layout_->line(i)];
        for (int d = 0; d < 3; ++d) bodies.velocity[i][d] = line.v[d];
        if constexpr (Law::kImpulse == 3)
            for (int d = 0; d < 3; ++d) bodies.spin[i][d] = line.w[d] / bodies.radius[i];
    }
}

template <class Law>
void ContactProblem<Law>::impulses(std::vector<Vec3>& impulse, std::vector<double>& normal) const {
    if constexpr (Law::kImpulse == 3)
        impulse.resize(contacts_);
    else
        normal.resize(contacts_);
    for (std::size_t k = 0; k < batch_.size(); ++k)
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t c = layout_->lanes()[k][static_cast<std::size_t>(i)];
            if (c == kNoContact) continue;
            if constexpr (Law::kImpulse == 3)
                impulse[c] = Vec3(batch_[k].p[0][i], batch_[k].p[1][i], batch_[k].p[2][i]);
            else
                normal[c] = batch_[k].p[0][i];
        }
}

template <class Law>
std::size_t ContactProblem<Law>::bytes() const {
    return (line_.capacity() + line_previous_.capacity() + line_mean_.capacity()) * sizeof(Line) +
           batch_.capacity() * sizeof(Batch) + previous_.capacity() * sizeof(Impulse);
}

template class ContactProblem<Frictional>;
template class ContactProblem<Frictionless>;

}  // namespace scree::solvers
