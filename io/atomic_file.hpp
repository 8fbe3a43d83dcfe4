// Files that are either whole or not there: written under another name in the same folder, brought to the disk,
// renamed. A program that is killed, or a disk that is full, leaves the earlier file as it was.
#pragma once

#include <string>
#include <string_view>

#include "core/parallel/communicator.hpp"

namespace scree::io {

// Usage: write to `temporary()` by any means, then `commit()`. Without commit() the temporary file is removed.
// A file of all ranks is renamed and removed by rank 0; commit() is then collective.
class AtomicFile {
  public:
    explicit AtomicFile(std::string path, const Communicator& ranks = Communicator::self());
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::string& temporary() const { return temporary_; }
    // fsync of the file, rename, fsync of the folder. Throws IoError.
    void commit();

  private:
    void commit_here();

    std::string path_, temporary_;
    Communicator ranks_;
    bool committed_ = false;
};

void write_text_atomically(const std::string& path, std::string_view text);
void copy_file(const std::string& from, const std::string& to);
std::string read_text(const std::string& path);
// Makes the folder and its parents; IoError with the path and the system's reason if that cannot be.
void make_folder(const std::string& path);
// Removes what AtomicFile left in a folder when the program was killed.
void remove_leftovers(const std::string& folder);
// "path: what: the system's reason", from `error_number` (an errno).
[[noreturn]] void throw_system_error(const std::string& path, const std::string& what, int error_number);

}  // namespace scree::io
