#include "io/results/provenance.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <ctime>

#include "core/version.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

namespace {

// UUID, version 4 (RFC 4122), from the system's random numbers.
std::string make_uuid() {
    std::array<unsigned char, 16> bytes{};
    const std::string source = "/dev/urandom";
    const int file = ::open(source.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) throw_system_error(source, "cannot be opened", errno);
    const ssize_t n = ::read(file, bytes.data(), bytes.size());
    ::close(file);
    if (n != static_cast<ssize_t>(bytes.size())) throw_system_error(source, "cannot be read", n < 0 ? errno : EIO);
    bytes[6] = static_cast<unsigned char>((bytes[6] & 0x0fU) | 0x40U);
    bytes[8] = static_cast<unsigned char>((bytes[8] & 0x3fU) | 0x80U);
    constexpr char kHex[] = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += kHex[bytes[i] >> 4];
        text += kHex[bytes[i] & 0x0fU];
    }
    return text;
}

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

struct TextField {
    const char* name;
    std::string Provenance::*member;
};
constexpr const char* kGroup = "provenance";
// The short ones: attributes of the group, and lines for a reader.
constexpr TextField kShort[] = {{"creator", &Provenance::creator},
                                {"git_revision", &Provenance::git_revision},
                                {"build_type", &Provenance::build_type},
                                {"compiler", &Provenance::compiler},
                                {"flags", &Provenance::flags},
                                {"hdf5_version", &Provenance::hdf5_version},
                                {"eigen_version", &Provenance::eigen_version},
                                {"yaml_cpp_version", &Provenance::yaml_cpp_version},
                                {"mpi_version", &Provenance::mpi_version},
                                {"cgal_version", &Provenance::cgal_version},
                                {"scenario_name", &Provenance::scenario_name},
                                {"command_line", &Provenance::command_line},
                                {"hostname", &Provenance::hostname},
                                {"slurm_job_id", &Provenance::slurm_job_id},
                                {"created_utc", &Provenance::created_utc},
                                {"run_id", &Provenance::run_id}};

}  // namespace

Provenance make_provenance(const RunDescription& run) {
    Provenance p;
    p.creator = std::string("scree ") + version::kVersion;
    p.git_revision = version::kGitRevision;
    p.git_dirty = version::kGitDirty;
    p.build_type = version::kBuildType;
    p.compiler = version::kCompiler;
    p.flags = version::kFlags;
    p.hdf5_version = version::kHdf5;
    p.eigen_version = version::kEigen;
    p.yaml_cpp_version = version::kYamlCpp;
    p.mpi_version = version::kMpi;
    p.cgal_version = version::kCgal;
    p.scenario_name = run.scenario_name;
    p.scenario_text = run.scenario_text;
    p.scenario_resolved = run.scenario_resolved;
    p.command_line = run.command_line;
    p.hostname = host_name();
    p.slurm_job_id = environment("SLURM_JOB_ID");
    p.ranks = run.ranks;
    p.seed = run.seed;
    p.created_utc = utc_now();
    p.run_id = make_uuid();
    return p;
}

void continue_run(Provenance& now, const Provenance& earlier) {
    now.restart_of = earlier.restart_of;
    now.restart_of.push_back(earlier.run_id);
}

std::vector<std::pair<std::string, std::string>> provenance_lines(const Provenance& p) {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const TextField& field : kShort) {
        const std::string& value = p.*field.member;
        if (!value.empty()) lines.emplace_back(field.name, value);
        if (field.member == &Provenance::git_revision) lines.emplace_back("git_dirty", p.git_dirty ? "true" : "false");
    }
    lines.emplace_back("ranks", std::to_string(p.ranks));
    lines.emplace_back("seed", std::to_string(p.seed));
    for (const std::string& id : p.restart_of) lines.emplace_back("restart_of", id);
    return lines;
}

void write_provenance(const Hdf5Group& root, const Provenance& p) {
    if (root.has(kGroup)) root.remove(kGroup);
    const Hdf5Group group = root.group(kGroup);
    for (const TextField& field : kShort) group.attribute(field.name, p.*field.member);
    group.attribute("git_dirty", std::uint64_t{p.git_dirty ? 1U : 0U});
    group.attribute("ranks", static_cast<std::uint64_t>(p.ranks));
    group.attribute("seed", p.seed);
    write_text(group, "scenario_text", p.scenario_text, "the scenario as it was read");
    write_text(group, "scenario_resolved", p.scenario_resolved, "the scenario with every default and override");
    write_texts(group, "restart_of", p.restart_of, "run_id of the earlier parts of a resumed run, oldest first");
}

Provenance read_provenance(const Hdf5Group& root) {
    const Hdf5Group group = root.existing_group(kGroup);
    Provenance p;
    for (const TextField& field : kShort) {
        // files from before there were polyhedra have no word of CGAL
        if (field.member == &Provenance::cgal_version && !group.has_attribute(field.name)) continue;
        p.*field.member = group.text_attribute(field.name);
    }
    p.git_dirty = group.integer_attribute("git_dirty") != 0;
    p.ranks = static_cast<int>(group.integer_attribute("ranks"));
    p.seed = group.integer_attribute("seed");
    p.scenario_text = read_text(group, "scenario_text");
    p.scenario_resolved = read_text(group, "scenario_resolved");
    p.restart_of = read_texts(group, "restart_of");
    return p;
}

}  // namespace scree::io
