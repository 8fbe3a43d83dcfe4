// A comparison in words.
#include <fmt/format.h>

#include <algorithm>

#include "io/results/compare.hpp"

namespace scree::io {

namespace {

constexpr std::size_t kIdsShown = 10;

std::string ids(const std::vector<std::uint64_t>& list) {
    std::string text;
    for (std::size_t i = 0; i < std::min(list.size(), kIdsShown); ++i) text += fmt::format(" {}", list[i]);
    if (list.size() > kIdsShown) text += fmt::format(" ... ({} in all)", list.size());
    return text;
}

}  // namespace

std::string to_text(const Comparison& c) {
    std::string text;
    std::size_t equal = 0;
    for (const Difference& d : c.differences) {
        if (d.identical) {
            ++equal;
            continue;
        }
        text += d.dataset;
        if (d.different > 0) {
            text += fmt::format(": {} of {} numbers differ, by {:.3g} {} at most, {:.3g} of the largest", d.different,
                                d.compared, d.max_absolute, d.unit == "1" ? "" : d.unit, d.max_relative);
        }
        if (!d.note.empty()) text += ": " + d.note;
        text += d.within ? " (within the tolerance)\n" : "\n";
    }
    for (const std::string& note : c.notes) text += note + "\n";
    if (!c.only_in_a.empty()) text += "bodies only in the first:" + ids(c.only_in_a) + "\n";
    if (!c.only_in_b.empty()) text += "bodies only in the second:" + ids(c.only_in_b) + "\n";
    text += fmt::format("{} of {} datasets are identical.\n", equal, c.differences.size());
    text += c.identical ? "Identical.\n" : c.within ? "Equal within the tolerance.\n" : "Different.\n";
    return text;
}

}  // namespace scree::io
