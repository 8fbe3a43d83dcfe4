// history.h5: one dataset a column under /history, one row a history interval.
//
// An HDF5 file that is open for writing can be lost when the program is killed. So rows are held in memory, and a flush
// copies the file, appends to the copy and renames it over the old one: what is on disk is always whole. A flush that
// took c seconds is followed by none for max(5 s, 100 c), so that flushing takes less than 1 % of the wall time
// however long the history grows (a copy costs O(rows), and rows and the interval grow together: O(1) a row).
// Rows lost with a killed program are made again by the resumed one, because a checkpoint is written after a flush.
//
// On many ranks all call these functions, with the same rows; rank 0 keeps and writes them. create, resume and flush
// are collective and throw on all ranks or on none.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/measure.hpp"
#include "core/parallel/communicator.hpp"
#include "io/results/provenance.hpp"

namespace scree::io {

class HistoryWriter {
  public:
    // A new file with no rows.
    static HistoryWriter create(const std::string& path, std::vector<HistoryColumn> columns,
                                const Provenance& provenance, const Communicator& ranks = Communicator::self());
    // Continues a file: cuts it to `rows` rows (state.history_rows of the checkpoint). Throws IoError if it has fewer
    // rows or other columns.
    static HistoryWriter resume(const std::string& path, std::vector<HistoryColumn> columns, std::uint64_t rows,
                                const Provenance& provenance, const Communicator& ranks = Communicator::self());

    // `row`: the numbers of all columns one after another. Does not touch the disk.
    void append(const std::vector<double>& row);
    // Call each step: flushes when it is time to. On many ranks a failure is left to flush().
    void flush_if_due();
    // Call before each checkpoint and at the end.
    void flush();

    std::uint64_t rows() const { return rows_on_disk_ + rows_in_memory_; }

  private:
    using Clock = std::chrono::steady_clock;
    HistoryWriter(std::string path, std::vector<HistoryColumn> columns, const Communicator& ranks);
    void create_file(const Provenance& provenance) const;
    void check_file(std::uint64_t rows) const;
    void flush_here();

    std::string path_;
    std::vector<HistoryColumn> columns_;
    Communicator ranks_;
    std::size_t row_width_ = 0;
    std::vector<std::vector<double>> pending_;  // one a column
    std::uint64_t rows_on_disk_ = 0, rows_in_memory_ = 0;
    Clock::time_point next_flush_;
};

struct History {
    std::vector<HistoryColumn> columns;
    std::vector<std::vector<double>> values;  // one a column: rows x width
    std::uint64_t rows = 0;
};
History read_history(const std::string& path);

}  // namespace scree::io
