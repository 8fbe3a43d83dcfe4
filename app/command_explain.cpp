// scree explain: what a key of scenarios means; without a key, what there is.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "io/scenario/schema.hpp"
#include "io/scenario/schema_text.hpp"

namespace scree::app {
namespace {

std::string first_sentence(const std::string& text) {
    return text.substr(0, text.find(". "));
}

// The keys of the first level; those of sections are a call away.
std::string overview() {
    std::string text = "The keys of a scenario (* must be given); 'scree explain KEY' says more:\n";
    for (const io::SchemaNode* key : io::schema_root().keys) {
        text +=
            fmt::format("  {:<18}{} {}\n", key->key, key->row->is_required ? "*" : " ", first_sentence(key->row->doc));
    }
    return text;
}

}  // namespace

ExitCode explain_command(const std::string& key) {
    fmt::print("{}", key.empty() ? overview() : io::explain(key));
    return ExitCode::complete;
}

}  // namespace scree::app
