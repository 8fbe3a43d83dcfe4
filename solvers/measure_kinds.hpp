// The kinds of measures, one after the other. Private to the measures.
//
// A kind is sampled as additive numbers (sums over bodies), so that a mean over time weighs what it should: the mean
// velocity of a bin is the mean momentum over the mean mass. `finish` turns the numbers, of one sample or averaged over
// samples, into the values of the columns. Where there is nothing to average (no body in the region) a value is nan.
// Flow rates are not sampled but counted, in every step.
//
// Sampling has two halves: `sample` puts what this rank's own bodies and contacts give into a pool, and once the pools
// of all ranks are one, `read` takes the numbers out, the same on every rank.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/measures.hpp"
#include "solvers/pool.hpp"

namespace scree::solvers::detail {

using Numbers = std::vector<double>;
using Columns = std::vector<HistoryColumn>;

inline void append(Numbers& out, std::initializer_list<double> values) {
    for (double value : values) out.push_back(value);
}

// What a sample is taken of.
struct Sampled {
    const Scene& scene;
    const Measure& measure;
    const State& state;
    const StepOutcome& outcome;
    const Communicator& ranks;
};

// Names without the measure's own.
Columns flow_rate_columns();
Columns mass_in_columns();
Columns extent_columns();
Columns wall_force_columns(const Measure& measure, const Scene& scene);
Columns coordination_columns();
Columns packing_columns();
Columns profile_columns(const Measure& measure, const Scene& scene);

void sample_mass_in(const Sampled& s, Pool& pool);
void sample_extent(const Sampled& s, Pool& pool);
void sample_coordination(const Sampled& s, Pool& pool);
void sample_packing(const Sampled& s, Pool& pool);
void sample_profile(const Sampled& s, Pool& pool);

// Appends the additive numbers. The others' are their sums.
void read_wall_force(const Sampled& s, Numbers& out);  // nothing to sample: loads are known on every rank
void read_extent(Pool& pool, Numbers& out);

// The columns' values of additive numbers.
Numbers finish_extent(const Scene& scene, const Measure& measure, std::span<const double> numbers);
Numbers finish_coordination(std::span<const double> numbers);
Numbers finish_packing(const Measure& measure, std::span<const double> numbers);
Numbers finish_profile(const Measure& measure, std::span<const double> numbers);

// One of the above, by the measure's kind.
Columns columns_of(const Scene& scene, const Measure& measure);
void sample(const Sampled& s, Pool& pool);              // collective
void read(const Sampled& s, Pool& pool, Numbers& out);  // in the order of sample
Numbers finish(const Scene& scene, const Measure& measure, std::span<const double> numbers);

// Sampled in every step; the others, which cost more, at the rows of the history and at the end of the window.
bool is_cheap(MeasureKind kind);

bool in_region(const Measure& measure, const Vec3& x);  // true if the measure has no region

// A body's way in a scenario step, as far as surfaces ask.
struct Flight {
    double mass;    // [kg]
    Vec3 from, to;  // [m]
    double slack;   // [m] how far `to` may be off by round-off
};
struct Passage {
    const StartOfStep& start;
    const Scene& scene;
    const State& state;
};
// The flights that this rank counts of bodies that it had at the start and does not hold now. Collective.
std::vector<Flight> flights_of_absent(const Passage& passage, const Communicator& ranks);
// Counts the bodies that passed the surface between the start of the step and now: mass and number, and mass and number
// of those that passed in the measure's window.
inline constexpr std::size_t kPassageSums = 4;
void count_passed(const Passage& passage, std::span<const Flight> absent, const Measure& measure, Pool& pool);

}  // namespace scree::solvers::detail
