#include "io/results/info.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/provenance.hpp"
#include "io/results/sealed_file.hpp"
#include "io/results/snapshot.hpp"

namespace scree::io {

namespace fs = std::filesystem;

namespace {

// "min .. max" of each component of a dataset.
std::string range(const Hdf5Group& root, const DatasetInfo& info) {
    const std::vector<double> values = read_numbers(root, info.name);
    std::size_t width = 1;
    for (std::size_t i = 1; i < info.shape.size(); ++i) width *= info.shape[i];
    if (values.empty()) return "empty";
    if (width > 4) width = values.size();  // matrices and profiles: one range of all
    std::string text;
    for (std::size_t k = 0; k < (width == values.size() ? 1 : width); ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        bool all_numbers = true;
        const std::size_t stride = width == values.size() ? 1 : width;
        for (std::size_t i = k; i < values.size(); i += stride) {
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
            all_numbers = all_numbers && !std::isnan(values[i]);
        }
        if (!text.empty()) text += ", ";
        low += 0.0, high += 0.0;  // no -0
        text += low == high ? fmt::format("{:.6g}", low) : fmt::format("{:.6g} .. {:.6g}", low, high);
        if (!all_numbers) text += " (and not a number)";
    }
    return text;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (std::size_t side : shape) text += (text.empty() ? "" : " x ") + std::to_string(side);
    return text.empty() ? "1" : text;
}

std::string dataset_lines(const Hdf5Group& root) {
    std::string text;
    for (const DatasetInfo& info : root.datasets()) {
        if (info.name.starts_with("provenance/") || info.name == "columns") continue;
        text += fmt::format("  {:<32} {:>12}  ", info.name, shape_text(info.shape));
        if (info.text) {
            const std::vector<std::string> texts = read_texts(root, info.name);
            for (std::size_t i = 0; i < std::min<std::size_t>(texts.size(), 8); ++i)
                text += (i > 0 ? ", " : "") + texts[i];
            if (texts.size() > 8) text += ", ...";
        } else {
            text += range(root, info);
            if (!info.unit.empty() && info.unit != "1") text += " " + info.unit;
        }
        text += "\n";
    }
    return text;
}

std::string file_info(const std::string& path) {
    if (has_seal(path)) check_seal(path);
    const Hdf5File file = Hdf5File::open(path);
    const Hdf5Group& root = file.root();
    const std::string format = root.has_attribute("format") ? root.text_attribute("format") : "";
    if (!format.starts_with("scree ")) throw IoError(path + ": this is not a file of Scree");
    check_format(root, format);
    std::string text = fmt::format("{}: {}\n", path, format);
    if (root.has_attribute("title")) text += "  title       " + root.text_attribute("title") + "\n";
    if (root.has_attribute("time")) text += fmt::format("  time        {} s\n", root.number_attribute("time"));
    if (root.has_attribute("step")) text += fmt::format("  step        {}\n", root.integer_attribute("step"));
    if (root.has("bodies/id")) text += fmt::format("  bodies      {}\n", root.dataset("bodies/id").shape.at(0));
    if (format == "scree checkpoint") {
        read_checkpoint(path);
        text += "  checksum    good\n";
    }
    text += "Contents (shape, smallest .. largest)\n" + dataset_lines(root) + "Made by\n";
    for (const auto& [name, value] : provenance_lines(read_provenance(root))) {
        text += fmt::format("  {:<18} {}\n", name, value);
    }
    return text;
}

std::string folder_info(const std::string& folder) {
    std::string text;
    const std::vector<std::string> snapshots = list_snapshots(folder);
    if (!snapshots.empty()) {
        const auto time = [](const std::string& path) { return Hdf5File::open(path).root().number_attribute("time"); };
        text += fmt::format("  snapshots   {}, from {} s to {} s\n", snapshots.size(), time(snapshots.front()),
                            time(snapshots.back()));
    }
    const std::string history = folder + "/history.h5";
    if (fs::exists(history)) {
        const Hdf5File file = Hdf5File::open(history);
        const std::vector<DatasetInfo> columns = file.root().existing_group("history").datasets();
        text += fmt::format("  history     {} columns, {} rows\n", columns.size(),
                            columns.empty() ? 0 : columns.front().shape.at(0));
    }
    const std::string trajectories = folder + "/trajectories.h5";
    if (fs::exists(trajectories)) {
        const Hdf5File file = Hdf5File::open(trajectories);
        std::size_t bodies = 0;
        for (const DatasetInfo& info : file.root().datasets()) bodies += info.name.ends_with(".position") ? 1 : 0;
        text += fmt::format("  trajectories of {} bodies, {} rows\n", bodies,
                            file.root().dataset("history/time").shape.at(0));
    }
    const std::string rasters = folder + "/rasters/rasters.h5";
    if (fs::exists(rasters)) {
        const DatasetInfo deposit = Hdf5File::open(rasters).root().dataset("rasters/deposit");
        text += fmt::format("  rasters     {} x {} cells\n", deposit.shape.at(1), deposit.shape.at(0));
    }
    for (const std::string& path : list_checkpoints(folder + "/checkpoint")) {
        text += "  checkpoint  " + fs::path(path).filename().string() + "\n";
    }
    const std::string summary = folder + "/summary.yaml";
    if (fs::exists(summary)) text += "Summary\n" + read_text(summary);
    if (text.empty()) throw IoError(folder + ": this folder holds no results of a run");
    return folder + ": a run of Scree\n" + text;
}

// A summary is readable as it is; only make sure that it is one.
std::string summary_info(const std::string& path) {
    const std::string text = read_text(path);
    try {
        const YAML::Node node = YAML::Load(text);
        if (node.IsMap() && node["state_hash"] && node["status"]) return text;
    } catch (const YAML::Exception&) {
        // falls through: not YAML, so not a summary
    }
    throw IoError(path + ": this is neither an HDF5 file of Scree nor a summary");
}

}  // namespace

std::string info(const std::string& path) {
    if (!fs::exists(path)) throw IoError(path + ": there is no such file or folder");
    if (fs::is_directory(path)) return folder_info(path);
    return fs::path(path).extension() == ".yaml" ? summary_info(path) : file_info(path);
}

}  // namespace scree::io
