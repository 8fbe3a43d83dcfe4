// scree compare: two results, number by number.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "io/results/compare.hpp"

namespace scree::app {

int compare_command(const std::string& a, const std::string& b, double tolerance) {
    const io::Comparison comparison = io::compare(a, b, tolerance);
    fmt::print("{}", io::to_text(comparison));
    return comparison.within ? 0 : 1;
}

}  // namespace scree::app
