// Snapshots: the bodies (and walls, and contacts if asked for) at one time, for pictures and analysis, from which
// nothing restarts. Layout of snapshots/NNNNNN.h5, every dataset with the attributes unit, description and frame:
//   /            format "scree snapshot", format_version, number, time [s], step, title, gravity [m/s2]
//   /bodies      id (n), position (n,3) absolute, radius (n); velocity, spin (n,3), mass, material (n),
//                orientation (n,4) as w,x,y,z: those that the scenario asks for and the run has. With polyhedra
//                always orientation and shape (n): row of the arrays one a shape in /shapes, -1 for a sphere
//   /shapes      with polyhedra: a link to shapes.h5 beside the snapshots (shapes_file.hpp); a vertex of body i is at
//                position[i] + orientation[i] . vertex
//   /terrain     with terrain: a link to terrain.h5 beside the snapshots (terrain_file.hpp)
//   /mesh        with polyhedra, if asked for: their surfaces (body_mesh.hpp)
//   /materials   name, density
//   /walls       name, shape, parameters (JSON, in the wall's own frame), material, rotation (w,3,3), translation
//                (w,3), present: a point of the wall is at  rotation . local + translation
//   /contacts    id_a, id_b (-1 - wall index for a wall), feature, point, normal (from b to a), gap, impulse, force
//                (mean over the step), both on a, status
//   /provenance  see provenance.hpp
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/contact_record.hpp"
#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/results/provenance.hpp"
#include "io/results/xdmf.hpp"

namespace scree::io {

// One file of all ranks, atomically; collective. Fields, contacts and compression as scene.output says. Ghosts are left
// out; `contacts` are this rank's, disjoint over ranks, in any order (in the file: in order of key).
void write_snapshot(const std::string& path, std::uint64_t number, const Scene& scene, const State& state,
                    const std::vector<ContactRecord>& contacts, const Provenance& provenance,
                    const Communicator& ranks = Communicator::self());

// The snapshots of a run folder, and run.xdmf that lists them (kept by rank 0). All functions are collective.
class SnapshotSeries {
  public:
    // `first_number` is 0, or state.snapshots_written of the checkpoint that the run continues from: the snapshots
    // before it are found in the folder and listed, the later ones will be written again.
    SnapshotSeries(std::string run_folder, std::uint64_t first_number,
                   const Communicator& ranks = Communicator::self());

    // Writes the snapshot with the number state.snapshots_written, rewrites run.xdmf, adds one to the number.
    void write(const Scene& scene, State& state, const std::vector<ContactRecord>& contacts,
               const Provenance& provenance);

    std::uint64_t files() const { return files_; }  // written by this object
    std::uint64_t bytes() const { return bytes_; }

  private:
    void list_again(std::uint64_t first_number);
    void write_constant(const Scene& scene, const State& state, const Provenance& provenance) const;

    std::string run_folder_;
    Communicator ranks_;
    XdmfSeries xdmf_;
    bool constant_written_ = false;
    std::uint64_t files_ = 0, bytes_ = 0;
};

// Paths of the snapshots in <run_folder>/snapshots, in order of number.
std::vector<std::string> list_snapshots(const std::string& run_folder);

}  // namespace scree::io
