#include "io/scenario/scenario_reader.hpp"

#include "io/scenario/include.hpp"
#include "io/scenario/node_reader.hpp"
#include "io/scenario/overrides.hpp"

namespace scree::io {
namespace {

ReadResult finish(std::optional<Included> included, const std::string& main_file,
                  const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
    ReadResult result;
    if (!included) return result;
    for (const std::string& text : overrides) apply_override(text, included->tree, diagnostics);
    result.root = NodeReader(main_file, diagnostics).read_scenario(included->tree);
    if (!diagnostics.has_errors()) result.resolved = resolved_text(result.root);
    result.text = std::move(included->text);
    result.files = std::move(included->files);
    return result;
}

}  // namespace

ReadResult read_scenario(const std::string& path, const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
    return finish(read_with_includes(path, diagnostics), path, overrides, diagnostics);
}

ReadResult read_scenario_text(const std::string& text, const std::string& name,
                              const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
    return finish(read_text_with_includes(text, name, diagnostics), name, overrides, diagnostics);
}

}  // namespace scree::io
