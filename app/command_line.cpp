// Parsing, dispatch, and the one place where exceptions become messages and exit codes.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

#include "app/commands.hpp"
#include "app/help_text.hpp"
#include "app/human_text.hpp"
#include "io/scenario/diagnostics.hpp"

namespace scree::app {
namespace {

// What is typed, in a form that a shell would read again.
std::string quoted(const std::string& word) {
    static constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string text;
    for (const char c : word) {
        if (c == '\'') {
            text.append("'\\''");
        } else {
            text.push_back(c);
        }
    }
    return fmt::format("'{}'", text);
}

struct Arguments {
    CLI::App app{"", "scree"};
    RunOptions run;
    CheckOptions check;
    std::string walltime, info_path, compare_a, compare_b, explain_key;
    double tolerance = 0.0;
    bool quiet = false, verbose = false, reference = false;

    CLI::App* add(const std::string& name, const std::string& description) {
        CLI::App* sub = app.add_subcommand(name, description);
        sub->footer(std::string(subcommand_footer(name)) + "\n");
        sub->set_help_flag("-h,--help", "shows this text");
        return sub;
    }
    void define();
    void define_run();
};

// One value an occurrence, so that a scenario may follow.
void add_set_option(CLI::App* sub, std::vector<std::string>& sets) {
    sub->add_option("--set", sets,
                    "changes a key of the scenario: --set time.step=1e-4 --set walls[0].radius=2; repeatable")
        ->option_text("KEY=VALUE")
        ->allow_extra_args(false)
        ->take_all();
}

void Arguments::define_run() {
    CLI::App* sub = add("run", "Computes a scenario and writes its results to a folder.");
    sub->add_option("scenario", run.scenario, "the scenario, a YAML file; with --resume it may be left out")
        ->option_text("SCENARIO");
    sub->add_option("-o,--out", run.out, "folder of the results; out/<name of the scenario> if left out")
        ->option_text("DIR");
    add_set_option(sub, run.sets);
    sub->add_flag("--resume", run.resume, "goes on from the newest checkpoint in the folder; starts if there is none");
    sub->add_flag("--force", run.force, "replaces the run that the folder holds");
    sub->add_option("--walltime", walltime, "stops in time with a checkpoint: 23:50:00, 1-12:00:00 or seconds")
        ->option_text("HH:MM:SS");
    sub->add_flag("-q,--quiet", quiet, "warnings and errors only");
    sub->add_flag("-v,--verbose", verbose, "says more: the plan, each file that is written");
}

void Arguments::define() {
    app.set_help_flag();
    define_run();

    CLI::App* sub = add("check", "Reads a scenario, says what it holds and what it would cost. Writes nothing.");
    sub->add_option("scenario", check.scenario, "the scenario, a YAML file")->required()->option_text("SCENARIO");
    add_set_option(sub, check.sets);

    sub = add("info", "Says what a file or folder of results is.");
    sub->add_option("file", info_path, "a snapshot, checkpoint, history, summary or run folder")
        ->required()
        ->option_text("FILE");

    sub = add("compare", "Compares two results number by number: two files, or two run folders.");
    sub->add_option("a", compare_a, "")->required()->option_text("A");
    sub->add_option("b", compare_b, "")->required()->option_text("B");
    sub->add_option("--tolerance", tolerance,
                    "largest difference allowed, relative to the largest value (0: same bits)")
        ->check(CLI::NonNegativeNumber)
        ->option_text("X");

    sub = add("explain", "Explains a key of scenarios: meaning, unit, range, default.");
    sub->add_option("key", explain_key, "such as solver.tolerance; without it, the list of all keys")
        ->option_text("KEY");

    sub = add("schema", "Prints the JSON Schema of scenarios.");
    sub->add_flag("--reference", reference, "the reference page, in Markdown, instead");
}

int usage_error(const std::string& message, const std::string& help) {
    write_all(STDERR_FILENO, fmt::format("error: {}\n  {} shows what is possible.\n", message, help));
    return static_cast<int>(ExitCode::usage);
}

// Faults that CLI11 describes poorly.
std::optional<int> refuse(Arguments& arguments) {
    RunOptions& run = arguments.run;
    const auto no = [](const std::string& message) { return usage_error(message, "scree run --help"); };
    if (!arguments.app.got_subcommand("run")) return std::nullopt;
    if (run.scenario.empty() && !run.resume) return no("which scenario? (scree run SCENARIO)");
    if (run.scenario.empty() && run.out.empty()) return no("which run is to go on? (scree run --resume --out DIR)");
    if (run.resume && run.force) return no("--resume goes on with a run and --force replaces it: one of them, please");
    if (arguments.quiet && arguments.verbose) return no("--quiet and --verbose contradict each other");
    if (!arguments.walltime.empty()) {
        run.walltime = parse_clock(arguments.walltime);
        if (!run.walltime) {
            return no(fmt::format("--walltime {}: this is no time; expected HH:MM:SS, D-HH:MM:SS or seconds",
                                  arguments.walltime));
        }
    }
    if (arguments.quiet) run.loudness = Loudness::quiet;
    if (arguments.verbose) run.loudness = Loudness::verbose;
    return std::nullopt;
}

int dispatch(Arguments& arguments) {
    CLI::App& app = arguments.app;
    const auto code = [](ExitCode c) { return static_cast<int>(c); };
    if (app.got_subcommand("run")) return code(run_command(arguments.run));
    if (app.got_subcommand("check")) return code(check_command(arguments.check));
    if (app.got_subcommand("info")) return code(info_command(arguments.info_path));
    if (app.got_subcommand("compare")) {
        return compare_command(arguments.compare_a, arguments.compare_b, arguments.tolerance);
    }
    if (app.got_subcommand("explain")) return code(explain_command(arguments.explain_key));
    return code(schema_command(arguments.reference));
}

int parse_and_dispatch(int argc, char** argv) {
    const std::string first = argc > 1 ? argv[1] : "";
    if (first.empty() || first == "-h" || first == "--help" || first == "help") {
        if (!first.empty()) {
            fmt::print("{}", top_help());
            return static_cast<int>(ExitCode::complete);
        }
        write_all(STDERR_FILENO, top_help());
        return static_cast<int>(ExitCode::usage);
    }
    if (first == "--version" || first == "-V") {
        fmt::print("{}", version_text());
        return static_cast<int>(ExitCode::complete);
    }
    Arguments arguments;
    arguments.define();
    const auto& names = subcommand_names();
    if (std::find(names.begin(), names.end(), first) == names.end()) {
        const std::string nearest = io::nearest_name(first, names);
        return usage_error(fmt::format("'{}' is no command of scree{}", first,
                                       nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest)),
                           "scree --help");
    }
    try {
        arguments.app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", arguments.app.get_subcommand(first)->help("scree"));
        return static_cast<int>(ExitCode::complete);
    } catch (const CLI::ParseError& error) {
        return usage_error(error.what(), fmt::format("scree {} --help", first));
    }
    if (const auto refused = refuse(arguments)) return *refused;
    arguments.run.command_line = "scree";
    for (int i = 1; i < argc; ++i) arguments.run.command_line += " " + quoted(argv[i]);
    return dispatch(arguments);
}

int report(const std::string& message, ExitCode code) {
    std::fflush(stdout);
    // A scenario's report brings its own "file:line:col: error:".
    write_all(STDERR_FILENO, fmt::format("{}{}{}", code == ExitCode::invalid_scenario ? "" : "error: ", message,
                                         message.empty() || message.back() != '\n' ? "\n" : ""));
    return static_cast<int>(code);
}

}  // namespace

int run_command_line(int argc, char** argv) {
    // Beyond a limit on file sizes, write() must fail with a message instead of killing the program.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        int code = parse_and_dispatch(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            throw IoError("standard output could not be written");
        }
        return code;
    } catch (const Error& error) {
        return report(error.what(), error.code());
    } catch (const std::bad_alloc&) {
        return report("there is not enough memory. 'scree check SCENARIO' estimates what a scenario needs.",
                      ExitCode::internal);
    } catch (const std::system_error& error) {
        return report(error.what(), ExitCode::input_output);
    } catch (const std::exception& error) {
        return report(fmt::format("{}\nThis is a fault in Scree. Please report it with the scenario.", error.what()),
                      ExitCode::internal);
    }
}

}  // namespace scree::app
