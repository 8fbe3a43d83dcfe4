// 64-bit checksums: each word is mixed in by a bijection, so that any one changed word changes the value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

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
    friend class RowsChecksum;
    std::uint64_t value_ = 0;
};

// Of rows that many ranks hold: a checksum of each row with its name and number, added modulo 2^64. The values of the
// ranks are to be added too; the sum does not depend on who holds which rows.
class RowsChecksum {
  public:
    // `first`: number of the first of these rows in the whole.
    void add(std::string_view name, std::uint64_t first, const void* data, std::size_t rows, std::size_t row_bytes) {
        Checksum of_name;
        of_name.add(name.data(), name.size());
        const char* row = static_cast<const char*>(data);
        for (std::size_t i = 0; i < rows; ++i, row += row_bytes) {
            Checksum of_row;
            of_row.value_ = of_name.value() + first + i;
            of_row.add(row, row_bytes);
            sum_ += of_row.value();
        }
    }
    // The number of rows of the whole, once.
    void add_total(std::string_view name, std::uint64_t total) {
        add(name, ~std::uint64_t{0}, &total, 1, sizeof(total));
    }
    std::uint64_t value() const { return sum_; }

  private:
    std::uint64_t sum_ = 0;
};

}  // namespace scree::io
