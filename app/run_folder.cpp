#include "app/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/errors.hpp"

namespace scree::app {
namespace fs = std::filesystem;
namespace {

// Everything that a run leaves in its folder.
constexpr std::array<const char*, 9> kRunFiles = {"snapshots",       "checkpoint",   "history.h5",
                                                  "trajectories.h5", "rasters",      "run.xdmf",
                                                  "run.jsonl",       "summary.yaml", "stop_now"};

}  // namespace

RunFolder::~RunFolder() {
    if (lock_ >= 0) close(lock_);  // which unlocks it
}

bool RunFolder::holds_a_run() const {
    std::error_code ignored;
    for (const char* name : kRunFiles) {
        const fs::path file = path_ / name;
        if (fs::is_directory(file, ignored) ? !fs::is_empty(file, ignored) : fs::exists(file, ignored)) return true;
    }
    return false;
}

bool RunFolder::exists() const {
    std::error_code ignored;
    return fs::is_directory(path_, ignored);
}

void RunFolder::check_free(bool replace) const {
    if (replace || !holds_a_run()) return;
    throw IoError(
        fmt::format("the folder '{}' holds a run already, and nothing of it was touched.\n"
                    "  To go on with that run: --resume. To replace it: --force. To keep both: --out ANOTHER_FOLDER.",
                    path_.string()));
}

void RunFolder::start(bool replace) {
    check_free(replace);
    std::error_code fault;
    fs::create_directories(path_, fault);
    if (fault || !exists()) {
        throw IoError(fmt::format("cannot make the folder '{}': {}", path_.string(),
                                  fault ? fault.message() : "a file of that name is there"));
    }
    check_writable();
    lock();
    if (replace) clear();
}

void RunFolder::resume() {
    check_writable();
    lock();
}

void RunFolder::check_writable() const {
    if (access(path_.c_str(), W_OK | X_OK) != 0) {
        throw IoError(fmt::format("cannot write to the folder '{}': {}", path_.string(), std::strerror(errno)));
    }
}

void RunFolder::lock() {
    if (lock_ >= 0) return;
    lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) throw IoError(fmt::format("cannot open the folder '{}': {}", path_.string(), std::strerror(errno)));
    // File systems without locks (some network ones) say something else than EWOULDBLOCK: go on without.
    if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(lock_);
        lock_ = -1;
        throw IoError(fmt::format("another scree is writing to the folder '{}' at this moment", path_.string()));
    }
}

void RunFolder::clear() const {
    for (const char* name : kRunFiles) {
        std::error_code fault;
        fs::remove_all(path_ / name, fault);
        if (fault) throw IoError(fmt::format("cannot remove '{}': {}", (path_ / name).string(), fault.message()));
    }
}

fs::path default_run_folder(const fs::path& scenario) {
    return fs::path("out") / scenario.stem();
}

}  // namespace scree::app
