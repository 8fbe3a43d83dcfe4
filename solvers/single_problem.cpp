#include "solvers/single_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::solvers {
namespace {

// The tolerance over the round-off of velocities.
constexpr double kMargin = 1e3;
constexpr double kLeastTolerance = 1e-3, kMostMassRatio = 1e6;

}  // namespace

bool single_is_enough(const SolverSettings& settings, const Extremes& extremes, double v_ref) {
    constexpr double kRound = std::numeric_limits<float>::epsilon();
    // friction multiplies round-off: mu |u_T| stands in the natural map
    return settings.precision == SolverPrecision::mixed && settings.tolerance >= kLeastTolerance &&
           settings.tolerance * v_ref >= kMargin * kRound * (1.0 + extremes.friction) * extremes.fastest &&
           extremes.lightest * extremes.heaviest <= kMostMassRatio;
}

// Longest blocks first, each to the half that has fewer batches so far.
template <class Law>
void SingleProblem<Law>::deal(const Layout& layout, std::uint32_t from, std::uint32_t to,
                              std::array<std::uint32_t, 2>& next) {
    sorted_.assign(layout.blocks().begin() + from, layout.blocks().begin() + to);
    std::sort(sorted_.begin(), sorted_.end(), [](const Block& a, const Block& b) {
        const std::uint32_t of_a = a.end - a.begin, of_b = b.end - b.begin;
        return of_a != of_b ? of_a > of_b : a.begin < b.begin;
    });
    for (const Block& block : sorted_) {
        const std::size_t half = next[0] <= next[1] ? 0 : 1;
        places_.push_back({block.begin, block.end, next[half], static_cast<int>(half)});
        next[half] += block.end - block.begin;
        runs_.push_back({0, next[half], {half == 0, half == 1}});
    }
}

// Runs go from end to end of blocks of either half; the first begins at `at`.
template <class Law>
void SingleProblem<Law>::join_runs(std::size_t first, std::uint32_t at) {
    if (first == runs_.size()) return;
    std::sort(runs_.begin() + static_cast<std::ptrdiff_t>(first), runs_.end(),
              [](const Run& a, const Run& b) { return a.end < b.end; });
    std::size_t last = first;
    for (std::size_t k = first + 1; k < runs_.size(); ++k) {
        if (runs_[k].end == runs_[last].end)
            runs_[last].ends = {true, true};
        else
            runs_[++last] = runs_[k];
    }
    runs_.resize(last + 1);
    for (std::size_t k = first; k < runs_.size(); ++k) runs_[k].begin = k == first ? at : runs_[k - 1].end;
}

// The blocks at a border are done first; inner ones fill the half that is through with them.
template <class Law>
void SingleProblem<Law>::arrange(const Layout& layout) {
    places_.clear();
    runs_.clear();
    std::array<std::uint32_t, 2> next{};
    for (std::size_t k = 0; k < kPhases; ++k) {
        const Layout::PhaseBlocks& of = layout.phase(k);
        const std::size_t first = runs_.size();
        const std::uint32_t at = next[0];
        deal(layout, of.begin, of.inner, next);
        const std::uint32_t border = std::max(next[0], next[1]);
        deal(layout, of.inner, of.end, next);
        join_runs(first, at);
        const auto inner = std::find_if(runs_.begin() + static_cast<std::ptrdiff_t>(first), runs_.end(),
                                        [border](const Run& run) { return run.begin >= border; });
        phase_[k] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(inner - runs_.begin()),
                     static_cast<std::uint32_t>(runs_.size())};
        next.fill(std::max(next[0], next[1]));
    }
    sweeps.batch.assign(next[0], {});
}

template <class Law>
void SingleProblem<Law>::load(const Sweeps<Law, double>& full, const Layout& layout, const Extremes& extremes,
                              double v_ref) {
    arrange(layout);
    unit_.velocity = std::ldexp(1.0, std::ilogb(v_ref));
    unit_.inverse_mass = std::ldexp(1.0, (std::ilogb(extremes.lightest) - std::ilogb(extremes.heaviest)) >> 1);
    if (extremes.lever > 0.0) unit_.length = std::ldexp(1.0, std::ilogb(extremes.lever));

    sweeps.line.resize(full.line.size());
    for (std::size_t i = 0; i < full.line.size(); ++i) to_single(sweeps.line[i], full.line[i], unit_);
    for (const Place& place : places_)
        for (std::uint32_t k = place.from; k < place.to; ++k)
            to_single(sweeps.batch[place.at + (k - place.from)], full.batch[k], place.half * kLanes, unit_);
}

template <class Law>
void SingleProblem<Law>::give_impulses(Sweeps<Law, double>& full) const {
    const double unit = unit_.impulse();
    for (const Place& place : places_)
        for (std::uint32_t k = place.from; k < place.to; ++k) {
            const auto& from = sweeps.batch[place.at + (k - place.from)];
            for (int d = 0; d < Law::kImpulse; ++d)
                for (int i = 0; i < kLanes; ++i)
                    full.batch[k].p[d][i] = unit * static_cast<double>(from.p[d][place.half * kLanes + i]);
            into_cone(full.batch[k]);
        }
}

template <class Law>
std::size_t SingleProblem<Law>::bytes() const {
    return sweeps.bytes() + places_.capacity() * sizeof(Place) + runs_.capacity() * sizeof(Run) +
           sorted_.capacity() * sizeof(Block);
}

template class SingleProblem<Frictional>;
template class SingleProblem<Frictionless>;
template class SingleProblem<RigidFrictional>;
template class SingleProblem<RigidFrictionless>;

}  // namespace scree::solvers
