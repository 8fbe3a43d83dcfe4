// The driver by which HDF5 writes files: that of a POSIX file (as HDF5's own "sec2"), but for two things.
//
// It never tells HDF5 that a write failed; it keeps the reason and drops what comes after. HDF5 1.10 cannot close a
// file once a flush of it has failed, tries again at the end of the program (in MPI_Finalize too), and crashes there.
//
// On demand it drops numbers and says where they would have gone. So many ranks write one file: HDF5 works on rank 0
// alone and makes the structure; every rank writes its own numbers to their places by plain, checked writes. A failure
// (a full disk) stays on the rank that meets it until all ranks agree on it. Not so with HDF5's own MPI driver: with
// Open MPI 4.1 a collective write to a full disk reports success, and a rank that fails to write metadata leaves the
// others waiting in a barrier.
//
// A process writes one file at a time.
#pragma once

#include <cstdint>
#include <string>

namespace scree::io {

class Hdf5Id;

void use_file_driver(const Hdf5Id& access, const std::string& file);

// The errno of the first write that failed, of the file that is open for writing and of the one closed last; 0 if all
// is well.
int fault_of_open_file();
int fault_of_closed_file();

// While it lives, numbers (not metadata) that HDF5 writes go nowhere, but their place is kept.
class OnlyPlaces {
  public:
    OnlyPlaces();
    ~OnlyPlaces();
    OnlyPlaces(const OnlyPlaces&) = delete;
    OnlyPlaces& operator=(const OnlyPlaces&) = delete;
    // Bytes from the start of the file, of the last numbers written.
    std::uint64_t last() const;
};

}  // namespace scree::io
