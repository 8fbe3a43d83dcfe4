// When a run has to end early, with a checkpoint: a signal (SIGUSR1, SIGTERM, SIGINT, SIGHUP), a file `stop_now` in the
// run's folder, or a wall-time limit that is near. A second SIGINT ends the program at once. On many ranks signals may
// reach any of them; rank 0 alone looks for the file and at the clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

namespace scree::app {

// In the order in which they count where ranks noticed different ones.
enum class StopCause : std::uint64_t { none, file, wall_time, hangup, interrupt, terminate, user_signal };

class StopRequest {
  public:
    // Wall-clock seconds from now until the limit; infinite: none. `root`: looks for the file and at the clock.
    StopRequest(std::filesystem::path stop_file, double wall_limit, bool root = true);
    ~StopRequest();  // puts the earlier signal handlers back
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    // Why the run has to stop, if it has to. `reserve`: the time that ending needs (the longest checkpoint so far) [s].
    // Cheap: looks for the file at most every half second, and removes it when it is found.
    StopCause cause(double reserve);
    std::string reason(StopCause cause) const;

  private:
    bool file_found();

    std::filesystem::path stop_file_;
    double wall_limit_;
    bool root_;
    std::chrono::steady_clock::time_point start_, last_look_;
};

// The nearer of `walltime` (of --walltime) and the end of the Slurm job (SLURM_JOB_END_TIME, seconds since 1970), both
// in seconds from now.
double wall_limit(std::optional<double> walltime);

}  // namespace scree::app
