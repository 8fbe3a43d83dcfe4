#include "io/scenario/include.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "io/text_file.hpp"

namespace scree::io {
namespace {

namespace fs = std::filesystem;

// Two names of one file must be known as the same.
std::string identity(const std::string& path) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path, error);
    return error ? fs::path(path).lexically_normal().string() : canonical.string();
}

class Loader {
  public:
    explicit Loader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    std::optional<YamlValue> load(const std::string& path, const Mark& named_at) {
        const auto same = [&](const std::string& open) { return identity(open) == identity(path); };
        const auto open = std::find_if(chain_.begin(), chain_.end(), same);
        if (open != chain_.end()) {
            std::vector<std::string> circle(open, chain_.end());
            circle.push_back(path);
            diagnostics_.error(named_at, fmt::format("files include each other: {}", fmt::join(circle, " -> ")));
            return std::nullopt;
        }
        const auto text = read_text_file(path, named_at, diagnostics_);
        if (!text) return std::nullopt;
        return load_text(*text, path);
    }

    std::optional<YamlValue> load_text(const std::string& text, const std::string& path) {
        if (files_.empty()) main_text_ = text;
        files_.push_back(path);
        auto tree = parse_yaml(text, path, diagnostics_);
        if (!tree) return std::nullopt;
        if (tree->kind == YamlValue::Kind::null) {
            diagnostics_.error({path, 1, 1}, "the file is empty: expected the keys of a scenario");
            return std::nullopt;
        }
        if (tree->kind != YamlValue::Kind::map) {
            diagnostics_.error(tree->mark, "expected the keys of a scenario ('key: value')");
            return std::nullopt;
        }
        chain_.push_back(path);
        auto merged = merge_included(std::move(*tree), path);
        chain_.pop_back();
        return merged;
    }

    std::vector<std::string> take_files() { return std::move(files_); }
    std::string take_text() { return std::move(main_text_); }

  private:
    std::optional<YamlValue> merge_included(YamlValue tree, const std::string& path) {
        const auto position = std::find_if(tree.entries.begin(), tree.entries.end(),
                                           [](const YamlEntry& entry) { return entry.key == "include"; });
        if (position == tree.entries.end()) return tree;
        const YamlValue named = std::move(position->value);
        tree.entries.erase(position);

        YamlValue base;
        base.kind = YamlValue::Kind::map;
        bool whole = true;
        const std::vector<YamlValue> list = named.kind == YamlValue::Kind::list ? named.items : std::vector{named};
        for (const YamlValue& name : list) {
            if (name.kind != YamlValue::Kind::scalar || name.text.empty()) {
                diagnostics_.error(name.mark, "include: expected the name of a file, or a list of names");
                whole = false;
                continue;
            }
            const fs::path file = (fs::path(path).parent_path() / name.text).lexically_normal();
            auto included = load(file.string(), name.mark);
            if (included) merge_over(base, std::move(*included));
            whole = whole && included.has_value();
        }
        if (!whole) return std::nullopt;
        merge_over(base, std::move(tree));
        return base;
    }

    Diagnostics& diagnostics_;
    std::vector<std::string> files_, chain_;
    std::string main_text_;
};

}  // namespace

std::optional<Included> read_with_includes(const std::string& path, Diagnostics& diagnostics) {
    Loader loader(diagnostics);
    auto tree = loader.load(path, Mark{path, 0, 0});
    if (!tree) return std::nullopt;
    return Included{std::move(*tree), loader.take_files(), loader.take_text()};
}

std::optional<Included> read_text_with_includes(const std::string& text, const std::string& name,
                                                Diagnostics& diagnostics) {
    diagnostics.add_source(name, text);
    if (!check_text(text, name, diagnostics)) return std::nullopt;
    Loader loader(diagnostics);
    auto tree = loader.load_text(text, name);
    if (!tree) return std::nullopt;
    return Included{std::move(*tree), loader.take_files(), loader.take_text()};
}

}  // namespace scree::io
