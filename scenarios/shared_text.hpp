// A text file in pieces of whole lines, for all ranks: rank 0 reads it, the others are told.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "core/parallel/communicator.hpp"

namespace scree::scenarios {

class SharedText {
  public:
    SharedText(const std::string& path, const Communicator& ranks);

    // The same answers on all ranks.
    bool is_file() const { return is_file_; }
    std::uint64_t size() const { return size_; }  // [bytes]
    // The next piece; empty at the end.
    std::string next();
    bool failed() const { return failed_; }  // the file could not be read to its end

  private:
    std::string read();

    const Communicator& ranks_;
    std::ifstream stream_;
    std::string rest_;  // the beginning of a line
    bool is_file_ = false, failed_ = false;
    std::uint64_t size_ = 0;
};

}  // namespace scree::scenarios
