#include "app/help_text.hpp"

#include <fmt/format.h>
#include <CLI/Version.hpp>

#include "core/version.hpp"

namespace scree::app {

std::string_view top_help() {
    return R"(Scree computes how grains flow: every grain is a rigid body, every contact obeys non-penetration, Coulomb friction
and restitution (Nonsmooth Contact Dynamics, the method of Moreau and Jean). No stiffness, no damping constants.

usage: scree COMMAND ...

commands
  run       computes a scenario and writes its results to a folder; --resume goes on with a run
  check     reads a scenario, says what it holds and what it would cost; computes and writes nothing
  info      says what a file or folder of results is
  compare   compares two results number by number
  explain   explains a key of scenarios: meaning, unit, range, default
  schema    prints the JSON Schema of scenarios (for editors), or their reference page
  scree COMMAND --help shows the options of a command and examples.
  On many cores: mpirun -n 64 scree run SCENARIO. The results are the same, to the bit, on any number of ranks.

a first scenario: save it as first.yaml, then   scree run first.yaml
  scenario_version: 1
  time: {end: 1 s, step: 1 ms}
  materials:
    glass: {density: 2.5 g/cm3, friction: 0.4, restitution: 0.2}
  bodies:
    - {generator: lattice, material: glass, corner: [-0.02, -0.02, 0.02], pitch: 6 mm, cells: [7, 7, 20],
       jitter: 0.2 mm, size: {distribution: uniform, lower: 4 mm, upper: 5 mm}}
  walls:
    - {name: floor, shape: plane, point: [0, 0, 0], normal: [0, 0, 1], material: glass}
  output: {snapshot_interval: 50 ms, history_interval: 5 ms}
Numbers are SI, or carry a unit. 'scree explain bodies' lists the ways of making bodies, 'scree explain walls' the walls.

exit codes
  0  complete                                    5   the physics failed (a state that no step can go on from)
  1  compare: the results differ                 70  a fault of Scree, or not enough memory
  2  wrong usage of the command line             75  stopped early with a checkpoint: run again with --resume
  3  the scenario is wrong; nothing is written
  4  a file could not be read or written; earlier files are whole

scree --version tells the version, the compiler and the libraries.
)";
}

std::string_view subcommand_footer(std::string_view subcommand) {
    if (subcommand == "run") {
        return R"(A run can be stopped at any time: Ctrl-C, SIGTERM, SIGUSR1, a file stop_now in its folder, --walltime or the
end of a Slurm job make it write a checkpoint and exit with 75. If it is killed outright, at most the time since the last
checkpoint is lost (output.checkpoint_interval, 10 min of wall time). --resume goes on to the same bits.

On many cores: mpirun -n N scree run ..., one rank a core. The results are the same bits for any N, and a run may go on with
another N. Signals may be sent to mpirun (SIGUSR1: it passes that one on and waits), and mpirun ends with scree's exit code.

examples
  scree run silo.yaml                                  results in out/silo
  scree run silo.yaml --out s2 --set seed=2 --set time.step=5e-4
  scree run --resume --out s2                          goes on from the newest checkpoint of s2
  scree run --resume --out s2 --set time.end=3         longer than planned (time.end and output.* may change)
  scree run silo.yaml --resume --walltime 23:50:00     in a batch script: starts or goes on; 75 means run me again
  mpirun -n 64 scree run silo.yaml                     on 64 ranks; tools/slurm has batch scripts)";
    }
    if (subcommand == "check") {
        return R"(examples
  scree check silo.yaml
  scree check silo.yaml --set time.step=5e-4
  scree check silo.yaml --ranks 64)";
    }
    if (subcommand == "info") {
        return R"(examples
  scree info out/silo                       a whole run
  scree info out/silo/snapshots/000012.h5   one file)";
    }
    if (subcommand == "compare") {
        return R"(Exit code 0: equal (within the tolerance); 1: they differ.

examples
  scree compare out/a out/b                                   two runs, bit by bit
  scree compare a/snapshots/000010.h5 b/snapshots/000010.h5 --tolerance 1e-9)";
    }
    if (subcommand == "explain") {
        return R"(examples
  scree explain solver.tolerance
  scree explain walls          the kinds of walls and their keys
  scree explain walls.cone)";
    }
    if (subcommand == "schema") {
        return R"(examples
  scree schema > scree.schema.json      then, as the first line of a scenario:
                                        # yaml-language-server: $schema=scree.schema.json
  scree schema --reference > reference.md)";
    }
    return "";
}

std::string version_text() {
    return fmt::format(
        "scree {} (revision {}{})\n"
        "  built with {}, {}, {}\n"
        "  libraries: HDF5 {}, Eigen {}, yaml-cpp {}, fmt {}.{}.{}, CLI11 {}, MPI {}\n",
        version::kVersion, version::kGitRevision, version::kGitDirty ? ", modified" : "", version::kCompiler,
        version::kBuildType, version::kFlags, version::kHdf5, version::kEigen, version::kYamlCpp, FMT_VERSION / 10000,
        FMT_VERSION / 100 % 100, FMT_VERSION % 100, CLI11_VERSION, version::kMpi);
}

const std::vector<std::string>& subcommand_names() {
    static const std::vector<std::string> names = {"run", "check", "info", "compare", "explain", "schema"};
    return names;
}

}  // namespace scree::app
