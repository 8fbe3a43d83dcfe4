// Where a result comes from: program, build, libraries, scenario, machine. In every HDF5 file (group /provenance), in
// summary.yaml and in the first record of run.jsonl.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scree::io {

class Hdf5Group;

struct Provenance {
    std::string creator;  // "scree 0.1.0"
    std::string git_revision;
    bool git_dirty = false;
    std::string build_type, compiler, flags;
    std::string hdf5_version, eigen_version, yaml_cpp_version, mpi_version, cgal_version;
    std::string scenario_name;      // the file's name as given
    std::string scenario_text;      // as read
    std::string scenario_resolved;  // with every default and override
    std::string command_line;
    std::string hostname;
    std::string slurm_job_id;  // empty outside Slurm
    int ranks = 1;
    std::uint64_t seed = 0;
    std::string created_utc;              // 2024-01-31T12:00:00Z: start of the run, or of this part of a resumed one
    std::string run_id;                   // UUID, version 4
    std::vector<std::string> restart_of;  // run_ids of the earlier parts of a resumed run, oldest first
};

// What only the caller knows.
struct RunDescription {
    std::string scenario_name, scenario_text, scenario_resolved, command_line;
    std::uint64_t seed = 0;
    int ranks = 1;
};

Provenance make_provenance(const RunDescription& run);
// `now` continues the run that wrote `earlier`: appends to restart_of.
void continue_run(Provenance& now, const Provenance& earlier);

// Name and value of all that is not long text, in a fixed order; what is unknown is left out. For info and summaries.
std::vector<std::pair<std::string, std::string>> provenance_lines(const Provenance& provenance);

void write_provenance(const Hdf5Group& root, const Provenance& provenance);
Provenance read_provenance(const Hdf5Group& root);

}  // namespace scree::io
