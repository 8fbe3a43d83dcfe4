// Parsing, dispatch, and the one place where exceptions become messages and exit codes.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

#include "app/commands.hpp"
#include "app/error_agreement.hpp"
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
    sub->add_option("--ranks", check.ranks, "shows what each of N ranks would get: bodies, contacts, border, memory")
        ->check(CLI::Range(1, 1000000))
        ->option_text("N");

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

// What the arguments alone decide: a help text, or an error. All ranks find the same, and one says it.
struct Answer {
    ExitCode code = ExitCode::complete;
    std::string text;
};

Answer usage_error(const std::string& message, const std::string& help) {
    return {ExitCode::usage, fmt::format("error: {}\n  {} shows what is possible.\n", message, help)};
}

// Faults that CLI11 describes poorly.
std::optional<Answer> refuse(Arguments& arguments) {
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

void flush_output() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw IoError("standard output could not be written");
}

int dispatch(Arguments& arguments) {
    CLI::App& app = arguments.app;
    const auto code = [](ExitCode c) { return static_cast<int>(c); };
    if (app.got_subcommand("check")) return code(check_command(arguments.check));
    if (app.got_subcommand("info")) return code(info_command(arguments.info_path));
    if (app.got_subcommand("compare")) {
        return compare_command(arguments.compare_a, arguments.compare_b, arguments.tolerance);
    }
    if (app.got_subcommand("explain")) return code(explain_command(arguments.explain_key));
    return code(schema_command(arguments.reference));
}

std::optional<Answer> parse(int argc, char** argv, Arguments& arguments) {
    const std::string first = argc > 1 ? argv[1] : "";
    if (first.empty()) return Answer{ExitCode::usage, std::string(top_help())};
    if (first == "-h" || first == "--help" || first == "help")
        return Answer{ExitCode::complete, std::string(top_help())};
    if (first == "--version" || first == "-V") return Answer{ExitCode::complete, version_text()};
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
        return Answer{ExitCode::complete, arguments.app.get_subcommand(first)->help("scree")};
    } catch (const CLI::ParseError& error) {
        return usage_error(error.what(), fmt::format("scree {} --help", first));
    }
    arguments.run.command_line = "scree";
    for (int i = 1; i < argc; ++i) arguments.run.command_line += " " + quoted(argv[i]);
    return refuse(arguments);
}

// `run` works on all ranks; every other command on rank 0 alone.
int parse_and_dispatch(int argc, char** argv, const Communicator& ranks, ErrorAgreement& errors) {
    Arguments arguments;
    const std::optional<Answer> answer = parse(argc, argv, arguments);
    const bool speaks = ranks.root();
    if (answer) {
        if (speaks && answer->code == ExitCode::complete) fmt::print("{}", answer->text);
        if (speaks && answer->code != ExitCode::complete) write_all(STDERR_FILENO, answer->text);
        return static_cast<int>(answer->code);
    }
    if (arguments.app.got_subcommand("run")) return static_cast<int>(run_command(arguments.run, ranks, errors));
    int code = 0;
    at_root(ranks, [&] { code = dispatch(arguments); });
    return static_cast<int>(ranks.max(static_cast<std::uint64_t>(code)));
}

// The exit code, on all ranks the same; if the error is that of some ranks only, it ends all of them.
int report(const std::string& message, ExitCode code, const Communicator& ranks, ErrorAgreement& errors) {
    std::fflush(stdout);
    const auto say = [&](const std::string& who) {
        // A scenario's report brings its own "file:line:col: error:".
        write_all(STDERR_FILENO, fmt::format("{}{}{}{}", code == ExitCode::invalid_scenario ? "" : "error: ", who,
                                             message, message.empty() || message.back() != '\n' ? "\n" : ""));
    };
    const std::string who = fmt::format("rank {} of {}: ", ranks.rank(), ranks.size());
    if (!errors.everywhere()) {
        say(who);
        ranks.abort(static_cast<int>(code));
    }
    const ErrorAgreement::Ending ending = errors.agree(message, static_cast<int>(code));
    if (ending.shown) say(ranks.root() ? "" : who);
    return ending.code;
}

}  // namespace

int run_command_line(int argc, char** argv, const Communicator& ranks) {
    // Beyond a limit on file sizes, write() must fail with a message instead of killing the program.
    std::signal(SIGXFSZ, SIG_IGN);
    ErrorAgreement errors(ranks);
    const auto ended = [&](const std::string& message, ExitCode code) { return report(message, code, ranks, errors); };
    try {
        const int code = parse_and_dispatch(argc, argv, ranks, errors);
        at_root(ranks, flush_output);
        return code;
    } catch (const Error& error) {
        return ended(error.what(), error.code());
    } catch (const std::bad_alloc&) {
        return ended("there is not enough memory. 'scree check SCENARIO' estimates what a scenario needs.",
                     ExitCode::internal);
    } catch (const std::system_error& error) {
        return ended(error.what(), ExitCode::input_output);
    } catch (const std::exception& error) {
        return ended(fmt::format("{}\nThis is a fault in Scree. Please report it with the scenario.", error.what()),
                     ExitCode::internal);
    }
}

}  // namespace scree::app
