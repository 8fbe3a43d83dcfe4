#include "io/results/history.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

namespace {

constexpr const char* kFormat = "scree history";
constexpr const char* kGroup = "history";
constexpr double kShortestInterval = 5.0;  // [s] between flushes
constexpr double kCostFactor = 100.0;      // interval over the time that the last flush took
// Column names may be anything; a slash would make a group.
std::string dataset_name(const HistoryColumn& column) {
    std::string name = column.name;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

Rows rows_of_column(const HistoryColumn& column, const std::vector<double>& values) {
    Rows rows = rows_of(values);
    const auto width = static_cast<std::size_t>(column.width);
    rows.count = values.size() / width;
    if (width > 1) rows.shape = {width};
    return rows;
}

// Applies `change` to a copy of the file and puts the copy in its place.
template <class Change>
void change_copy(const std::string& path, const Change& change) {
    AtomicFile copy(path);
    copy_file(path, copy.temporary());
    Hdf5File file = Hdf5File::open_writable(copy.temporary());
    change(file.root());
    file.close();
    copy.commit();
}

// Times of the wall clock differ from run to run: compare leaves them out.
bool is_wall_clock(const HistoryColumn& column) {
    return column.name.starts_with("wall_");
}

std::string describe(const HistoryColumn& column) {
    return "'" + column.name + "' [" + column.unit + "] of width " + std::to_string(column.width);
}

}  // namespace

HistoryWriter::HistoryWriter(std::string path, std::vector<HistoryColumn> columns, const Communicator& ranks)
    : path_(std::move(path)), columns_(std::move(columns)), ranks_(ranks), pending_(columns_.size()) {
    for (const HistoryColumn& column : columns_) {
        SCREE_CHECK(column.width > 0);
        row_width_ += static_cast<std::size_t>(column.width);
    }
    next_flush_ = Clock::now() + std::chrono::seconds(static_cast<int>(kShortestInterval));
}

HistoryWriter HistoryWriter::create(const std::string& path, std::vector<HistoryColumn> columns,
                                    const Provenance& provenance, const Communicator& ranks) {
    HistoryWriter writer(path, std::move(columns), ranks);
    by_root(ranks, [&] { writer.create_file(provenance); });
    return writer;
}

void HistoryWriter::create_file(const Provenance& provenance) const {
    AtomicFile out(path_);
    Hdf5File file = Hdf5File::create(out.temporary());
    write_format(file.root(), kFormat);
    write_provenance(file.root(), provenance);
    const Hdf5Group group = file.root().group(kGroup);
    std::vector<std::string> names;
    for (const HistoryColumn& column : columns_) {
        // Not compressed: a chunk that grows when it is compressed again would leave a hole in the file at each flush.
        const std::string name = dataset_name(column);
        write_rows(group, name, rows_of_column(column, {}), {column.unit, column.description}, {.extendible = true});
        if (is_wall_clock(column)) mark_dataset(group, name, "wall_clock", "differs from run to run");
        names.push_back(name);
    }
    write_texts(file.root(), "columns", names, "the datasets of /history in their order");
    file.close();
    out.commit();
}

HistoryWriter HistoryWriter::resume(const std::string& path, std::vector<HistoryColumn> columns, std::uint64_t rows,
                                    const Provenance& provenance, const Communicator& ranks) {
    HistoryWriter writer(path, std::move(columns), ranks);
    by_root(ranks, [&] {
        writer.check_file(rows);
        change_copy(path, [&](const Hdf5Group& root) {
            write_provenance(root, provenance);
            const Hdf5Group group = root.existing_group(kGroup);
            for (const HistoryColumn& column : writer.columns_) cut_rows(group, dataset_name(column), rows);
        });
    });
    writer.rows_on_disk_ = rows;
    return writer;
}

// Throws if the file cannot be continued after `rows` rows.
void HistoryWriter::check_file(std::uint64_t rows) const {
    const Hdf5File file = Hdf5File::open(path_);
    check_format(file.root(), kFormat);
    const std::vector<std::string> names = read_texts(file.root(), "columns");
    const std::string refusal = path_ + ": this history cannot be continued: ";
    if (names.size() != columns_.size()) {
        throw IoError(refusal + "it has " + std::to_string(names.size()) + " columns, the scenario asks for " +
                      std::to_string(columns_.size()));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const HistoryColumn& column = columns_[i];
        const DatasetInfo found = file.root().existing_group(kGroup).dataset(names[i]);
        const int width = found.shape.size() > 1 ? static_cast<int>(found.shape[1]) : 1;
        const HistoryColumn there{names[i], found.unit, "", width};
        if (names[i] != dataset_name(column) || found.unit != column.unit || width != column.width) {
            throw IoError(refusal + "column " + std::to_string(i + 1) + " is " + describe(there) +
                          ", the scenario asks for " + describe(column));
        }
        if (found.shape.at(0) < rows) {
            throw IoError(refusal + "it has " + std::to_string(found.shape[0]) + " rows, the checkpoint needs " +
                          std::to_string(rows));
        }
    }
}

void HistoryWriter::append(const std::vector<double>& row) {
    SCREE_CHECK(row.size() == row_width_);
    ++rows_in_memory_;
    if (!ranks_.root()) return;
    auto number = row.begin();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const auto end = number + columns_[i].width;
        pending_[i].insert(pending_[i].end(), number, end);
        number = end;
    }
}

void HistoryWriter::flush_if_due() {
    if (!ranks_.root() || rows_in_memory_ == 0 || Clock::now() < next_flush_) return;
    if (ranks_.alone()) return flush_here();
    if (!fault_of([&] { flush_here(); }).empty()) next_flush_ = Clock::time_point::max();
}

void HistoryWriter::flush() {
    by_root(ranks_, [&] { flush_here(); });
    rows_on_disk_ += rows_in_memory_;
    rows_in_memory_ = 0;
}

void HistoryWriter::flush_here() {
    if (rows_in_memory_ == 0) return;
    const Clock::time_point start = Clock::now();
    change_copy(path_, [&](const Hdf5Group& root) {
        const Hdf5Group group = root.existing_group(kGroup);
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            append_rows(group, dataset_name(columns_[i]), rows_of_column(columns_[i], pending_[i]));
        }
    });
    for (std::vector<double>& values : pending_) values.clear();
    rows_on_disk_ += rows_in_memory_;
    rows_in_memory_ = 0;
    const Clock::time_point end = Clock::now();
    const double cost = std::chrono::duration<double>(end - start).count();
    const std::chrono::duration<double> interval(std::max(kShortestInterval, kCostFactor * cost));
    next_flush_ = end + std::chrono::duration_cast<Clock::duration>(interval);
}

History read_history(const std::string& path) {
    const Hdf5File file = Hdf5File::open(path);
    check_format(file.root(), kFormat);
    const Hdf5Group group = file.root().existing_group(kGroup);
    History history;
    for (const std::string& name : read_texts(file.root(), "columns")) {
        const DatasetInfo found = group.dataset(name);
        const int width = found.shape.size() > 1 ? static_cast<int>(found.shape[1]) : 1;
        history.columns.push_back({name, found.unit, found.description, width});
        history.values.push_back(read_numbers(group, name));
        history.rows = found.shape.at(0);
    }
    return history;
}

}  // namespace scree::io
