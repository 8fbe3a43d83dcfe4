#include "io/results/compare.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "core/errors.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/sealed_file.hpp"
#include "io/results/snapshot.hpp"

namespace scree::io {

namespace fs = std::filesystem;

namespace {

// The numbers of a dataset: as doubles for differences, as 64 bits for identity.
struct Numbers {
    std::vector<double> value;
    std::vector<std::uint64_t> bits;
    std::size_t rows = 0, width = 1;
};

Numbers read(const Hdf5Group& root, const DatasetInfo& info) {
    Numbers n;
    n.rows = info.shape.empty() ? 1 : info.shape[0];
    for (std::size_t i = 1; i < info.shape.size(); ++i) n.width *= info.shape[i];
    n.value.resize(n.rows * n.width);
    n.bits.resize(n.rows * n.width);
    if (info.type == ElementType::f64 || info.type == ElementType::f32) {
        read_elements(root, info.name, ElementType::f64, n.value.data());
        std::transform(n.value.begin(), n.value.end(), n.bits.begin(),
                       [](double x) { return std::bit_cast<std::uint64_t>(x); });
        return n;
    }
    const bool is_signed = info.type == ElementType::i64 || info.type == ElementType::i32;
    read_elements(root, info.name, is_signed ? ElementType::i64 : ElementType::u64, n.bits.data());
    std::transform(n.bits.begin(), n.bits.end(), n.value.begin(), [&](std::uint64_t x) {
        return is_signed ? static_cast<double>(static_cast<std::int64_t>(x)) : static_cast<double>(x);
    });
    return n;
}

using RowPairs = std::vector<std::pair<std::size_t, std::size_t>>;

RowPairs same_rows(std::size_t count) {
    RowPairs pairs(count);
    for (std::size_t i = 0; i < count; ++i) pairs[i] = {i, i};
    return pairs;
}

// Adds the differences of matched rows to `d`.
void measure(const Numbers& a, const Numbers& b, const RowPairs& pairs, double tolerance, Difference& d) {
    double largest = 0.0;
    for (const auto& [i, j] : pairs) {
        for (std::size_t k = 0; k < a.width; ++k) {
            const std::size_t at = i * a.width + k, bt = j * b.width + k;
            const double x = a.value[at], y = b.value[bt];
            ++d.compared;
            if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
            if (std::isfinite(y)) largest = std::max(largest, std::abs(y));
            if (a.bits[at] == b.bits[bt]) continue;
            ++d.different;
            const double difference = x == y ? 0.0 : std::abs(x - y);
            d.max_absolute =
                std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(d.max_absolute, difference);
        }
    }
    d.max_relative = d.max_absolute == 0.0 ? 0.0 : largest > 0.0 ? d.max_absolute / largest : d.max_absolute;
    d.identical = d.different == 0;
    d.within = d.max_relative <= tolerance;
}

// Everything about one pair of files.
class FileComparison {
  public:
    FileComparison(const Hdf5Group& a, const Hdf5Group& b, std::string prefix, double tolerance, Comparison& out)
        : a_(a), b_(b), prefix_(std::move(prefix)), tolerance_(tolerance), out_(out) {}

    void run() {
        match_bodies();
        std::map<std::string, DatasetInfo> in_b;
        for (const DatasetInfo& info : b_.datasets()) in_b[info.name] = info;
        for (const DatasetInfo& info : a_.datasets()) {
            if (skipped(a_, info)) continue;
            const auto other = in_b.find(info.name);
            if (other == in_b.end()) {
                missing(info, "only in the first");
            } else if (info.text || other->second.text) {
                texts(info, other->second);
            } else {
                numbers(info, other->second);
            }
        }
        for (const auto& [name, info] : in_b) {
            if (!skipped(b_, info) && !a_.has(name)) missing(info, "only in the second");
        }
        attribute("time", "s");
        attribute("step", "1");
    }

  private:
    bool skipped(const Hdf5Group& root, const DatasetInfo& info) const {
        // What all snapshots of a folder link to is compared once.
        const bool linked = info.name.starts_with("shapes/") || info.name.starts_with("terrain/");
        if (linked && prefix_.starts_with("snapshots/")) return true;
        return info.name.starts_with("provenance/") || dataset_has_mark(root, info.name, "wall_clock");
    }

    void match_bodies() {
        if (!a_.has("bodies/id") || !b_.has("bodies/id")) return;
        const Numbers a = read(a_, a_.dataset("bodies/id")), b = read(b_, b_.dataset("bodies/id"));
        std::size_t i = 0, j = 0;
        out_.only_in_a.clear();
        out_.only_in_b.clear();
        while (i < a.rows || j < b.rows) {  // both are sorted
            if (j == b.rows || (i < a.rows && a.bits[i] < b.bits[j])) {
                out_.only_in_a.push_back(a.bits[i++]);
            } else if (i == a.rows || b.bits[j] < a.bits[i]) {
                out_.only_in_b.push_back(b.bits[j++]);
            } else {
                bodies_.emplace_back(i++, j++);
            }
        }
        bodies_in_a_ = a.rows;
        bodies_in_b_ = b.rows;
        if (out_.only_in_a.empty() && out_.only_in_b.empty()) return;
        out_.identical = out_.within = false;
        out_.notes.push_back(prefix_ + std::to_string(out_.only_in_a.size()) + " bodies only in the first, " +
                             std::to_string(out_.only_in_b.size()) + " only in the second");
    }

    Difference named(const DatasetInfo& info) const {
        Difference d;
        d.dataset = prefix_ + info.name;
        d.unit = info.unit;
        return d;
    }
    void add(const Difference& d) {
        out_.identical = out_.identical && d.identical;
        out_.within = out_.within && d.within;
        out_.differences.push_back(d);
    }
    void missing(const DatasetInfo& info, const char* note) {
        Difference d = named(info);
        d.identical = d.within = false;
        d.note = note;
        add(d);
    }
    void texts(const DatasetInfo& a, const DatasetInfo& b) {
        Difference d = named(a);
        d.identical = d.within = a.text && b.text && read_texts(a_, a.name) == read_texts(b_, b.name);
        if (!d.identical) d.note = "the texts differ";
        add(d);
    }
    void numbers(const DatasetInfo& info_a, const DatasetInfo& info_b) {
        Difference d = named(info_a);
        const Numbers a = read(a_, info_a), b = read(b_, info_b);
        if (a.width != b.width) {
            d.identical = d.within = false;
            d.note = "rows of another width";
            return add(d);
        }
        const bool of_bodies = info_a.name.starts_with("bodies/") && a.rows == bodies_in_a_ && b.rows == bodies_in_b_;
        measure(a, b, of_bodies ? bodies_ : same_rows(std::min(a.rows, b.rows)), tolerance_, d);
        if (a.rows != b.rows) {
            d.identical = d.within = false;
            d.note = std::to_string(a.rows) + " rows in the first, " + std::to_string(b.rows) + " in the second";
        }
        add(d);
    }
    void attribute(const char* name, const char* unit) {
        if (!a_.has_attribute(name) || !b_.has_attribute(name)) return;
        Difference d;
        d.dataset = prefix_ + name;
        d.unit = unit;
        const auto one = [](double x) { return Numbers{{x}, {std::bit_cast<std::uint64_t>(x)}, 1, 1}; };
        measure(one(a_.number_attribute(name)), one(b_.number_attribute(name)), same_rows(1), tolerance_, d);
        add(d);
    }

    const Hdf5Group& a_;
    const Hdf5Group& b_;
    std::string prefix_;
    double tolerance_;
    Comparison& out_;
    RowPairs bodies_;
    std::size_t bodies_in_a_ = 0, bodies_in_b_ = 0;
};

void compare_files(const std::string& a, const std::string& b, const std::string& prefix, double tolerance,
                   Comparison& out) {
    for (const std::string& path : {a, b}) {
        if (has_seal(path)) check_seal(path);
    }
    const Hdf5File file_a = Hdf5File::open(a), file_b = Hdf5File::open(b);
    const std::string format = file_a.root().has_attribute("format") ? file_a.root().text_attribute("format") : "";
    if (!format.starts_with("scree ")) throw IoError(a + ": this is not a file of Scree");
    check_format(file_b.root(), format);
    FileComparison(file_a.root(), file_b.root(), prefix, tolerance, out).run();
}

void only_one(Comparison& out, const std::string& what) {
    out.identical = out.within = false;
    out.notes.push_back(what);
}

void compare_folders(const std::string& a, const std::string& b, double tolerance, Comparison& out) {
    std::map<std::string, std::pair<std::string, std::string>> snapshots;
    for (const std::string& path : list_snapshots(a)) snapshots[fs::path(path).filename().string()].first = path;
    for (const std::string& path : list_snapshots(b)) snapshots[fs::path(path).filename().string()].second = path;
    std::size_t compared = 0;
    const auto pair = [&](const std::string& name, const std::string& in_a, const std::string& in_b) {
        if (in_a.empty() && in_b.empty()) return;
        if (in_a.empty() || in_b.empty()) {
            return only_one(out, name + ": only in the " + (in_b.empty() ? "first" : "second"));
        }
        compare_files(in_a, in_b, name + ": ", tolerance, out);
        ++compared;
    };
    const auto if_there = [](const std::string& path) { return fs::exists(path) ? path : std::string(); };
    for (const auto& [name, paths] : snapshots) pair("snapshots/" + name, paths.first, paths.second);
    for (const char* name :
         {"snapshots/shapes.h5", "snapshots/terrain.h5", "history.h5", "trajectories.h5", "rasters/rasters.h5"}) {
        pair(fs::path(name).filename().string(), if_there(a + "/" + name), if_there(b + "/" + name));
    }
    const std::vector<std::string> in_a = list_checkpoints(a + "/checkpoint"),
                                   in_b = list_checkpoints(b + "/checkpoint");
    pair("last checkpoint", in_a.empty() ? "" : in_a[0], in_b.empty() ? "" : in_b[0]);
    if (compared == 0 && out.notes.empty()) throw IoError(a + ", " + b + ": neither folder holds results of a run");
}

}  // namespace

Comparison compare(const std::string& a, const std::string& b, double tolerance) {
    Comparison out;
    for (const std::string& path : {a, b}) {
        if (!fs::exists(path)) throw IoError(path + ": there is no such file or folder");
    }
    if (fs::is_directory(a) != fs::is_directory(b)) throw IoError(a + ", " + b + ": one is a folder, the other a file");
    if (fs::is_directory(a)) {
        compare_folders(a, b, tolerance, out);
    } else {
        compare_files(a, b, "", tolerance, out);
    }
    return out;
}

}  // namespace scree::io
