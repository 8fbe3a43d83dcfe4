#include "io/results/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "core/parallel/sorted_slices.hpp"
#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/hdf5/shared_file.hpp"
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

// Rank 0's list, on all ranks.
std::vector<std::string> agreed_list(const std::string& folder, const Communicator& ranks) {
    std::string names;
    if (ranks.root()) {
        for (const Numbered& file : numbered(folder)) names += fs::path(file.path).filename().string() + '\n';
    }
    ranks.broadcast(names);
    std::vector<std::string> paths;
    for (std::size_t at = 0; at < names.size(); at = names.find('\n', at) + 1) {
        paths.push_back(folder + "/" + names.substr(at, names.find('\n', at) - at));
    }
    return paths;
}

void write_file(const std::string& path, const State& state, const Bodies& bodies, const WarmStart& warm_start,
                const Provenance& provenance, const Communicator& ranks) {
    SharedFile file(path, kSealBytes, ranks);
    file.by_root([&](const Hdf5Group& root) {
        write_format(root, kFormat);
        root.attribute("time", state.time);
        root.attribute("step", state.step);
        write_provenance(root, provenance);
    });
    const std::uint64_t checksum = write_state(file, state, bodies, warm_start);
    file.by_root([&](const Hdf5Group& root) { root.attribute("checksum", checksum); });
    file.close();
}

}  // namespace

std::string write_checkpoint(const std::string& folder, const State& state, const Provenance& provenance,
                             const Communicator& ranks) {
    by_root(ranks, [&] { make_folder(folder); });
    const std::string path = folder + "/" + fmt::format("{}{:010}{}", kPrefix, state.step, kSuffix);
    AtomicFile out(path, ranks);
    if (ranks.alone()) {
        write_file(out.temporary(), state, state.bodies, state.warm_start, provenance, ranks);
    } else {
        const BodySlice slice = slice_bodies(state.bodies, 1, ranks);
        write_file(out.temporary(), state, slice.bodies, slice_warm_start(state.warm_start, ranks), provenance, ranks);
    }
    seal(out.temporary(), ranks);
    out.commit();
    if (ranks.root()) remove_old(folder, state.step);
    return path;
}

State read_checkpoint(const std::string& path, Provenance* provenance, const Communicator& ranks) {
    check_seal(path, ranks);
    State state;
    std::uint64_t checksum = 0, expected = 0;
    together(ranks, [&] {
        const Hdf5File file = Hdf5File::open(path);
        check_format(file.root(), kFormat);
        checksum = read_state(file.root(), state, ranks);
        expected = file.root().integer_attribute("checksum");
        if (provenance != nullptr) *provenance = read_provenance(file.root());
    });
    if (ranks.sum(checksum) != expected) {
        throw IoError(path + ": this checkpoint is damaged: its checksum does not fit its numbers");
    }
    return state;
}

std::optional<FoundCheckpoint> find_latest_checkpoint(const std::string& folder, const Communicator& ranks) {
    FoundCheckpoint found;
    for (const std::string& path : agreed_list(folder, ranks)) {
        try {
            found.state = read_checkpoint(path, &found.provenance, ranks);
            found.path = path;
            return found;
        } catch (const IoError& error) {  // on all ranks
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
