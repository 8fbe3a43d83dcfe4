// scree run: sets a run up, lets it run, and says how it ended.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "app/commands.hpp"
#include "app/human_text.hpp"
#include "app/memory_model.hpp"
#include "app/run_loop.hpp"
#include "app/run_setup.hpp"
#include "app/run_summary.hpp"
#include "io/atomic_file.hpp"
#include "io/results/summary.hpp"

namespace scree::app {
namespace {

// A run whose last checkpoint and summary say that there is nothing left to do.
bool is_complete(const RunSetup& setup, const OutputSchedule& schedule, const RunFolder& folder) {
    if (!setup.resumed || setup.state.step < schedule.steps || !std::filesystem::exists(folder.summary())) return false;
    return io::read_text(folder.summary().string()).find("status: complete") != std::string::npos;
}

Plan plan_with_memory(const Scene& scene, const Bodies& bodies) {
    Plan plan = make_plan(scene, bodies);
    measure_memory(scene, plan);
    return plan;
}

void say_start(const RunSetup& setup, const Plan& plan, const OutputSchedule& schedule, const RunFolder& folder,
               Console& console) {
    const State& state = setup.state;
    console.info(fmt::format("{}: {}, {} of {:.4g} s, results in {}",
                             setup.scene.title.empty() ? "run" : setup.scene.title,
                             plural(state.bodies.size(), "body", "bodies"), plural(schedule.steps, "step", "steps"),
                             setup.scene.time.step, folder.path().string()));
    if (setup.resumed) {
        console.info(fmt::format("goes on from step {} (t = {:.6g} s)", count_text(state.step), state.time));
    }
    for (const PlanLine& line : plan.lines) {
        console.detail(fmt::format("  {} {}: {}", line.on ? "on " : "off", line.feature, line.reason));
    }
}

// Everything after the set-up: members in the order in which they need each other.
class Run {
  public:
    Run(RunSetup setup, const RunFolder& folder, double limit, Console& console)
        : setup_(std::move(setup)),
          folder_(folder),
          console_(console),
          plan_(plan_with_memory(setup_.scene, setup_.state.bodies)),
          schedule_(setup_.scene.time, setup_.scene.output),
          stepper_(setup_.scene, plan_),
          measures_(setup_.scene),
          output_(folder, setup_.scene, setup_.state, solvers::history_columns(setup_.scene), setup_.provenance,
                  setup_.resumed, console),
          progress_(console, setup_.scene.output.report_interval),
          stop_(folder.stop_file(), limit) {}

    ExitCode execute();

  private:
    void finish(const std::string& status, const std::string& reason, const StepReport& last);
    void note_failure(const Error& error);

    RunSetup setup_;
    const RunFolder& folder_;
    Console& console_;
    Plan plan_;
    OutputSchedule schedule_;
    solvers::Stepper stepper_;
    solvers::Measures measures_;
    RunOutput output_;
    Progress progress_;
    StopRequest stop_;
};

ExitCode Run::execute() {
    say_start(setup_, plan_, schedule_, folder_, console_);
    RunContext context{setup_.scene, setup_.state, stepper_, measures_, output_, progress_, stop_, schedule_};
    try {
        const RunEnd end = run_loop(context);
        finish(end.complete ? "complete" : "stopped_early", end.reason, end.last);
        if (end.complete) return ExitCode::complete;
        console_.info(fmt::format("to go on: scree run --resume --out {}", folder_.path().string()));
        return ExitCode::stopped_early;
    } catch (const Error& error) {
        console_.end_live();
        note_failure(error);
        console_.info(
            fmt::format("what was written until t = {:.6g} s is in {}", setup_.state.time, folder_.path().string()));
        throw;
    }
}

void Run::finish(const std::string& status, const std::string& reason, const StepReport& last) {
    console_.end_live();
    std::vector<std::string> warnings = console_.warnings();
    for (const std::string& warning : run_warnings(setup_.scene, setup_.state)) {
        if (console_.loudness() == Loudness::quiet) console_.warning(warning);
        warnings.push_back(warning);
    }
    const io::Summary summary =
        make_summary(setup_.scene, plan_, setup_.state, output_, last, status, reason, std::move(warnings));
    io::write_summary(folder_.summary().string(), summary);
    output_.log_status(setup_.state, status, reason);
    if (console_.loudness() != Loudness::quiet &&
        !write_all(STDOUT_FILENO, summary_text(summary, setup_.scene, folder_))) {
        console_.warning("standard output could not be written; the same is in summary.yaml");
    }
}

// The state is not fit for a checkpoint; those written before stand. The disk may be full: then the error itself has to
// do.
void Run::note_failure(const Error& error) {
    try {
        output_.flush_history();
        StepReport last;
        last.bodies = setup_.state.bodies.size();
        const io::Summary summary =
            make_summary(setup_.scene, plan_, setup_.state, output_, last, "failed", error.what(), console_.warnings());
        io::write_summary(folder_.summary().string(), summary);
        output_.log_status(setup_.state, "failed", error.what());
    } catch (const Error& second) {
        console_.warning(fmt::format("the summary could not be written: {}", second.what()));
    }
}

}  // namespace

ExitCode run_command(const RunOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const double limit = wall_limit(options.walltime);
    std::signal(SIGPIPE, SIG_IGN);  // who reads our messages may go; the run goes on
    Console console(options.loudness);
    RunFolder folder(options.out.empty() ? default_run_folder(options.scenario) : std::filesystem::path(options.out));
    RunSetup setup = set_up_run(options, folder);
    write_all(STDERR_FILENO, setup.scenario_warnings);
    for (const std::string& warning : setup.warnings) console.warning(warning);
    if (is_complete(setup, OutputSchedule(setup.scene.time, setup.scene.output), folder)) {
        console.info(fmt::format("the run in {} is complete (t = {:.6g} s). To make it longer: --set time.end=...",
                                 folder.path().string(), setup.state.time));
        return ExitCode::complete;
    }
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return Run(std::move(setup), folder, limit - elapsed, console).execute();
}

}  // namespace scree::app
