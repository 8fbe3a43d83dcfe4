// run.xdmf: tells ParaView (its "XDMF Reader") what is in the snapshots. XDMF 2: a temporal collection of spatial
// collections, each with the grid `spheres` (one vertex a body, the fields as point attributes). With polyhedra it is
// called `centres`, and beside it stand their surfaces, `polyhedra`: one polygon a face, the fields of the bodies as
// cell attributes (looked up by ParaView, not stored). Polyhedral cells, one a body, would be shorter, but
// ParaView 5.11 reads them by its Xdmf3 readers only, which do not read what is looked up. Paths are relative to the
// file.
#pragma once

#include <string>
#include <vector>

namespace scree::io {

class XdmfSeries {
  public:
    explicit XdmfSeries(std::string path) : path_(std::move(path)) {}

    // Adds a snapshot that is on disk; `relative` is its path as seen from run.xdmf.
    void add(const std::string& snapshot, const std::string& relative);
    // Rewrites the file, atomically.
    void write() const;

  private:
    std::string path_;
    std::vector<std::string> grids_;  // the XML of each time
};

}  // namespace scree::io
