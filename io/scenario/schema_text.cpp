// `explain` and the reference page.
#include "io/scenario/schema_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/errors.hpp"
#include "io/scenario/diagnostics.hpp"

namespace scree::io {
namespace {

// A key at one of the places where it can stand.
struct Entry {
    struct Part {
        enum class Kind { key, form, name } kind;
        std::string text;
    };
    std::vector<Part> parts;
    std::string path;  // as shown: "materials.NAME.density", "walls[plane].normal"
    const SchemaNode* node;
    bool is_shared_use;  // the key of a shared section, at one of its uses
};

class Entries {
  public:
    Entries() {
        for (const SchemaNode* key : schema_root().keys) add({}, "", *key, false);
        for (const SchemaNode* shared : shared_sections()) add({}, "", *shared, false);
    }
    std::vector<Entry> all;

  private:
    void add(std::vector<Entry::Part> parts, const std::string& parent, const SchemaNode& node, bool shared_use) {
        parts.push_back({Entry::Part::Kind::key, node.key});
        std::string path = parent.empty() ? node.key : parent + "." + node.key;
        all.push_back({parts, path, &node, shared_use});
        const bool inner = shared_use || !node.row->same_as.empty();
        if (node.row->kind == Kind::named) {
            parts.push_back({Entry::Part::Kind::name, "NAME"});
            path += ".NAME";
        }
        const std::string item = node.row->kind == Kind::list ? path + "[]" : path;
        for (const SchemaNode* key : node.keys) add(parts, item, *key, inner);
        for (const SchemaNode* form : node.variants) {
            auto form_parts = parts;
            form_parts.push_back({Entry::Part::Kind::form, form->key});
            const std::string form_path = fmt::format("{}[{}]", path, form->key);
            all.push_back({form_parts, form_path, form, inner});
            for (const SchemaNode* key : form->keys) add(form_parts, form_path, *key, inner);
        }
    }
};

const std::vector<Entry>& entries() {
    static const Entries the_entries;
    return the_entries.all;
}

// "walls[3].normal", "walls.plane.normal" -> walls, (plane,) normal: indices and empty brackets say nothing here.
std::vector<std::string> query_parts(std::string_view query) {
    std::vector<std::string> parts(1);
    for (const char c : query) {
        if (c == '.' || c == '[' || c == ']') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    std::erase_if(parts, [](const std::string& part) {
        return part.find_first_not_of("0123456789+*") == std::string::npos;  // empty parts too
    });
    return parts;
}

// Keys must agree; forms and chosen names may be left out of the query, any name will do.
bool agree(const std::vector<std::string>& query, std::size_t q, const std::vector<Entry::Part>& parts, std::size_t p) {
    if (p == parts.size()) return q == query.size();
    const Entry::Part& part = parts[p];
    const bool is_last = p + 1 == parts.size();
    if (part.kind != Entry::Part::Kind::key && !is_last && agree(query, q, parts, p + 1)) return true;
    if (q == query.size()) return false;
    const bool same = part.kind == Entry::Part::Kind::name || query[q] == part.text;
    return same && agree(query, q + 1, parts, p + 1);
}

std::vector<const Entry*> find_entries(std::string_view key) {
    const auto query = query_parts(key);
    std::vector<const Entry*> found;
    if (query.empty()) return found;
    for (const Entry& entry : entries()) {
        if (agree(query, 0, entry.parts, 0)) found.push_back(&entry);
    }
    if (!found.empty()) return found;
    for (const Entry& entry : entries()) {  // the last parts alone
        for (std::size_t p = 1; p < entry.parts.size() && !entry.is_shared_use; ++p) {
            if (!agree(query, 0, entry.parts, p)) continue;
            found.push_back(&entry);
            break;
        }
    }
    return found;
}

std::string wrapped(const std::string& text, std::size_t indent) {
    constexpr std::size_t width = 100;
    std::string result, line(indent, ' ');
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = std::min(text.find(' ', i), text.size());
        const std::string word = text.substr(i, end - i);
        if (line.size() > indent && line.size() + 1 + word.size() > width) {
            result += line + "\n";
            line.assign(indent, ' ');
        }
        line += (line.size() > indent ? " " : "") + word;
        i = end + 1;
    }
    return result + line + "\n";
}

bool has_own_keys(const SchemaNode& node) {
    return (!node.keys.empty() || !node.variants.empty()) && node.row->same_as.empty();
}

std::string default_words(const Row& row) {
    if (row.is_required) return "required";
    if (!row.standard.empty()) return row.kind == Kind::section ? "all its defaults" : row.standard;
    return row.when_absent;
}

std::string bare_unit(const Row& row) {
    const auto unit = si_unit(row.dimension);
    return unit.empty() ? "" : fmt::format("; a bare number is in {}", unit);
}

std::string describe_entry(const Entry& entry) {
    const Row& row = *entry.node->row;
    std::string text = entry.path + "\n";
    if (row.kind != Kind::variant) {
        const std::string shared = row.same_as.empty() ? "" : fmt::format("; see {}", row.same_as);
        text += wrapped(fmt::format("expected: {}{}{}", expectation(*entry.node), bare_unit(row), shared), 4);
        const std::string standard = default_words(row);
        if (row.is_required) {
            text += "    required\n";
        } else if (!standard.empty()) {
            text += wrapped(fmt::format("{}: {}", row.standard.empty() ? "if absent" : "default", standard), 4);
        }
    }
    return text + wrapped(row.doc, 4);
}

std::string unknown(std::string_view key) {
    std::vector<std::string> paths, last_parts;
    for (const Entry& entry : entries()) {
        paths.push_back(entry.path);
        last_parts.push_back(entry.parts.back().text);
    }
    std::string nearest = nearest_name(key, paths);
    if (nearest.empty()) nearest = nearest_name(key, last_parts);
    if (nearest.empty()) {
        const auto parts = query_parts(key);
        if (!parts.empty()) nearest = nearest_name(parts.back(), last_parts);
    }
    std::vector<std::string> sections;
    for (const SchemaNode* section : schema_root().keys) sections.push_back(section->key);
    return fmt::format("'{}' is no key of a scenario{}; its first keys are {}", key,
                       nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest), fmt::join(sections, ", "));
}

std::string cell(std::string text) {
    for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) text.insert(i, 1, '\\');
    return text;
}

std::string markdown_table(const std::vector<const SchemaNode*>& keys) {
    std::string text = "\n| key | expected | default | meaning |\n| --- | --- | --- | --- |\n";
    for (const SchemaNode* key : keys) {
        const Row& row = *key->row;
        std::string expected = row.same_as.empty() ? expectation(*key) : fmt::format("a {}", row.same_as);
        if (!row.only.empty()) expected += fmt::format(" ({})", fmt::join(row.only, ", "));
        if (row.same_as.empty() && has_own_keys(*key)) expected = fmt::format("see `{}` below", key->key);
        std::string standard = default_words(row);
        if (row.is_required) standard = "**required**";
        text += fmt::format("| `{}` | {} | {} | {} |\n", key->key, cell(expected), cell(standard), cell(row.doc));
    }
    return text;
}

std::string markdown_section(const SchemaNode& node, const std::string& path, const std::string& level) {
    std::string text = fmt::format("\n{} {}\n{}\n", level, path, node.row->doc);
    if (!node.keys.empty()) text += markdown_table(node.keys);
    for (const SchemaNode* key : node.keys) {
        if (has_own_keys(*key)) text += markdown_section(*key, path + "." + key->key, level + "#");
    }
    for (const SchemaNode* form : node.variants) {
        text += fmt::format("\n{}# `{}: {}`\n{}\n", level, node.variant_key, form->key, form->row->doc);
        text += markdown_table(form->keys);
        for (const SchemaNode* key : form->keys) {
            if (has_own_keys(*key)) {
                text += markdown_section(*key, fmt::format("{}[{}].{}", path, form->key, key->key), level + "##");
            }
        }
    }
    return text;
}

}  // namespace

std::string explain(std::string_view key) {
    const auto found = find_entries(key);
    if (found.empty()) throw Error(ExitCode::usage, unknown(key));
    std::string text;
    for (const Entry* top : found) {
        for (const Entry& entry : entries()) {
            const bool inside = entry.path.size() > top->path.size() &&
                                entry.path.compare(0, top->path.size(), top->path) == 0 &&
                                (entry.path[top->path.size()] == '.' || entry.path[top->path.size()] == '[');
            const bool shown = &entry == top || (inside && (!entry.is_shared_use || top->is_shared_use));
            if (shown) text += (text.empty() ? "" : "\n") + describe_entry(entry);
        }
    }
    return text;
}

std::string reference_markdown() {
    std::string text =
        "# The keys of a scenario\n\n"
        "Numbers are in SI units, or texts with a unit: `6 mm`, `2.65 g/cm3`, `30 deg`. Vectors are lists of three, "
        "directions need no unit length, items of lists count from 0. Every key that is not in these tables is an "
        "error.\n\n## The first level\n";
    text += markdown_table(schema_root().keys);
    for (const SchemaNode* key : schema_root().keys) {
        if (has_own_keys(*key)) text += markdown_section(*key, key->key, "##");
    }
    for (const SchemaNode* shared : shared_sections()) text += markdown_section(*shared, shared->key, "##");
    return text;
}

}  // namespace scree::io
