#include "io/scenario/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/errors.hpp"
#include "io/scenario/utf8.hpp"

namespace scree::io {
namespace {

std::vector<std::string> split_lines(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n') {
            lines.emplace_back();
        } else if (c != '\r') {
            lines.back() += c;
        }
    }
    return lines;
}

// The part of a line around a column, which counts characters, and below it the caret. Long lines are cut, bytes that
// are no text are shown as '?'. Tabs stay tabs in both lines, so that the caret stands where the fault is.
std::string excerpt(const std::string& line, int column) {
    constexpr int before = 110, after = 50;
    std::string shown, blanks;
    int character = 0;
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t length = utf8_length(line, i);
        const auto byte = static_cast<unsigned char>(line[i]);
        const bool printable = length > 0 && (byte >= 0x20 || byte == '\t') && byte != 0x7F;
        ++character;
        if (character >= column - before && character <= column + after) {
            shown += printable ? line.substr(i, length) : "?";
            if (character < column) blanks += byte == '\t' ? '\t' : ' ';
        }
        i += std::max<std::size_t>(length, 1);
    }
    const bool cut_left = column - before > 1, cut_right = character > column + after;
    return fmt::format("    {}{}{}\n    {}{}^\n", cut_left ? "..." : "", shown, cut_right ? "..." : "",
                       cut_left ? "   " : "", blanks);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    std::vector<std::size_t> above = row, above2 = row;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        above2 = above;
        above = row;
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool equal = a[i - 1] == b[j - 1];
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (equal ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], above2[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

void Diagnostics::add_source(const std::string& file, const std::string& text) {
    const auto same = [&](const Source& source) { return source.file == file; };
    if (std::any_of(sources_.begin(), sources_.end(), same)) return;
    sources_.push_back({file, split_lines(text)});
}

void Diagnostics::error(const Mark& mark, const std::string& message) {
    errors_.push_back({mark, message});
}
void Diagnostics::warning(const Mark& mark, const std::string& message) {
    warnings_.push_back({mark, message});
}

std::string Diagnostics::report() const {
    return render(errors_, "error");
}
std::string Diagnostics::warnings() const {
    return render(warnings_, "warning");
}

void Diagnostics::throw_if_errors() const {
    if (has_errors()) throw ScenarioError(report());
}

std::string Diagnostics::render(const std::vector<Entry>& entries, std::string_view severity) const {
    // Files in the order in which they were read; within a file by place; what has one place in order of discovery.
    const auto rank_of = [&](const std::string& file) {
        const auto found =
            std::find_if(sources_.begin(), sources_.end(), [&](const auto& s) { return s.file == file; });
        return found - sources_.begin();
    };
    std::vector<Entry> sorted = entries;
    std::stable_sort(sorted.begin(), sorted.end(), [&](const Entry& a, const Entry& b) {
        return std::tuple(rank_of(a.mark.file), a.mark.file, a.mark.line, a.mark.column) <
               std::tuple(rank_of(b.mark.file), b.mark.file, b.mark.line, b.mark.column);
    });
    constexpr std::size_t most = 100;  // more say no more
    std::string report;
    for (const Entry& entry : sorted) {
        if (&entry == sorted.data() + most) {
            return report + fmt::format("... and {} more like these\n", sorted.size() - most);
        }
        const Mark& mark = entry.mark;
        if (mark.line > 0) {
            report += fmt::format("{}:{}:{}: {}: {}\n", mark.file, mark.line, mark.column, severity, entry.message);
        } else {
            report += fmt::format("{}: {}: {}\n", mark.file, severity, entry.message);
        }
        const auto source = static_cast<std::size_t>(rank_of(mark.file));
        if (mark.line <= 0 || source >= sources_.size()) continue;
        const auto& lines = sources_[source].lines;
        const auto line = static_cast<std::size_t>(mark.line - 1);
        if (line >= lines.size()) continue;
        report += excerpt(lines[line], mark.column);
    }
    return report;
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
    std::string best;
    // One slip in a short word, two in a usual one, three in a long one.
    std::size_t least = (word.size() < 4 ? 1 : word.size() < 9 ? 2 : 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace scree::io
