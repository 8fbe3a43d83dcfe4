// Three tiers: SCREE_ASSERT (builds with assertions), SCREE_CHECK (always; a bug in Scree), exceptions (the user's
// input, files, physics). Every exception carries the exit code that the command line ends with.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace scree {

enum class ExitCode : int {
    complete = 0,
    usage = 2,
    invalid_scenario = 3,
    input_output = 4,
    physics = 5,
    internal = 70,
    stopped_early = 75,  // with a checkpoint: run again with --resume
};

class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

// The scenario is wrong; `what()` is the whole report, one `file:line:col: error: ...` a fault.
struct ScenarioError : Error {
    explicit ScenarioError(const std::string& what) : Error(ExitCode::invalid_scenario, what) {}
};
// A file could not be read or written.
struct IoError : Error {
    explicit IoError(const std::string& what) : Error(ExitCode::input_output, what) {}
};
// A state that no step can go on from (non-finite numbers, bodies that left every bound).
struct PhysicsError : Error {
    explicit PhysicsError(const std::string& what) : Error(ExitCode::physics, what) {}
};
// A fault of Scree itself, caught by SCREE_CHECK.
struct InternalError : Error {
    explicit InternalError(const std::string& what) : Error(ExitCode::internal, what) {}
};

[[noreturn]] inline void check_failed(const char* expression, const char* file, int line) {
    throw InternalError(std::string(file) + ":" + std::to_string(line) + ": this should hold: " + expression +
                        "\nThis is a fault in Scree. Please report it with the scenario.");
}

}  // namespace scree

#define SCREE_CHECK(expression) \
    ((expression) ? static_cast<void>(0) : ::scree::check_failed(#expression, __FILE__, __LINE__))
#ifdef SCREE_ASSERTIONS
#define SCREE_ASSERT(expression) SCREE_CHECK(expression)
#else
#define SCREE_ASSERT(expression) static_cast<void>(0)
#endif
