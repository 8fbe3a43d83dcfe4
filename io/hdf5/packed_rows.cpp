#include "io/hdf5/packed_rows.hpp"

#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

namespace {

constexpr std::size_t kMemoryStep = std::size_t{1} << 20;  // by which the file in memory grows

Hdf5Id file_in_memory(const std::string& file, const std::string& what) {
    silence_hdf5();
    const Hdf5Id access = owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, file, what);
    require(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), file, what);
    require(H5Pset_fapl_core(access.get(), kMemoryStep, false), file, what);
    return owned(H5Fcreate("packed rows", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose, file, what);
}

}  // namespace

std::vector<PackedChunk> pack_rows(const Rows& rows, std::size_t chunk_rows, const Layout& layout,
                                   const std::string& file) {
    std::vector<PackedChunk> chunks((rows.count + chunk_rows - 1) / chunk_rows);
    if (chunks.empty()) return chunks;
    const std::string what = "numbers cannot be compressed";
    const Hdf5Id memory_file = file_in_memory(file, what);
    Rows whole = rows;
    whole.count = chunks.size() * chunk_rows;
    const std::vector<hsize_t> dims = dimensions(whole), some = dimensions(rows);
    std::vector<hsize_t> start(dims.size(), 0);
    std::vector<hsize_t> chunk = dims;
    chunk[0] = chunk_rows;
    const int rank = static_cast<int>(dims.size());
    const Hdf5Id creation = creation_list(whole, layout, file);
    require(H5Pset_chunk(creation.get(), rank, chunk.data()), file, what);
    const Hdf5Id space = owned(H5Screate_simple(rank, dims.data(), nullptr), H5Sclose, file, what);
    const Hdf5Id dataset = owned(H5Dcreate2(memory_file.get(), "rows", file_type(rows.type), space.get(), H5P_DEFAULT,
                                            creation.get(), H5P_DEFAULT),
                                 H5Dclose, file, what);
    const Hdf5Id memory = owned(H5Screate_simple(rank, some.data(), nullptr), H5Sclose, file, what);
    require(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, some.data(), nullptr), file, what);
    require(H5Dwrite(dataset.get(), memory_type(rows.type), memory.get(), space.get(), H5P_DEFAULT, rows.data), file,
            what);
    for (PackedChunk& packed : chunks) {
        hsize_t size = 0;
        require(H5Dget_chunk_storage_size(dataset.get(), start.data(), &size), file, what);
        packed.bytes.resize(size);
        require(H5Dread_chunk(dataset.get(), H5P_DEFAULT, start.data(), &packed.filters_left_out, packed.bytes.data()),
                file, what);
        start[0] += chunk_rows;
    }
    return chunks;
}

}  // namespace scree::io
