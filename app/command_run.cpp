// scree run: sets a run up, lets it run, and says how it ended.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "app/commands.hpp"
#include "app/error_agreement.hpp"
#include "app/human_text.hpp"
#include "app/memory_model.hpp"
#include "app/run_loop.hpp"
#include "app/run_setup.hpp"
#include "app/run_summary.hpp"
#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"
#include "io/results/raster_files.hpp"
#include "io/results/summary.hpp"
#include "solvers/runout.hpp"

namespace scree::app {
namespace {

// A run whose last checkpoint and summary say that there is nothing left to do.
bool is_complete(const RunSetup& setup, const RunFolder& folder, const Communicator& ranks) {
    const OutputSchedule schedule(setup.scene.time, setup.scene.output);
    if (!setup.resumed || setup.state.step < schedule.steps) return false;
    bool complete = false;
    at_root(ranks, [&] {
        complete = std::filesystem::exists(folder.summary()) &&
                   io::read_text(folder.summary().string()).find("status: complete") != std::string::npos;
    });
    return ranks.any(complete);
}

Plan plan_with_memory(const Scene& scene, const Bodies& bodies, const Communicator& ranks) {
    Plan plan = make_plan(scene, bodies, ranks);
    measure_memory(scene, plan);
    return plan;
}

void say_start(const RunSetup& setup, const Plan& plan, const OutputSchedule& schedule, const RunFolder& folder,
               Console& console, const Communicator& ranks) {
    const State& state = setup.state;
    const std::uint64_t bodies = ranks.sum(static_cast<std::uint64_t>(state.bodies.owned()));
    console.info(fmt::format("{}: {}, {} of {:.4g} s{}, results in {}",
                             setup.scene.title.empty() ? "run" : setup.scene.title, plural(bodies, "body", "bodies"),
                             plural(schedule.steps, "step", "steps"), setup.scene.time.step,
                             ranks.alone() ? "" : fmt::format(" on {} ranks", ranks.size()), folder.path().string()));
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
    Run(RunSetup setup, const RunFolder& folder, double limit, Console& console, const Communicator& ranks)
        : setup_(std::move(setup)),
          folder_(folder),
          console_(console),
          ranks_(ranks),
          plan_(plan_with_memory(setup_.scene, setup_.state.bodies, ranks)),
          schedule_(setup_.scene.time, setup_.scene.output),
          stepper_(setup_.scene, plan_, ranks),
          measures_(setup_.scene, ranks),
          rasters_(setup_.scene, ranks),
          times_(setup_.state, ranks),
          output_(folder, setup_.scene, setup_.state, solvers::history_columns(setup_.scene),
                  solvers::trajectory_columns(setup_.state, plan_), setup_.provenance, setup_.resumed, console, ranks),
          progress_(console, setup_.scene.output.report_interval),
          stop_(folder.stop_file(), limit, ranks.root()) {}

    ExitCode execute(ErrorAgreement& errors);

  private:
    void finish(const std::string& status, const std::string& reason, const StepReport& last);
    Runout finish_rasters();
    void note_failure(const Error& error);
    // Writes the summary and the last record of the log.
    void close_books(const io::Summary& summary, const std::vector<RankFigures>& all);
    std::vector<RankFigures> figures() const;

    RunSetup setup_;
    const RunFolder& folder_;
    Console& console_;
    const Communicator& ranks_;
    Plan plan_;
    OutputSchedule schedule_;
    solvers::Stepper stepper_;
    solvers::Measures measures_;
    solvers::Rasters rasters_;
    RankTimes times_;
    RunOutput output_;
    Progress progress_;
    StopRequest stop_;
};

ExitCode Run::execute(ErrorAgreement& errors) {
    say_start(setup_, plan_, schedule_, folder_, console_, ranks_);
    RunContext context{setup_.scene, plan_,     setup_.state, stepper_, measures_, rasters_,
                       output_,      progress_, stop_,        times_,   schedule_, ranks_};
    try {
        const RunEnd end = run_loop(context);
        finish(end.complete ? "complete" : "stopped_early", end.reason, end.last);
        if (end.complete) return ExitCode::complete;
        console_.info(fmt::format("to go on: scree run --resume --out {}", folder_.path().string()));
        return ExitCode::stopped_early;
    } catch (const Error& error) {
        console_.end_live();
        if (errors.everywhere()) note_failure(error);
        console_.info(
            fmt::format("what was written until t = {:.6g} s is in {}", setup_.state.time, folder_.path().string()));
        throw;
    }
}

std::vector<RankFigures> Run::figures() const {
    return gather(times_.figures(setup_.state, stepper_.rank_report(setup_.state)), ranks_);
}

void Run::close_books(const io::Summary& summary, const std::vector<RankFigures>& all) {
    by_root(ranks_,
            [&] { io::write_text_atomically(folder_.summary().string(), io::to_yaml(summary) + ranks_section(all)); });
    output_.log_status(setup_.state, summary.status, summary.reason);
}

void Run::finish(const std::string& status, const std::string& reason, const StepReport& last) {
    console_.end_live();
    std::vector<std::string> warnings = console_.warnings();
    for (const std::string& warning : run_warnings(setup_.scene, setup_.state)) {
        if (console_.loudness() == Loudness::quiet) console_.warning(warning);
        warnings.push_back(warning);
    }
    io::Summary summary =
        make_summary(setup_.scene, plan_, setup_.state, output_, last, status, reason, std::move(warnings), ranks_);
    if (setup_.scene.rasters) summary.runout = finish_rasters();
    summary.totals.wall_by_phase = times_.mean(setup_.state);
    const std::vector<RankFigures> all = figures();
    close_books(summary, all);
    if (console_.loudness() > Loudness::quiet &&
        !write_all(STDOUT_FILENO, summary_text(summary, setup_.scene, folder_, all))) {
        console_.warning("standard output could not be written; the same is in summary.yaml");
    }
}

// Rasters as they stand to their files, and what follows from them.
Runout Run::finish_rasters() {
    rasters_.finish(setup_.scene, setup_.state);
    const std::vector<double> deposit = rasters_.depth(setup_.scene, setup_.state);
    io::write_rasters(folder_.rasters().string(), setup_.scene, setup_.state, deposit, output_.provenance(), ranks_);
    return solvers::runout(setup_.scene, setup_.state, deposit, ranks_);
}

// The state is not fit for a checkpoint; those written before stand. The disk may be full: then the error itself has to
// do.
void Run::note_failure(const Error& error) {
    try {
        output_.flush_history();
        StepReport last;
        last.bodies = ranks_.sum(static_cast<std::uint64_t>(setup_.state.bodies.owned()));
        close_books(make_summary(setup_.scene, plan_, setup_.state, output_, last, "failed", error.what(),
                                 console_.warnings(), ranks_),
                    figures());
    } catch (const Error& second) {
        console_.warning(fmt::format("the summary could not be written: {}", second.what()));
    }
}

}  // namespace

ExitCode run_command(const RunOptions& options, const Communicator& ranks, ErrorAgreement& errors) {
    const auto begin = std::chrono::steady_clock::now();
    const double limit = wall_limit(options.walltime);
    std::signal(SIGPIPE, SIG_IGN);  // who reads our messages may go; the run goes on
    Console console(ranks.root() ? options.loudness : Loudness::silent);
    RunFolder folder(options.out.empty() ? default_run_folder(options.scenario) : std::filesystem::path(options.out));
    RunSetup setup = set_up_run(options, folder, ranks);
    if (ranks.root()) write_all(STDERR_FILENO, setup.scenario_warnings);
    for (const std::string& warning : setup.warnings) console.warning(warning);
    if (is_complete(setup, folder, ranks)) {
        console.info(fmt::format("the run in {} is complete (t = {:.6g} s). To make it longer: --set time.end=...",
                                 folder.path().string(), setup.state.time));
        return ExitCode::complete;
    }
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return Run(std::move(setup), folder, limit - elapsed, console, ranks).execute(errors);
}

}  // namespace scree::app
