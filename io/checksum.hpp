// A 64-bit checksum: each word is mixed in by a bijection, so that any one changed word changes the value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/random.hpp"

namespace scree::io {

class Checksum {
  public:
    // The length counts too: the same bytes in other pieces give another value.
    void add(const void* data, std::size_t bytes) {
        value_ = mix64(value_ ^ bytes);
        const char* next = static_cast<const char*>(data);
        while (bytes > 0) {
            std::uint64_t word = 0;
            const std::size_t n = std::min(bytes, sizeof(word));
            std::memcpy(&word, next, n);
            value_ = mix64(value_ ^ word);
            next += n;
            bytes -= n;
        }
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0;
};

}  // namespace scree::io
