// A driver for files that many ranks write: HDF5 works on rank 0 alone, makes the structure of the file and says where
// the numbers go; every rank then writes its own numbers to their places by plain, checked writes. So each failure (a
// full disk on one rank) stays on the rank that meets it until all ranks agree on it. Not so with HDF5's own MPI
// driver: with Open MPI 4.1 a collective write to a full disk reports success, and a rank that fails to write
// metadata leaves the others waiting in a barrier.
//
// It is a plain driver of a POSIX file (as HDF5's "sec2") with two switches, for the calling process.
#pragma once

#include <cstdint>
#include <string>

namespace scree::io {

class Hdf5Id;

void use_placing_driver(const Hdf5Id& access, const std::string& file);

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

// While it lives, nothing is written and all writes succeed: to close a file that is given up. HDF5 keeps a file open
// that it cannot write, and fails again at the end of the program.
class WriteNothing {
  public:
    WriteNothing();
    ~WriteNothing();
    WriteNothing(const WriteNothing&) = delete;
    WriteNothing& operator=(const WriteNothing&) = delete;
};

}  // namespace scree::io
