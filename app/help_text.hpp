// The texts of --help and --version.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scree::app {

std::string_view top_help();
// What stands below the options in `scree <subcommand> --help`: examples.
std::string_view subcommand_footer(std::string_view subcommand);
std::string version_text();
const std::vector<std::string>& subcommand_names();

}  // namespace scree::app
