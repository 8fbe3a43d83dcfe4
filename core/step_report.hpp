// What one step did, and the sums over a run. Plain data: made by solvers/, written by io/, shown by app/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scree {

enum class Phase : std::size_t { detection, setup, solve, integration, correction, measures, output, count_ };
inline constexpr std::size_t kPhaseCount = static_cast<std::size_t>(Phase::count_);
inline constexpr std::array<std::string_view, kPhaseCount> kPhaseNames = {
    "detection", "setup", "solve", "integration", "correction", "measures", "output"};

// Penetration over the closed contacts at the end of a step.
struct Penetration {
    double max = 0.0;           // [m]
    double mean = 0.0;          // [m], over contacts that carry an impulse or overlap
    double max_relative = 0.0;  // of the mean diameter of the pair (of the body, at a wall)
    double mean_relative = 0.0;
};

struct StepReport {
    double step = 0.0;  // [s] length of the (sub)step
    std::size_t bodies = 0;
    std::size_t contacts = 0;  // in the contact problem
    std::size_t active = 0;    // with a non-zero impulse
    int sweeps = 0;
    double residual_rms = 0.0;  // scaled natural map (solvers/README.md), dimensionless
    double residual_max = 0.0;
    double reference_velocity = 0.0;  // [m/s] that scales it
    bool converged = true;
    double momentum_error = 0.0;  // |sum m dv - h F - wall impulses| / (sum m |v| + h |F|)
    Penetration penetration;
};

// Sums over all steps of a run (part of the state, so that a resumed run reports the whole).
struct RunTotals {
    std::uint64_t steps = 0;       // all steps, each substep counted
    std::uint64_t substepped = 0;  // scenario steps that were cut into substeps
    std::uint64_t steps_not_converged = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t contact_updates = 0;  // contacts x sweeps
    int sweeps_max = 0;
    double residual_sum = 0.0, residual_max = 0.0;  // of residual_rms
    double penetration_max = 0.0, penetration_max_relative = 0.0;
    double penetration_mean_sum = 0.0, penetration_mean_relative_sum = 0.0;  // over steps with contacts
    std::uint64_t steps_with_contacts = 0;
    double momentum_error_max = 0.0;
    std::array<double, kPhaseCount> wall_by_phase{};  // [s], the parts of a resumed run together
    double wall_time = 0.0;                           // [s]
};

}  // namespace scree
