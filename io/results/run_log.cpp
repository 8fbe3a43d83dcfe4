#include "io/results/run_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>

#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"

namespace scree::io {

namespace {

using Json = nlohmann::ordered_json;

// The length of the whole lines at the start of a file.
off_t whole_lines(int file, const std::string& path) {
    struct stat info {};
    if (::fstat(file, &info) != 0) throw_system_error(path, "cannot be read", errno);
    off_t end = info.st_size;
    char last = '\0';
    while (end > 0) {
        if (::pread(file, &last, 1, end - 1) != 1) throw_system_error(path, "cannot be read", errno);
        if (last == '\n') break;
        --end;
    }
    return end;
}

}  // namespace

RunLog::RunLog(std::string path, bool continued, const Communicator& ranks) : path_(std::move(path)), ranks_(ranks) {
    by_root(ranks_, [&] { open(continued); });
}

void RunLog::open(bool continued) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | (continued ? 0 : O_TRUNC), 0666);
    if (file_ < 0) throw_system_error(path_, "cannot be opened", errno);
    if (continued && ::ftruncate(file_, whole_lines(file_, path_)) != 0) {
        throw_system_error(path_, "cannot be shortened", errno);
    }
}

RunLog::~RunLog() {
    if (file_ >= 0) ::close(file_);
}

void RunLog::line(const std::string& text) {
    const std::string whole = text + "\n";
    std::size_t done = 0;
    while (done < whole.size()) {
        const ssize_t n = ::write(file_, whole.data() + done, whole.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw_system_error(path_, "cannot be written", errno);
        done += static_cast<std::size_t>(n);
    }
}

void RunLog::provenance(const Provenance& p) {
    Json record = {{"kind", "provenance"}};
    for (const auto& [name, value] : provenance_lines(p)) {
        if (name != "restart_of") record[name] = value;
    }
    record["git_dirty"] = p.git_dirty;
    record["ranks"] = p.ranks;
    record["seed"] = p.seed;
    record["restart_of"] = p.restart_of;
    record["scenario_text"] = p.scenario_text;
    record["scenario_resolved"] = p.scenario_resolved;
    // Text that is not UTF-8 (a command line can be anything) is replaced, not refused.
    by_root(ranks_, [&] { line(record.dump(-1, ' ', false, Json::error_handler_t::replace)); });
}

void RunLog::progress(const Progress& p) {
    if (!ranks_.root()) return;
    Json phases = Json::object();
    for (std::size_t i = 0; i < kPhaseCount; ++i) phases[std::string(kPhaseNames[i])] = p.wall_by_phase[i];
    const Json record = {{"kind", "progress"},
                         {"time", p.time},
                         {"step", p.step},
                         {"bodies", p.bodies},
                         {"contacts", p.contacts},
                         {"sweeps", p.sweeps},
                         {"residual", p.residual},
                         {"penetration", p.penetration},
                         {"kinetic_energy", p.kinetic_energy},
                         {"mass", p.mass},
                         {"wall_time", p.wall_time},
                         {"wall_by_phase", phases}};
    line_or_fault(record.dump());
}

void RunLog::ranks(const RankLoads& loads) {
    if (ranks_.root()) line_or_fault(to_json(loads));
}

void RunLog::line_or_fault(const std::string& text) {
    if (ranks_.alone()) return line(text);
    const std::string fault = fault_of([&] { line(text); });
    if (fault_.empty()) fault_ = fault;
}

void RunLog::status(const std::string& status, const std::string& reason, double time, std::uint64_t step,
                    std::uint64_t state_hash) {
    const Json record = {{"kind", "status"}, {"status", status}, {"reason", reason},
                         {"time", time},     {"step", step},     {"state_hash", fmt::format("{:016x}", state_hash)}};
    by_root(ranks_, [&] {
        if (!fault_.empty()) throw IoError(fault_);
        line(record.dump(-1, ' ', false, Json::error_handler_t::replace));
    });
}

}  // namespace scree::io
