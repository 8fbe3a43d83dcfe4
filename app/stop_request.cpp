#include "app/stop_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <system_error>

#include "app/human_text.hpp"

namespace scree::app {
namespace {

constexpr std::array<int, 4> kSignals = {SIGUSR1, SIGTERM, SIGINT, SIGHUP};
constexpr double kLookInterval = 0.5;  // [s]

volatile std::sig_atomic_t received = 0;
std::array<struct sigaction, kSignals.size()> earlier_actions;

extern "C" void note_signal(int signal) {
    if (signal == SIGINT && received == SIGINT) {  // pressed twice: the default action, at once
        std::signal(SIGINT, SIG_DFL);
        std::raise(SIGINT);
        return;
    }
    received = signal;
}

StopCause cause_of(std::sig_atomic_t signal) {
    switch (signal) {
        case 0:
            return StopCause::none;
        case SIGUSR1:
            return StopCause::user_signal;
        case SIGTERM:
            return StopCause::terminate;
        case SIGINT:
            return StopCause::interrupt;
        default:
            return StopCause::hangup;
    }
}

double seconds_since(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace

StopRequest::StopRequest(std::filesystem::path stop_file, double wall_limit, bool root)
    : stop_file_(std::move(stop_file)),
      wall_limit_(wall_limit),
      root_(root),
      start_(std::chrono::steady_clock::now()),
      last_look_(start_ - std::chrono::seconds(1)) {
    received = 0;
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        sigaction(kSignals[i], nullptr, &earlier_actions[i]);
        // What the caller made us ignore (nohup, a background job of a script) stays ignored.
        if (earlier_actions[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
    }
}

StopRequest::~StopRequest() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &earlier_actions[i], nullptr);
}

bool StopRequest::file_found() {
    if (seconds_since(last_look_) < kLookInterval) return false;
    last_look_ = std::chrono::steady_clock::now();
    std::error_code ignored;
    return std::filesystem::remove(stop_file_, ignored);
}

StopCause StopRequest::cause(double reserve) {
    const StopCause signal = cause_of(received);
    if (signal != StopCause::none || !root_) return signal;
    if (file_found()) return StopCause::file;
    const double margin = 2.0 * reserve + std::min(10.0, 0.02 * wall_limit_);
    return seconds_since(start_) > wall_limit_ - margin ? StopCause::wall_time : StopCause::none;
}

std::string StopRequest::reason(StopCause cause) const {
    switch (cause) {
        case StopCause::none:
            return "";
        case StopCause::file:
            return fmt::format("the file {} was there", stop_file_.string());
        case StopCause::wall_time:
            return fmt::format("the wall-time limit of {} is near", duration_text(wall_limit_));
        case StopCause::hangup:
            return "signal SIGHUP";
        case StopCause::interrupt:
            return "interrupted (SIGINT)";
        case StopCause::terminate:
            return "signal SIGTERM";
        case StopCause::user_signal:
            return "signal SIGUSR1";
    }
    return "";
}

double wall_limit(std::optional<double> walltime) {
    double limit = walltime.value_or(std::numeric_limits<double>::infinity());
    if (const char* text = std::getenv("SLURM_JOB_END_TIME")) {
        char* end = nullptr;
        const double job_end = std::strtod(text, &end);
        if (end != text && *end == '\0') {
            limit = std::min(limit, std::max(0.0, job_end - static_cast<double>(std::time(nullptr))));
        }
    }
    return limit;
}

}  // namespace scree::app
