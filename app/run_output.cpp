#include "app/run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/error_agreement.hpp"
#include "app/phase_timer.hpp"
#include "core/state_hash.hpp"
#include "io/atomic_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/raster_files.hpp"
#include "solvers/energy.hpp"

namespace scree::app {
namespace fs = std::filesystem;
namespace {

constexpr double kCheckpointBytesPerSecond = 20e6;  // a cautious guess, used until the first one is measured

double seconds_since(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

// `rows`: how many of them a resumed run goes on with.
io::HistoryWriter open_history(const std::string& path, std::uint64_t rows, std::vector<HistoryColumn> columns,
                               const io::Provenance& provenance, bool resumed, const Communicator& ranks) {
    if (resumed) return io::HistoryWriter::resume(path, std::move(columns), rows, provenance, ranks);
    return io::HistoryWriter::create(path, std::move(columns), provenance, ranks);
}

// Snapshots that lie after the checkpoint are made again, perhaps at other times: none may stay behind.
io::SnapshotSeries open_snapshots(const RunFolder& folder, const State& state, const Communicator& ranks) {
    at_root(ranks, [&] {
        for (const std::string& file : io::list_snapshots(folder.path().string())) {
            if (std::stoull(fs::path(file).stem().string()) >= state.snapshots_written) fs::remove(file);
        }
    });
    return io::SnapshotSeries(folder.path().string(), state.snapshots_written, ranks);
}

}  // namespace

RunOutput::RunOutput(const RunFolder& folder, const Scene& scene, const State& state,
                     std::vector<HistoryColumn> columns, std::vector<HistoryColumn> trajectories,
                     io::Provenance provenance, bool resumed, Console& console, const Communicator& ranks)
    : folder_(folder),
      console_(console),
      ranks_(ranks),
      provenance_(std::move(provenance)),
      history_(
          open_history(folder.history().string(), state.history_rows, std::move(columns), provenance_, resumed, ranks)),
      snapshots_(open_snapshots(folder, state, ranks)),
      log_(folder.run_log().string(), resumed, ranks),
      checkpoint_interval_(scene.output.checkpoint_interval),
      wall_before_(state.totals.wall_time),
      start_(Clock::now()),
      last_checkpoint_time_(start_),
      longest_checkpoint_(200.0 * static_cast<double>(state.bodies.size()) / kCheckpointBytesPerSecond),
      sweeps_logged_(state.totals.sweeps),
      steps_logged_(state.totals.steps) {
    log_.provenance(provenance_);
    if (state.followed.empty()) return;
    trajectories_ = open_history(folder.trajectories().string(), state.trajectory_rows, std::move(trajectories),
                                 provenance_, resumed, ranks);
}

void RunOutput::update_wall_time(State& state) const {
    state.totals.wall_time = ranks_.max(wall_before_ + seconds_since(start_));
}

void RunOutput::history_row(State& state, const std::vector<double>& row) {
    const PhaseTimer timer(state.totals, Phase::output);
    history_.append(row);
    ++state.history_rows;
    history_.flush_if_due();
}

void RunOutput::trajectory_row(State& state, const std::vector<double>& row) {
    const PhaseTimer timer(state.totals, Phase::output);
    trajectories_->append(row);
    ++state.trajectory_rows;
    trajectories_->flush_if_due();
}

void RunOutput::flush_history() {
    history_.flush();
    if (trajectories_) trajectories_->flush();
}

void RunOutput::rasters(const Scene& scene, const State& state, const std::vector<double>& depth) {
    const std::string name = fmt::format("{:06}.h5", state.snapshots_written);
    io::write_raster_file((folder_.rasters() / name).string(), scene, state, depth, provenance_, ranks_);
}

void RunOutput::snapshot(const Scene& scene, State& state, const std::vector<ContactRecord>& contacts) {
    const PhaseTimer timer(state.totals, Phase::output);
    snapshots_.write(scene, state, contacts, provenance_);
    console_.detail(fmt::format("t = {:.6g} s: snapshot {:06}", state.time, state.snapshots_written - 1));
}

void RunOutput::checkpoint(State& state, const PhaseTimes& phases) {
    const Clock::time_point begin = Clock::now();
    {
        const PhaseTimer timer(state.totals, Phase::output);
        flush_history();
    }
    update_wall_time(state);
    const bool first = last_checkpoint_.empty();
    const PhaseTimes timed_here = std::exchange(state.totals.wall_by_phase, phases);
    last_checkpoint_ = io::write_checkpoint(folder_.checkpoints().string(), state, provenance_, ranks_);
    state.totals.wall_by_phase = timed_here;
    last_checkpoint_time_ = Clock::now();
    longest_checkpoint_ = first ? seconds_since(begin) : std::max(longest_checkpoint_, seconds_since(begin));
    console_.detail(fmt::format("t = {:.6g} s: checkpoint {}", state.time, last_checkpoint_));
}

bool RunOutput::checkpoint_due() const {
    return checkpoint_interval_ > 0.0 && seconds_since(last_checkpoint_time_) >= checkpoint_interval_;
}

void RunOutput::log_progress(const State& state, const StepReport& report, const PhaseTimes& phases) {
    io::Progress record;
    record.time = state.time;
    record.step = state.step;
    record.bodies = report.bodies;
    record.contacts = report.contacts;
    const std::uint64_t steps = state.totals.steps - steps_logged_;
    if (steps > 0)
        record.sweeps = static_cast<double>(state.totals.sweeps - sweeps_logged_) / static_cast<double>(steps);
    record.residual = report.residual_rms;
    record.penetration = report.penetration.max;
    record.kinetic_energy = state.ledger.kinetic;
    record.mass = solvers::momentum_of(state.bodies, ranks_).mass;
    record.wall_time = wall_before_ + seconds_since(start_);
    record.wall_by_phase = phases;
    log_.progress(record);
    steps_logged_ = state.totals.steps;
    sweeps_logged_ = state.totals.sweeps;
}

void RunOutput::log_ranks(const io::RankLoads& loads) {
    log_.ranks(loads);
}

RunOutput::Files RunOutput::snapshot_files() const {
    Files files;
    for (const std::string& path : io::list_snapshots(folder_.path().string())) {
        std::error_code fault;
        const auto size = fs::file_size(path, fault);
        ++files.count;
        if (!fault) files.bytes += size;
    }
    return files;
}

void RunOutput::log_status(const State& state, const std::string& status, const std::string& reason) {
    log_.status(status, reason, state.time, state.step, state_hash(state.bodies, ranks_));
}

}  // namespace scree::app
