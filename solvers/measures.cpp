#include "solvers/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/parallel/body_sums.hpp"
#include "solvers/measure_kinds.hpp"

namespace scree::solvers {
namespace {

using detail::Numbers;

// Part of [start, end] inside the measure's window [s].
double inside_window(const Measure& measure, double start, double end) {
    return std::max(0.0, std::min(end, measure.until) - std::max(start, measure.from));
}

void add_to_window(const Numbers& numbers, double weight, MeasureState& counters) {
    counters.window_sum.resize(numbers.size(), 0.0);
    for (std::size_t i = 0; i < numbers.size(); ++i) counters.window_sum[i] += weight * numbers[i];
    counters.window_time += weight;
}

// A sample of a measure that is not sampled in every step; it stands for the time since the one before.
void add_sample(const Measure& measure, const Numbers& numbers, double time, MeasureState& counters) {
    const double weight = inside_window(measure, counters.time_at_row, time);
    if (weight > 0.0) add_to_window(numbers, weight, counters);
    counters.time_at_row = time;
}

// The window ends in this step (round-off in the time's sum aside).
bool window_ends(const Measure& measure, double time, double step) {
    return time >= measure.until - 1e-6 * step && time - step < measure.until - 1e-6 * step;
}

template <class T>
std::vector<T> own(const std::vector<T>& values, const std::vector<std::uint8_t>& ghost) {
    if (ghost.empty()) return values;
    std::vector<T> kept;
    kept.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        if (ghost[i] == 0) kept.push_back(values[i]);
    return kept;
}

void sample_standard(const Bodies& bodies, Pool& pool) {
    double speed_squared = 0.0;
    add_over_bodies(bodies, std::span<ExactSum, 2>(pool.sums(2)), [&](std::size_t i) {
        if (!bodies.is_ghost(i)) speed_squared = std::max(speed_squared, bodies.velocity[i].squaredNorm());
        return std::array{1.0, bodies.mass[i]};
    });
    pool.most(1)[0] = speed_squared;
}

void standard_values(const State& state, const StepReport& report, Pool& pool, Numbers& out) {
    const std::span<const double> sums = pool.next_sums(2);
    const double speed_squared = pool.next_most(1)[0];
    const Penetration& p = report.penetration;
    detail::append(
        out, {state.time, sums[0], sums[1], static_cast<double>(report.contacts), static_cast<double>(report.active),
              static_cast<double>(report.sweeps), report.residual_rms, report.residual_max, p.max, p.mean,
              p.max_relative, p.mean_relative, state.ledger.kinetic, state.ledger.potential});
    out.insert(out.end(), state.ledger.work.begin(), state.ledger.work.end());
    detail::append(out, {state.ledger.imbalance(), report.momentum_error, std::sqrt(speed_squared)});
}

void add_passages(std::span<const double> sums, MeasureState& counters) {
    counters.window_sum.resize(2, 0.0);
    counters.passed_mass += sums[0];
    counters.passed_count += sums[1];
    counters.window_sum[0] += sums[2];
    counters.window_sum[1] += sums[3];
}

void flow_rate_values(double time, MeasureState& counters, Numbers& out) {
    const double interval = time - counters.time_at_row;
    const double mass = counters.passed_mass - counters.passed_mass_at_row;
    const double count = counters.passed_count - counters.passed_count_at_row;
    detail::append(out, {interval > 0.0 ? mass / interval : 0.0, interval > 0.0 ? count / interval : 0.0,
                         counters.passed_mass, counters.passed_count});
    counters.passed_mass_at_row = counters.passed_mass;
    counters.passed_count_at_row = counters.passed_count;
    counters.time_at_row = time;
}

}  // namespace

Measures::Measures(const Scene& scene, const Communicator& ranks)
    : ranks_(ranks), counts_passages_(std::any_of(scene.measures.begin(), scene.measures.end(), [](const Measure& m) {
          return m.kind == MeasureKind::flow_rate;
      })) {}

void Measures::before_step(const State& state) {
    if (!counts_passages_) return;
    const Bodies& bodies = state.bodies;
    start_.time = state.time;
    start_.id = own(bodies.id, bodies.ghost);
    start_.mass = own(bodies.mass, bodies.ghost);
    start_.position = own(bodies.position, bodies.ghost);
    start_.velocity = own(bodies.velocity, bodies.ghost);
}

void Measures::after_step(const Scene& scene, State& state, const StepOutcome& outcome) {
    state.measures.resize(scene.measures.size());
    const auto weight_of = [&](const Measure& m) { return inside_window(m, state.time - outcome.length, state.time); };
    const auto is_due = [&](const Measure& m) {
        return detail::is_cheap(m.kind) ? weight_of(m) > 0.0 : window_ends(m, state.time, outcome.length);
    };
    pool_.clear();
    std::vector<detail::Flight> absent;
    if (counts_passages_) absent = detail::flights_of_absent({start_, scene, state}, ranks_);
    for (const Measure& measure : scene.measures) {
        if (measure.kind == MeasureKind::flow_rate)
            detail::count_passed({start_, scene, state}, absent, measure, pool_);
        else if (is_due(measure))
            detail::sample({scene, measure, state, outcome, ranks_}, pool_);
    }
    pool_.unite(ranks_);
    for (std::size_t i = 0; i < scene.measures.size(); ++i) {
        const Measure& measure = scene.measures[i];
        MeasureState& counters = state.measures[i];
        if (measure.kind == MeasureKind::flow_rate) {
            add_passages(pool_.next_sums(detail::kPassageSums), counters);
            counters.window_time += inside_window(measure, start_.time, state.time);
        } else if (is_due(measure)) {
            numbers_.clear();
            detail::read({scene, measure, state, outcome, ranks_}, pool_, numbers_);
            if (detail::is_cheap(measure.kind))
                add_to_window(numbers_, weight_of(measure), counters);
            else
                add_sample(measure, numbers_, state.time, counters);
        }
    }
}

std::vector<double> Measures::row(const Scene& scene, State& state, const StepOutcome& outcome,
                                  const StepReport& report) {
    state.measures.resize(scene.measures.size());
    pool_.clear();
    sample_standard(state.bodies, pool_);
    for (const Measure& measure : scene.measures) detail::sample({scene, measure, state, outcome, ranks_}, pool_);
    pool_.unite(ranks_);
    Numbers values;
    standard_values(state, report, pool_, values);
    for (std::size_t i = 0; i < scene.measures.size(); ++i) {
        const Measure& measure = scene.measures[i];
        MeasureState& counters = state.measures[i];
        if (measure.kind == MeasureKind::flow_rate) {
            flow_rate_values(state.time, counters, values);
            continue;
        }
        numbers_.clear();
        detail::read({scene, measure, state, outcome, ranks_}, pool_, numbers_);
        if (!detail::is_cheap(measure.kind)) add_sample(measure, numbers_, state.time, counters);
        const Numbers columns = detail::finish(scene, measure, numbers_);
        values.insert(values.end(), columns.begin(), columns.end());
    }
    return values;
}

std::vector<Measures::Mean> Measures::means(const Scene& scene, const State& state) {
    std::vector<Mean> means;
    for (std::size_t i = 0; i < std::min(scene.measures.size(), state.measures.size()); ++i) {
        const Measure& measure = scene.measures[i];
        const MeasureState& counters = state.measures[i];
        if (counters.window_time <= 0.0) continue;
        Numbers numbers = counters.window_sum;
        for (double& number : numbers) number /= counters.window_time;
        const Numbers values = detail::finish(scene, measure, numbers);
        std::size_t at = 0;
        for (const HistoryColumn& column : detail::columns_of(scene, measure)) {
            if (at == values.size()) break;  // a flow rate has a mean of its rates alone
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(at);
            means.push_back({measure.name + "." + column.name,
                             column.unit,
                             {first, first + column.width},
                             measure.from,
                             measure.until,
                             counters.window_time});
            at += static_cast<std::size_t>(column.width);
        }
    }
    return means;
}

}  // namespace scree::solvers
