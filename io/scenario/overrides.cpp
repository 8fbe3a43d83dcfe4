#include "io/scenario/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "io/text_file.hpp"

namespace scree::io {
namespace {

struct Part {
    std::string name;       // of a key; empty: an index
    std::size_t index = 0;  // from 0
    bool append = false;
    int column = 0;
};

class Override {
  public:
    Override(const std::string& text, Diagnostics& diagnostics)
        : text_(text), name_(override_name(text)), diagnostics_(diagnostics) {}

    void apply(YamlValue& tree) {
        const auto equals = text_.find('=');
        if (equals == std::string::npos) {
            return error(text_.size() + 1, "expected KEY=VALUE, as in time.step=5e-4; there is no '='");
        }
        const auto parts = parse_path(equals);
        if (!parts) return;
        if (parts->front().name == "include")
            return error(1, "'include' cannot be set here; name the file in the scenario");
        // Blanks in place of the path keep the columns of the value's faults right.
        auto value = parse_yaml(std::string(equals + 1, ' ') + text_.substr(equals + 1), name_, diagnostics_);
        if (!value) return;
        if (value->kind == YamlValue::Kind::null) value->mark = mark(equals + 2);
        YamlValue changed = tree;  // so that a path that fails half way leaves nothing behind
        if (YamlValue* target = walk(changed, *parts)) {
            *target = std::move(*value);
            tree = std::move(changed);
        }
    }

  private:
    Mark mark(std::size_t column) const { return {name_, 1, static_cast<int>(column)}; }
    void error(std::size_t column, const std::string& message) { diagnostics_.error(mark(column), message); }

    std::optional<std::vector<Part>> parse_path(std::size_t end) {
        std::vector<Part> parts;
        std::size_t i = 0;
        bool want_name = true;
        while (i < end || want_name) {
            const std::size_t column = i + 1;
            if (want_name) {
                const std::size_t stop = std::min(text_.find_first_of(".[]=", i), end);
                if (stop == i) return error(column, "expected the name of a key"), std::nullopt;
                parts.push_back({text_.substr(i, stop - i), 0, false, static_cast<int>(column)});
                i = stop;
                want_name = false;
            } else if (text_[i] == '.') {
                want_name = true;
                ++i;
            } else {
                const auto part = parse_index(i, end);
                if (!part) return std::nullopt;
                parts.push_back(*part);
            }
        }
        return parts;
    }

    std::optional<Part> parse_index(std::size_t& i, std::size_t end) {
        const std::size_t close = text_.find(']', i);
        Part part;
        part.column = static_cast<int>(i + 1);
        if (text_[i] == '[' && close != std::string::npos && close < end) {
            const std::string inner = text_.substr(i + 1, close - i - 1);
            part.append = inner == "+";
            const auto read = std::from_chars(inner.data(), inner.data() + inner.size(), part.index);
            const bool whole = read.ec == std::errc() && read.ptr == inner.data() + inner.size();
            if (part.append || whole) {
                i = close + 1;
                return part;
            }
        }
        error(i + 1, "expected '.name', '[number]' (from 0) or '[+]'");
        return std::nullopt;
    }

    // The value at the path; makes what is missing.
    YamlValue* walk(YamlValue& tree, const std::vector<Part>& parts) {
        YamlValue* value = &tree;
        std::string path;
        for (const Part& part : parts) {
            value = part.name.empty() ? item(*value, part, path) : key(*value, part, path);
            if (value == nullptr) return nullptr;
            if (part.name.empty()) {
                path += part.append ? "[+]" : fmt::format("[{}]", part.index);
            } else {
                path += (path.empty() ? "" : ".") + part.name;
            }
        }
        return value;
    }

    YamlValue* key(YamlValue& value, const Part& part, const std::string& path) {
        if (value.kind == YamlValue::Kind::null) value.kind = YamlValue::Kind::map;
        if (value.kind != YamlValue::Kind::map) {
            const bool list = value.kind == YamlValue::Kind::list;
            error(static_cast<std::size_t>(part.column),
                  list ? fmt::format("{} is a list: expected [number] after it, as in {}[0].{}", path, path, part.name)
                       : fmt::format("{} is a value, it has no keys", path));
            return nullptr;
        }
        if (YamlEntry* entry = value.find(part.name)) return &entry->value;
        const Mark here = mark(static_cast<std::size_t>(part.column));
        value.entries.push_back({part.name, here, {}});
        value.entries.back().value.mark = here;
        return &value.entries.back().value;
    }

    YamlValue* item(YamlValue& value, const Part& part, const std::string& path) {
        const auto column = static_cast<std::size_t>(part.column);
        if (value.kind == YamlValue::Kind::null && part.append) value.kind = YamlValue::Kind::list;
        if (value.kind == YamlValue::Kind::null) {
            error(column, fmt::format("{} is not given in the scenario, so it has no items; use [+] to append", path));
            return nullptr;
        }
        if (value.kind != YamlValue::Kind::list) {
            error(column, fmt::format("{} is not a list", path));
            return nullptr;
        }
        if (part.append) {
            value.items.emplace_back().mark = mark(column);
            return &value.items.back();
        }
        if (part.index >= value.items.size()) {
            error(column, fmt::format("{} has {} items, counted from 0; use [+] to append", path, value.items.size()));
            return nullptr;
        }
        return &value.items[part.index];
    }

    std::string text_, name_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::string override_name(const std::string& text) {
    return "--set " + text;
}

void apply_override(const std::string& text, YamlValue& tree, Diagnostics& diagnostics) {
    diagnostics.add_source(override_name(text), text);
    if (!check_text(text, override_name(text), diagnostics)) return;
    Override(text, diagnostics).apply(tree);
}

}  // namespace scree::io
