// The columns of the history, and which function answers for a kind of measure.
#include <fmt/format.h>

#include "solvers/measure_kinds.hpp"

namespace scree::solvers {
namespace detail {

Columns columns_of(const Scene& scene, const Measure& measure) {
    switch (measure.kind) {
        case MeasureKind::flow_rate:
            return flow_rate_columns();
        case MeasureKind::mass_in:
            return mass_in_columns();
        case MeasureKind::wall_force:
            return wall_force_columns(measure, scene);
        case MeasureKind::coordination:
            return coordination_columns();
        case MeasureKind::packing_fraction:
            return packing_columns();
        case MeasureKind::profile:
            return profile_columns(measure, scene);
        case MeasureKind::extent:
            return extent_columns();
    }
    return {};
}

void sample(const Sampled& s, Pool& pool) {
    switch (s.measure.kind) {
        case MeasureKind::flow_rate:   // counted, not sampled
        case MeasureKind::wall_force:  // only read
            return;
        case MeasureKind::mass_in:
            return sample_mass_in(s, pool);
        case MeasureKind::coordination:
            return sample_coordination(s, pool);
        case MeasureKind::packing_fraction:
            return sample_packing(s, pool);
        case MeasureKind::profile:
            return sample_profile(s, pool);
        case MeasureKind::extent:
            return sample_extent(s, pool);
    }
}

void read(const Sampled& s, Pool& pool, Numbers& out) {
    const auto sums = [&](std::size_t n) {
        for (const double sum : pool.next_sums(n)) out.push_back(sum);
    };
    switch (s.measure.kind) {
        case MeasureKind::flow_rate:
            return;
        case MeasureKind::wall_force:
            return read_wall_force(s, out);
        case MeasureKind::mass_in:
            return sums(2);
        case MeasureKind::coordination:
            return sums(3);
        case MeasureKind::packing_fraction:
            return sums(1);
        case MeasureKind::profile:
            return sums(5 * static_cast<std::size_t>(s.measure.bins));
        case MeasureKind::extent:
            return read_extent(pool, out);
    }
}

Numbers finish(const Scene& scene, const Measure& measure, std::span<const double> numbers) {
    switch (measure.kind) {
        case MeasureKind::coordination:
            return finish_coordination(numbers);
        case MeasureKind::packing_fraction:
            return finish_packing(measure, numbers);
        case MeasureKind::profile:
            return finish_profile(measure, numbers);
        case MeasureKind::extent:
            return finish_extent(scene, measure, numbers);
        default:
            return {numbers.begin(), numbers.end()};
    }
}

bool is_cheap(MeasureKind kind) {
    return kind == MeasureKind::mass_in || kind == MeasureKind::wall_force || kind == MeasureKind::extent;
}

}  // namespace detail

std::vector<HistoryColumn> history_columns(const Scene& scene) {
    std::vector<HistoryColumn> columns = {
        {"time", "s", "Simulated time", 1},
        {"bodies", "1", "Bodies in the scene", 1},
        {"mass", "kg", "Mass of the bodies in the scene", 1},
        {"contacts", "1", "Contacts in the last step's contact problem", 1},
        {"active_contacts", "1", "Contacts with a non-zero impulse", 1},
        {"sweeps", "1", "Sweeps of the solver in the last step", 1},
        {"residual_rms", "1", "Scaled natural map at the end of the solve, root mean square over contacts", 1},
        {"residual_max", "1", "Scaled natural map at the end of the solve, largest", 1},
        {"penetration_max", "m", "Deepest penetration of a contact", 1},
        {"penetration_mean", "m", "Mean penetration of the closed contacts", 1},
        {"penetration_max_relative", "1", "Deepest penetration over the mean diameter of the pair", 1},
        {"penetration_mean_relative", "1", "Mean of penetration over the mean diameter of the pair", 1},
        {"kinetic_energy", "J", "Kinetic energy, of rotation too", 1},
        {"potential_energy", "J", "Potential energy in gravity, 0 at the scene's origin", 1}};
    for (std::string_view law : kWorkNames) {
        columns.push_back(
            {fmt::format("work.{}", law), "J", fmt::format("Energy given by {} since the start", law), 1});
    }
    columns.push_back(
        {"energy_imbalance", "J", "Change of energy since the start less all work: 0 but for round-off", 1});
    columns.push_back({"momentum_error", "1", "Momentum of the last step not accounted for, over the sum of m |v|", 1});
    columns.push_back({"max_speed", "m/s", "Speed of the fastest body", 1});
    for (const Measure& measure : scene.measures) {
        for (HistoryColumn& column : detail::columns_of(scene, measure)) {
            column.name = measure.name + "." + column.name;
            columns.push_back(std::move(column));
        }
    }
    return columns;
}

}  // namespace scree::solvers
