// Rows as HDF5 stores them in a compressed dataset: whole chunks, made in memory by HDF5 itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

struct PackedChunk {
    std::uint32_t filters_left_out = 0;  // HDF5's filter mask: a chunk that compression would not make smaller
    std::vector<std::byte> bytes;
};

// The chunks of `rows`, which begin at a chunk of the dataset; the last one is filled up. `chunk_rows`: rows of each.
std::vector<PackedChunk> pack_rows(const Rows& rows, std::size_t chunk_rows, const Layout& layout,
                                   const std::string& file);

}  // namespace scree::io
