// Rows of all ranks, one rank's after another's, brought to ranks in whole chunks: a chunk goes to the rank that has
// its first row. A rank sends less than a chunk and gets what is missing in its last one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

class WholeChunks {
  public:
    // Collective. `begin`: of this rank's rows among all. If all ranks begin at a chunk, nothing is copied and `rows`
    // must stay.
    WholeChunks(const Rows& rows, std::uint64_t begin, std::size_t chunk_rows, const Communicator& ranks);

    const Rows& rows() const { return rows_; }
    std::uint64_t first_chunk() const { return first_chunk_; }

  private:
    Rows rows_;
    std::uint64_t first_chunk_;
    std::vector<std::byte> copy_;
};

}  // namespace scree::io
