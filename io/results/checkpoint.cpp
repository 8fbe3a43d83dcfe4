#include "io/results/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/sealed_file.hpp"
#include "io/results/state_archive.hpp"

namespace scree::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "scree checkpoint";
constexpr std::string_view kPrefix = "step_", kSuffix = ".h5";
constexpr std::size_t kKept = 2;

struct Numbered {
    std::uint64_t step;
    std::string path;
};

// Newest first.
std::vector<Numbered> numbered(const std::string& folder) {
    std::vector<Numbered> found;
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) continue;
        if (name.size() <= kPrefix.size() + kSuffix.size()) continue;
        const std::string digits = name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size());
        if (digits.size() > 19 || digits.find_first_not_of("0123456789") != std::string::npos) continue;
        found.push_back({std::stoull(digits), entry.path().string()});
    }
    std::sort(found.begin(), found.end(), [](const Numbered& a, const Numbered& b) { return a.step > b.step; });
    return found;
}

// Keeps the two newest up to `step`. Newer ones belong to a part of the run that was given up (they could not be read,
// or an earlier run had the same folder): to continue from one of them would be wrong.
void remove_old(const std::string& folder, std::uint64_t step) {
    std::size_t kept = 0;
    for (const Numbered& file : numbered(folder)) {
        if (file.step <= step && kept++ < kKept) continue;
        std::error_code code;
        fs::remove(file.path, code);
    }
}

}  // namespace

std::string write_checkpoint(const std::string& folder, const State& state, const Provenance& provenance) {
    make_folder(folder);
    const std::string path = folder + "/" + fmt::format("{}{:010}{}", kPrefix, state.step, kSuffix);
    AtomicFile out(path);
    Hdf5File file = Hdf5File::create(out.temporary(), kSealBytes);
    write_format(file.root(), kFormat);
    file.root().attribute("time", state.time);
    file.root().attribute("step", state.step);
    write_provenance(file.root(), provenance);
    file.root().attribute("checksum", write_state(file.root(), state));
    file.close();
    seal(out.temporary());
    out.commit();
    remove_old(folder, state.step);
    return path;
}

State read_checkpoint(const std::string& path, Provenance* provenance) {
    check_seal(path);
    const Hdf5File file = Hdf5File::open(path);
    check_format(file.root(), kFormat);
    State state;
    const std::uint64_t checksum = read_state(file.root(), state);
    if (checksum != file.root().integer_attribute("checksum")) {
        throw IoError(path + ": this checkpoint is damaged: its checksum does not fit its numbers");
    }
    if (provenance != nullptr) *provenance = read_provenance(file.root());
    return state;
}

std::optional<FoundCheckpoint> find_latest_checkpoint(const std::string& folder) {
    FoundCheckpoint found;
    for (const Numbered& file : numbered(folder)) {
        try {
            found.state = read_checkpoint(file.path, &found.provenance);
            found.path = file.path;
            return found;
        } catch (const IoError& error) {
            found.messages.emplace_back(error.what());
        }
    }
    if (found.messages.empty()) return std::nullopt;
    std::string all = folder + ": no checkpoint here can be read:";
    for (const std::string& message : found.messages) all += "\n  " + message;
    throw IoError(all);
}

std::vector<std::string> list_checkpoints(const std::string& folder) {
    std::vector<std::string> paths;
    for (const Numbered& file : numbered(folder)) paths.push_back(file.path);
    return paths;
}

}  // namespace scree::io
