// run.jsonl: the log for machines. One JSON object a line: first {"kind": "provenance"}, then {"kind": "progress"} each
// report interval (on many ranks also {"kind": "ranks"}), last {"kind": "status"}. Lines are only appended, and flushed
// each; a resumed run begins again with a provenance record.
//
// On many ranks rank 0 writes it, the others do nothing. All but progress() and ranks() are collective and throw on all
// ranks or on none; a failure of those two is thrown by status().
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/parallel/communicator.hpp"
#include "core/step_report.hpp"
#include "io/results/provenance.hpp"
#include "io/results/rank_loads.hpp"

namespace scree::io {

struct Progress {
    double time = 0.0;  // [s]
    std::uint64_t step = 0;
    std::size_t bodies = 0, contacts = 0;
    double sweeps = 0.0;                              // mean a step since the last record
    double residual = 0.0;                            // rms of the last step
    double penetration = 0.0;                         // [m] largest of the last step
    double kinetic_energy = 0.0;                      // [J]
    double mass = 0.0;                                // [kg]
    double wall_time = 0.0;                           // [s] of the whole run
    std::array<double, kPhaseCount> wall_by_phase{};  // [s]
};

class RunLog {
  public:
    // New (an old file is replaced) or continued; a half line that a killed run left is cut off.
    RunLog(std::string path, bool continued, const Communicator& ranks = Communicator::self());
    ~RunLog();
    RunLog(const RunLog&) = delete;
    RunLog& operator=(const RunLog&) = delete;

    void provenance(const Provenance& provenance);
    void progress(const Progress& progress);
    void ranks(const RankLoads& loads);  // as progress()
    // status: "complete", "stopped_early" or "failed"; `reason` in words, may be empty.
    void status(const std::string& status, const std::string& reason, double time, std::uint64_t step,
                std::uint64_t state_hash);

  private:
    void open(bool continued);
    void line(const std::string& text);
    void line_or_fault(const std::string& text);

    std::string path_;
    Communicator ranks_;
    std::string fault_;  // of an earlier line
    int file_ = -1;
};

}  // namespace scree::io
