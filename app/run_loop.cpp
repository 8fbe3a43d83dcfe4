#include "app/run_loop.hpp"

#include "app/phase_timer.hpp"

namespace scree::app {
namespace {

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
    return report;
}

void write_due(RunContext& run, const StepReport& report) {
    State& state = run.state;
    if (run.schedule.history_due(state.step)) run.output.history_row(state, measured_row(run, report));
    if (run.schedule.snapshot_due(state.step)) run.output.snapshot(run.scene, state, run.stepper.contacts());
    if (run.output.checkpoint_due()) run.output.checkpoint(state);
}

void show_progress(RunContext& run, const StepReport& report) {
    const bool report_due =
        run.progress.after_step({run.state.time, run.scene.time.end, run.state.step, run.schedule.steps, report});
    if (report_due) run.output.log_progress(run.state, report);
}

StepReport report_at_start(const State& state) {
    StepReport report;
    report.bodies = state.bodies.size();
    return report;
}

}  // namespace

RunEnd run_loop(RunContext& run) {
    State& state = run.state;
    RunEnd end;
    end.last = report_at_start(state);
    if (state.step == 0) write_due(run, end.last);
    while (state.step < run.schedule.steps) {
        end.last = measured_step(run);
        write_due(run, end.last);
        show_progress(run, end.last);
        const auto reason = run.stop.reason(run.output.longest_checkpoint());
        if (reason && state.step < run.schedule.steps) {
            end.reason = *reason;
            run.output.checkpoint(state);
            return end;
        }
    }
    run.output.log_progress(state, end.last);
    run.output.checkpoint(state);
    end.complete = true;
    return end;
}

}  // namespace scree::app
