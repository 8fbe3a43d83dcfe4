// scree info: what a file of results is.
#include "io/results/info.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"

namespace scree::app {

ExitCode info_command(const std::string& path) {
    fmt::print("{}", io::info(path));
    return ExitCode::complete;
}

}  // namespace scree::app
