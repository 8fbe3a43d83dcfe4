// The kinds of measures, one after the other. Private to the measures.
//
// A kind is sampled as additive numbers (sums over bodies), so that a mean over time weighs what it should: the mean
// velocity of a bin is the mean momentum over the mean mass. `finish` turns the numbers, of one sample or averaged over
// samples, into the values of the columns. Where there is nothing to average (no body in the region) a value is nan.
// Flow rates are not sampled but counted, in every step.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/measures.hpp"

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
};

// Names without the measure's own.
Columns flow_rate_columns();
Columns mass_in_columns();
Columns extent_columns();
Columns wall_force_columns(const Measure& measure, const Scene& scene);
Columns coordination_columns();
Columns packing_columns();
Columns profile_columns(const Measure& measure, const Scene& scene);

// Appends the additive numbers.
void sample_mass_in(const Sampled& s, Numbers& out);
void sample_extent(const Sampled& s, Numbers& out);
void sample_wall_force(const Sampled& s, Numbers& out);
void sample_coordination(const Sampled& s, Numbers& out);
void sample_packing(const Sampled& s, Numbers& out);
void sample_profile(const Sampled& s, Numbers& out);

// The columns' values of additive numbers.
Numbers finish_extent(const Scene& scene, const Measure& measure, std::span<const double> numbers);
Numbers finish_coordination(std::span<const double> numbers);
Numbers finish_packing(const Measure& measure, std::span<const double> numbers);
Numbers finish_profile(const Measure& measure, std::span<const double> numbers);

// One of the above, by the measure's kind.
Columns columns_of(const Scene& scene, const Measure& measure);
void sample(const Sampled& s, Numbers& out);
Numbers finish(const Scene& scene, const Measure& measure, std::span<const double> numbers);

// Sampled in every step; the others, which cost more, at the rows of the history and at the end of the window.
bool is_cheap(MeasureKind kind);

bool in_region(const Measure& measure, const Vec3& x);  // true if the measure has no region

// Counts the bodies that passed the surface between the start of the step and now.
struct Passage {
    const StartOfStep& start;
    const Scene& scene;
    const State& state;
};
void count_passed(const Passage& passage, const Measure& measure, MeasureState& counters);

}  // namespace scree::solvers::detail
