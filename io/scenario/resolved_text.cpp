// The resolved scenario as YAML.
#include <fmt/format.h>

#include <utility>

#include "io/scenario/scenario_reader.hpp"
#include "io/scenario/schema.hpp"

namespace scree::io {
namespace {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        switch (c) {
            case '"':
                result += "\\\"";
                break;
            case '\\':
                result += "\\\\";
                break;
            case '\n':
                result += "\\n";
                break;
            case '\t':
                result += "\\t";
                break;
            case '\r':
                result += "\\r";
                break;
            default:
                if (static_cast<unsigned char>(c) < 0x20) {
                    result += fmt::format("\\x{:02x}", c);
                } else {
                    result += c;
                }
        }
    }
    return result + "\"";
}

// A value on one line.
std::string flow(const Node& node) {
    struct Visitor {
        std::string operator()(std::monostate) const { return "null"; }
        std::string operator()(bool value) const { return value ? "true" : "false"; }
        std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
        std::string operator()(double value) const { return fmt::format("{}", value); }
        std::string operator()(const std::string& value) const { return quoted(value); }
        std::string operator()(const Vec3& value) const {
            return fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z());
        }
        std::string operator()(const Node::List& value) const {
            std::string result;
            for (const Node& item : value) result += (result.empty() ? "" : ", ") + flow(item);
            return "[" + result + "]";
        }
        std::string operator()(const Node::Map&) const { return "{}"; }  // sections go over several lines
    };
    return std::visit(Visitor{}, node.value);
}

class Writer {
  public:
    // `first`: what stands before the section's first line in place of the indentation ("  - ").
    void section(const SchemaNode& schema, const Node& node, const std::string& indent, std::string first) {
        const auto start = [&] { return std::exchange(first, indent); };
        const SchemaNode* form = nullptr;
        if (!schema.variants.empty()) {
            form = schema.find_variant(node.text(schema.variant_key));
            text += fmt::format("{}{}: {}\n", start(), schema.variant_key, form->key);
        }
        for (const auto* keys : {&schema.keys, form != nullptr ? &form->keys : nullptr}) {
            if (keys == nullptr) continue;
            for (const SchemaNode* key : *keys) {
                if (node.has(key->key)) entry(*key, node.at(key->key), indent, start());
            }
        }
    }

    std::string text;

  private:
    void entry(const SchemaNode& schema, const Node& node, const std::string& indent, const std::string& first) {
        text += first + schema.key + ":";
        const std::string inner = indent + "  ";
        switch (schema.row->kind) {
            case Kind::section:
                text += "\n";
                section(schema, node, inner, inner);
                return;
            case Kind::named: {
                const auto& map = std::get<Node::Map>(node.value);
                text += map.empty() ? " {}\n" : "\n";
                for (const auto& [name, item] : map) {
                    text += inner + quoted(name) + ":\n";
                    section(schema, item, inner + "  ", inner + "  ");
                }
                return;
            }
            case Kind::list:
                text += node.items().empty() ? " []\n" : "\n";
                for (const Node& item : node.items()) section(schema, item, inner + "  ", inner + "- ");
                return;
            default:
                text.append(" ").append(flow(node)).append("\n");
        }
    }
};

}  // namespace

std::string resolved_text(const Node& root) {
    Writer writer;
    writer.section(schema_root(), root, "", "");
    return writer.text;
}

}  // namespace scree::io
