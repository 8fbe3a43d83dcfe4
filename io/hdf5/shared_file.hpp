// One HDF5 file that all ranks write, each its own rows, to the same contents as one rank would write. Rank 0 makes the
// structure (file_driver.hpp); rows go to the file from the rank that has them, compressed there. All ranks must
// see one file system alike (a parallel one, or a disk of the one machine they are on).
//
// A fault on a rank is kept, and the ranks go on together until close(), which throws it as IoError on all of them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/parallel/together.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

class SharedFile {
  public:
    // Collective. An old file of this name is replaced.
    SharedFile(std::string path, std::size_t user_block, const Communicator& ranks);
    ~SharedFile();
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    // What is small and equal on all ranks, by rank 0 alone.
    void by_root(const std::function<void(const Hdf5Group& root)>& write);

    // Collective. The rows of all ranks one after another. Compressed ones go to the file in whole chunks: those of a
    // chunk that began on an earlier rank are sent there first.
    struct Extent {
        std::uint64_t begin = 0;  // of this rank's rows
        std::uint64_t total = 0;
    };
    Extent rows(const std::string& name, const Rows& rows, const Meaning& meaning, const Layout& layout = {});

    // Collective. Brings all to the operating system.
    void close();

    const Communicator& ranks() const { return ranks_; }

  private:
    void plain_rows(const std::string& name, const Rows& rows, const Extent& extent, const Meaning& meaning);
    void packed_rows(const std::string& name, const Rows& rows, const Extent& extent, const Meaning& meaning,
                     const Layout& layout);
    void write_at(std::uint64_t place, const void* data, std::size_t bytes);

    std::string path_;
    Communicator ranks_;
    std::string fault_;             // of this rank; empty if all is well
    std::optional<Hdf5File> file_;  // on rank 0
    int descriptor_ = -1;           // for this rank's rows; none if alone
};

}  // namespace scree::io
