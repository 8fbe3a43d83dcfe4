#include "app/output_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace scree::app {

std::uint64_t steps_until(double end, double step) {
    const double exact = end / step;
    const double nearest = std::round(exact);
    // 0.3 / 0.1 is not 3: a ratio this near to a whole number means that number.
    if (std::abs(exact - nearest) <= 1e-9 * std::max(1.0, nearest)) return static_cast<std::uint64_t>(nearest);
    return static_cast<std::uint64_t>(std::ceil(exact));
}

std::uint64_t interval_in_steps(double interval, double step) {
    return static_cast<std::uint64_t>(std::max(1.0, std::round(interval / step)));
}

OutputSchedule::OutputSchedule(const TimeSettings& time, const OutputSettings& output)
    : steps(steps_until(time.end, time.step)),
      history_every(interval_in_steps(output.history_interval, time.step)),
      snapshot_every(output.snapshot_interval > 0.0 ? interval_in_steps(output.snapshot_interval, time.step) : 0) {}

std::uint64_t OutputSchedule::snapshots() const {
    if (snapshot_every == 0) return steps == 0 ? 1 : 2;
    return 1 + steps / snapshot_every + (steps % snapshot_every == 0 ? 0 : 1);
}

std::uint64_t OutputSchedule::history_rows() const {
    return 1 + steps / history_every + (steps % history_every == 0 ? 0 : 1);
}

}  // namespace scree::app
