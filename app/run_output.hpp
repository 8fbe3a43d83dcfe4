// What a run writes to its folder: snapshots, history, checkpoints, run.jsonl, summary. Wraps io/ with the order that
// keeps them consistent (history on the disk before each checkpoint) and counts the time that it takes. All ranks call
// these functions together.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/rank_times.hpp"
#include "app/run_folder.hpp"
#include "core/contact_record.hpp"
#include "core/measure.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/results/history.hpp"
#include "io/results/provenance.hpp"
#include "io/results/run_log.hpp"
#include "io/results/snapshot.hpp"

namespace scree::app {

class RunOutput {
  public:
    // Opens the files; `resumed`: goes on with those of the folder, cut back to where `state` stands.
    // `trajectories`: their columns; none is written without bodies to follow.
    RunOutput(const RunFolder& folder, const Scene& scene, const State& state, std::vector<HistoryColumn> columns,
              std::vector<HistoryColumn> trajectories, io::Provenance provenance, bool resumed, Console& console,
              const Communicator& ranks);

    void history_row(State& state, const std::vector<double>& row);
    void trajectory_row(State& state, const std::vector<double>& row);
    // With the number of the next snapshot. `depth`: flow depth now.
    void rasters(const Scene& scene, const State& state, const std::vector<double>& depth);
    void snapshot(const Scene& scene, State& state, const std::vector<ContactRecord>& contacts);
    // Also brings the history to the disk. `own`: the impulses that this rank solved; `phases`: to be written as those
    // of the run.
    void checkpoint(State& state, const PhaseTimes& phases);
    bool checkpoint_due() const;  // by this rank's clock
    void log_progress(const State& state, const StepReport& report, const PhaseTimes& phases);
    void log_ranks(const io::RankLoads& loads);
    void log_status(const State& state, const std::string& status, const std::string& reason);
    void flush_history();  // and the trajectories

    // [s] the longest that a checkpoint took; at the start a guess from the size of the state.
    double longest_checkpoint() const { return longest_checkpoint_; }
    bool has_checkpoint() const { return !last_checkpoint_.empty(); }
    // All snapshots in the folder, those of earlier parts of a resumed run too.
    struct Files {
        std::uint64_t count = 0, bytes = 0;
    };
    Files snapshot_files() const;
    const io::Provenance& provenance() const { return provenance_; }

  private:
    using Clock = std::chrono::steady_clock;
    void update_wall_time(State& state) const;

    const RunFolder& folder_;
    Console& console_;
    const Communicator& ranks_;
    io::Provenance provenance_;
    io::HistoryWriter history_;
    std::optional<io::HistoryWriter> trajectories_;
    io::SnapshotSeries snapshots_;
    io::RunLog log_;
    double checkpoint_interval_;
    double wall_before_;  // [s] of the earlier parts of a resumed run
    Clock::time_point start_, last_checkpoint_time_;
    std::string last_checkpoint_;
    double longest_checkpoint_;
    std::uint64_t sweeps_logged_, steps_logged_;
};

}  // namespace scree::app
