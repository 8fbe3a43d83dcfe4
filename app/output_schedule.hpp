// At which steps something is written: counted in steps, not in time, so that a resumed run writes at the same ones.
#pragma once

#include <cstdint>

#include "core/settings.hpp"

namespace scree::app {

struct OutputSchedule {
    std::uint64_t steps = 0;           // of the whole run
    std::uint64_t history_every = 1;   // [steps]
    std::uint64_t snapshot_every = 0;  // [steps]; 0: only the first and the last

    OutputSchedule(const TimeSettings& time, const OutputSettings& output);

    // The first step (0) and the last are always due.
    bool history_due(std::uint64_t step) const { return step % history_every == 0 || step == steps; }
    bool snapshot_due(std::uint64_t step) const {
        return step == 0 || step == steps || (snapshot_every != 0 && step % snapshot_every == 0);
    }
    std::uint64_t snapshots() const;     // in the whole run
    std::uint64_t history_rows() const;  // in the whole run
};

// Steps until `end`: a last step that ends after `end` counts.
std::uint64_t steps_until(double end, double step);
// An interval in steps, at least 1.
std::uint64_t interval_in_steps(double interval, double step);

}  // namespace scree::app
