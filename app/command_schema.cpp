// scree schema: the JSON Schema of scenarios, or their reference page.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "io/scenario/schema_json.hpp"
#include "io/scenario/schema_text.hpp"

namespace scree::app {

ExitCode schema_command(bool reference) {
    fmt::print("{}", reference ? io::reference_markdown() : io::schema_json());
    return ExitCode::complete;
}

}  // namespace scree::app
