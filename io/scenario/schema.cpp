#include "io/scenario/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>

#include "core/errors.hpp"

namespace scree::io {

std::string Range::text() const {
    if (lower == upper) return fmt::format("= {}", lower);
    if (bounded_below() && bounded_above()) {
        return above_lower ? fmt::format("> {} and <= {}", lower, upper) : fmt::format("{} to {}", lower, upper);
    }
    if (bounded_below()) return fmt::format("{} {}", above_lower ? ">" : ">=", lower);
    return bounded_above() ? fmt::format("<= {}", upper) : std::string();
}

Row Row::in(Range r) && {
    range = r;
    return std::move(*this);
}
Row Row::required() && {
    is_required = true;
    standard.clear();  // an absent list is an empty one, unless it is required
    return std::move(*this);
}
Row Row::standardly(std::string yaml) && {
    standard = std::move(yaml);
    return std::move(*this);
}
Row Row::or_else(std::string meaning) && {
    when_absent = std::move(meaning);
    return std::move(*this);
}
Row Row::nonzero() && {
    is_nonzero = true;
    return std::move(*this);
}
Row Row::unique() && {
    is_unique = true;
    return std::move(*this);
}
Row Row::naming_file() && {
    is_file = true;
    return std::move(*this);
}
Row Row::naming(std::string key) && {
    refers_to = std::move(key);
    return std::move(*this);
}
Row Row::picked_by(std::string key) && {
    variant_key = std::move(key);
    return std::move(*this);
}
Row Row::says(std::string sentence) && {
    doc = std::move(sentence);
    return std::move(*this);
}
Row Row::like(std::string shared, std::vector<std::string> forms) && {
    same_as = std::move(shared);
    only = std::move(forms);
    return std::move(*this);
}

namespace {

template <class List>
const SchemaNode* find(const List& nodes, std::string_view name) {
    const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const SchemaNode* n) { return n->key == name; });
    return found == nodes.end() ? nullptr : *found;
}

// Hangs rows under one another by their paths.
class Tree {
  public:
    Tree() {
        for (const Row& row : schema_rows()) add(row);
        for (const Rule& rule : schema_rules()) node_at(rule.where).rules.push_back(&rule);
        for (SchemaNode& node : nodes_) borrow(node);
    }
    const SchemaNode& root() const { return *by_path_.at(""); }
    const std::vector<const SchemaNode*>& shared() const { return shared_; }

  private:
    SchemaNode& node_at(const std::string& path) {
        const auto found = by_path_.find(path);
        if (found == by_path_.end()) throw InternalError(fmt::format("the schema table has no row for '{}'", path));
        return *found->second;
    }

    void add(const Row& row) {
        SchemaNode& node = nodes_.emplace_back();
        node.row = &row;
        node.variant_key = row.variant_key;
        if (!by_path_.emplace(row.path, &node).second) {
            throw InternalError(fmt::format("the schema table has two rows for '{}'", row.path));
        }
        if (row.kind == Kind::variant) {
            const auto bracket = row.path.rfind('[');
            node.key = row.path.substr(bracket + 1, row.path.size() - bracket - 2);
            node_at(row.path.substr(0, bracket)).variants.push_back(&node);
            return;
        }
        const auto dot = row.path.rfind('.');
        node.key = dot == std::string::npos ? row.path : row.path.substr(dot + 1);
        if (dot == std::string::npos) {
            const bool is_shared = std::isupper(static_cast<unsigned char>(row.path.front())) != 0;
            (is_shared ? shared_ : by_path_.at("")->keys).push_back(&node);
            return;
        }
        std::string parent = row.path.substr(0, dot);
        for (const std::string_view each : {"[]", ".*"}) {
            if (parent.size() > 2 && parent.compare(parent.size() - 2, 2, each) == 0) parent.resize(parent.size() - 2);
        }
        node_at(parent).keys.push_back(&node);
    }

    // Takes the keys and forms of the shared section that the row names.
    void borrow(SchemaNode& node) {
        if (node.row == nullptr || node.row->same_as.empty()) return;
        const SchemaNode& shared = node_at(node.row->same_as);
        const auto& only = node.row->only;
        node.keys = shared.keys;
        node.rules = shared.rules;
        node.variant_key = shared.variant_key;
        for (const SchemaNode* form : shared.variants) {
            if (only.empty() || std::find(only.begin(), only.end(), form->key) != only.end())
                node.variants.push_back(form);
        }
    }

    std::deque<SchemaNode> nodes_{SchemaNode{}};
    std::map<std::string, SchemaNode*> by_path_{{"", &nodes_.front()}};
    std::vector<const SchemaNode*> shared_;
};

const Tree& tree() {
    static const Tree the_tree;
    return the_tree;
}

}  // namespace

const SchemaNode* SchemaNode::find_key(std::string_view name) const {
    return find(keys, name);
}
const SchemaNode* SchemaNode::find_variant(std::string_view name) const {
    return find(variants, name);
}

std::vector<std::string> SchemaNode::variant_names() const {
    std::vector<std::string> names;
    for (const SchemaNode* form : variants) names.push_back(form->key);
    return names;
}

const SchemaNode& schema_root() {
    return tree().root();
}
const std::vector<const SchemaNode*>& shared_sections() {
    return tree().shared();
}

}  // namespace scree::io
