// The subcommands: what the command line gives them, and what they end with. One file each: command_<name>.cpp.
// They throw scree::Error for everything that goes wrong; command_line.cpp turns that into a message and an exit code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "core/errors.hpp"
#include "core/parallel/communicator.hpp"

namespace scree::app {

class ErrorAgreement;

struct RunOptions {
    std::string scenario;           // may be empty with resume
    std::string out;                // empty: out/<name of the scenario>
    std::vector<std::string> sets;  // "time.step=1e-4"
    bool resume = false;
    bool force = false;
    std::optional<double> walltime;  // [s]
    Loudness loudness = Loudness::normal;
    std::string command_line;  // as typed, for the provenance
};
// On all ranks together, with the same options and the same exit code. The other commands: on one.
ExitCode run_command(const RunOptions& options, const Communicator& ranks, ErrorAgreement& errors);

struct CheckOptions {
    std::string scenario;
    std::vector<std::string> sets;
    int ranks = 0;  // shows the shares of so many; 0: not asked for
};
ExitCode check_command(const CheckOptions& options);

ExitCode info_command(const std::string& path);
// 0: equal within the tolerance; 1: they differ.
int compare_command(const std::string& a, const std::string& b, double tolerance);
ExitCode explain_command(const std::string& key);
ExitCode schema_command(bool reference);

// The whole program: parses, runs, reports errors, and gives the exit code.
int run_command_line(int argc, char** argv, const Communicator& ranks);

}  // namespace scree::app
