#include "app/run_loop.hpp"

#include <algorithm>
#include <array>

#include "app/phase_timer.hpp"

namespace scree::app {
namespace {

constexpr std::uint64_t kRankRecords = 100;  // in a run

std::vector<double> measured_row(RunContext& run, const StepReport& report) {
    const PhaseTimer timer(run.state.totals, Phase::measures);
    return run.measures.row(run.scene, run.state, run.stepper, report);
}

StepReport measured_step(RunContext& run) {
    State& state = run.state;
    run.measures.before_step(state);
    const StepReport report = run.stepper.advance(state);
    const PhaseTimer timer(state.totals, Phase::measures);
    run.measures.after_step(run.scene, state, run.stepper, report);
    run.rasters.after_step(run.scene, state);
    return report;
}

// What is decided after a step, beside what the step's number says; the same on all ranks but for `progress`.
struct Decisions {
    StopCause stop = StopCause::none;
    bool checkpoint = false, report = false;
    Progress::Due progress = Progress::Due::nothing;  // rank 0 shows it
};

Decisions decide(RunContext& run) {
    Decisions made;
    constexpr std::uint64_t kCheckpoint = 1, kReport = 2, kNothing = 0;
    std::array<std::uint64_t, 2> word{};
    word[0] = static_cast<std::uint64_t>(run.stop.cause(run.output.longest_checkpoint()));
    if (run.ranks.root()) {
        made.progress = run.progress.due();
        word[1] = (run.output.checkpoint_due() ? kCheckpoint : kNothing) |
                  (made.progress == Progress::Due::report ? kReport : kNothing);
    }
    run.ranks.max(word);
    made.stop = static_cast<StopCause>(word[0]);
    made.checkpoint = (word[1] & kCheckpoint) != 0;
    made.report = (word[1] & kReport) != 0;
    return made;
}

void write_checkpoint(RunContext& run) {
    run.output.checkpoint(run.state, run.times.mean(run.state));
}

void write_due(RunContext& run, const StepReport& report) {
    State& state = run.state;
    if (run.schedule.history_due(state.step)) run.output.history_row(state, measured_row(run, report));
    const bool row_due = state.step % run.scene.trajectories.every == 0 || state.step == run.schedule.steps;
    if (!state.followed.empty() && row_due)
        run.output.trajectory_row(state, solvers::trajectory_row(run.scene, state, run.plan, run.ranks));
    if (!run.schedule.snapshot_due(state.step)) return;
    if (run.scene.rasters && run.scene.rasters->at_snapshots)
        run.output.rasters(run.scene, state, run.rasters.depth(run.scene, state));
    run.output.snapshot(run.scene, state, run.stepper.contacts());
}

void log_progress(RunContext& run, const StepReport& report) {
    run.output.log_progress(run.state, report, run.times.mean(run.state));
}

// How ranks share the work, a hundred times in a run: by steps, which all ranks count alike.
bool ranks_due(const RunContext& run) {
    const std::uint64_t steps = run.schedule.steps, every = std::max<std::uint64_t>(steps / kRankRecords, 1);
    return !run.ranks.alone() && (run.state.step % every == 0 || run.state.step == steps);
}
void log_ranks(RunContext& run) {
    run.output.log_ranks(run.times.loads(run.state, run.stepper.rank_report(run.state)));
}

void show_progress(RunContext& run, const StepReport& report, const Decisions& made) {
    run.progress.show(made.progress, {run.state.time, run.scene.time.end, run.state.step, run.schedule.steps, report});
    if (made.report) log_progress(run, report);
}

StepReport report_at_start(const RunContext& run) {
    StepReport report;
    report.bodies = run.ranks.sum(static_cast<std::uint64_t>(run.state.bodies.owned()));
    return report;
}

}  // namespace

RunEnd run_loop(RunContext& run) {
    State& state = run.state;
    RunEnd end;
    run.stepper.start(state);
    run.rasters.start(run.scene, state);
    end.last = report_at_start(run);
    if (state.step == 0) write_due(run, end.last);
    while (state.step < run.schedule.steps) {
        end.last = measured_step(run);
        const Decisions made = decide(run);
        write_due(run, end.last);
        show_progress(run, end.last, made);
        if (ranks_due(run)) log_ranks(run);
        const bool stop = made.stop != StopCause::none && state.step < run.schedule.steps;
        if (stop || made.checkpoint) write_checkpoint(run);
        if (stop) {
            end.reason = run.stop.reason(made.stop);
            return end;
        }
    }
    log_progress(run, end.last);
    write_checkpoint(run);
    end.complete = true;
    return end;
}

}  // namespace scree::app
