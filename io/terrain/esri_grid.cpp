#include "io/terrain/esri_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/atomic_file.hpp"
#include "io/terrain/gzip.hpp"

namespace scree::io {
namespace {

constexpr double kUsualNoData = -9999.0;
constexpr double kFarBelow = -1e30;  // single and double precision write -3.4e38 in many ways

enum Key { ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize, dx, dy, nodata, kKeys };
struct Spelling {
    std::string_view name;
    Key key;
};
constexpr Spelling kSpellings[] = {{"ncols", ncols},
                                   {"nrows", nrows},
                                   {"xllcorner", xllcorner},
                                   {"xllcenter", xllcenter},
                                   {"xllcentre", xllcenter},
                                   {"yllcorner", yllcorner},
                                   {"yllcenter", yllcenter},
                                   {"yllcentre", yllcenter},
                                   {"cellsize", cellsize},
                                   {"dx", dx},
                                   {"dy", dy},
                                   {"xdim", dx},
                                   {"ydim", dy},
                                   {"nodata_value", nodata},
                                   {"nodata", nodata}};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string lower_case(std::string_view word) {
    std::string text(word);
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<double> to_number(std::string_view word) {
    const std::string_view digits = word.substr(!word.empty() && word.front() == '+' ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return value;
}

class Reader {
  public:
    Reader(std::string_view text, const std::string& path) : text_(text), path_(path) {
        if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    }

    HeightGrid read() {
        read_header();
        HeightGrid grid = shape();
        read_heights(grid);
        return grid;
    }

  private:
    [[noreturn]] void fail(const std::string& message, int line = 0) const {
        throw EsriFault(path_, line > 0 ? line : line_, message);
    }

    // The next word, on whatever line; empty at the end of the file.
    std::string_view word() {
        while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\n')) {
            if (text_[at_] == '\n') ++line_;
            ++at_;
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n') ++at_;
        return text_.substr(begin, at_ - begin);
    }

    static std::string shown(std::string_view word) {
        std::string text(word.substr(0, 40));
        for (char& c : text)
            if (static_cast<unsigned char>(c) < ' ') c = '?';
        return word.size() > 40 ? text + "..." : text;
    }

    void read_header() {
        for (;;) {
            const std::size_t before = at_;
            const int line_before = line_;
            const std::string name = lower_case(word());
            if (name.empty() || to_number(name)) {
                at_ = before, line_ = line_before;
                return;
            }
            const auto known = std::find_if(std::begin(kSpellings), std::end(kSpellings),
                                            [&](const Spelling& s) { return s.name == name; });
            if (known == std::end(kSpellings)) {
                fail(
                    fmt::format("'{}' is no key of an ESRI grid; expected ncols, nrows, xllcorner or xllcenter, "
                                "yllcorner or yllcenter, cellsize (or dx and dy), NODATA_value",
                                shown(name)));
            }
            if (value_[known->key]) fail(fmt::format("'{}' is given twice", name));
            const int line = line_;
            const std::string_view number = word();
            value_[known->key] = to_number(number);
            if (!value_[known->key] || line_ != line)
                fail(fmt::format("'{}' needs a number beside it{}", name,
                                 number.empty() || line_ != line ? "" : fmt::format(", not '{}'", shown(number))),
                     line);
            at_line_[known->key] = line;
            if (!std::isfinite(*value_[known->key]) && known->key != nodata)
                fail(fmt::format("'{}' is {}; a finite number is expected", name, shown(number)));
        }
    }

    double need(Key key, Key otherwise, const char* names) const {
        if (value_[key] && value_[otherwise]) fail(fmt::format("{} are both given; one is expected", names));
        if (!value_[key] && !value_[otherwise]) fail(fmt::format("the header lacks {}", names));
        return value_[key] ? *value_[key] : *value_[otherwise];
    }

    std::uint32_t count(Key key, const char* name) const {
        if (!value_[key]) fail(fmt::format("the header lacks {}", name));
        const double n = *value_[key];
        if (n != std::floor(n) || n < 2.0 || n > 4e9)
            fail(fmt::format("{} is {:g}; a whole number from 2 on is expected", name, n), at_line_[key]);
        return static_cast<std::uint32_t>(n);
    }

    double size_of_cell(Key key, const char* name) const {
        const bool own = value_[key].has_value();
        if (!own && !value_[cellsize])
            fail(fmt::format("the header lacks cellsize{}", own ? "" : fmt::format(" (or {})", name)));
        const double size = own ? *value_[key] : *value_[cellsize];
        if (!(size > 0.0))
            fail(fmt::format("the size of a cell is {:g}; it must be above 0", size), at_line_[own ? key : cellsize]);
        return size;
    }

    HeightGrid shape() {
        HeightGrid grid;
        grid.columns = count(ncols, "ncols"), grid.rows = count(nrows, "nrows");
        grid.dx = size_of_cell(dx, "dx"), grid.dy = size_of_cell(dy, "dy");
        grid.x = need(xllcorner, xllcenter, "xllcorner and xllcenter") + (value_[xllcorner] ? 0.5 * grid.dx : 0.0);
        grid.y = need(yllcorner, yllcenter, "yllcorner and yllcenter") + (value_[yllcorner] ? 0.5 * grid.dy : 0.0);
        // before memory is asked for
        const double heights = static_cast<double>(grid.columns) * grid.rows;
        const auto bytes = static_cast<double>(text_.size() - at_);
        if (heights > bytes + 1e6)
            fail(fmt::format("{} x {} heights are announced, and {:.0f} bytes follow: fewer than these need",
                             grid.columns, grid.rows, bytes));
        grid.height.resize(std::size_t{grid.columns} * grid.rows);
        return grid;
    }

    bool is_nodata(double z) const {
        const double mark = value_[nodata].value_or(kUsualNoData);
        return z == mark || (z < kFarBelow && mark < kFarBelow) || (std::isnan(z) && std::isnan(mark));
    }

    // Each row on a line, if the first one is; else they run on over lines as they like.
    void read_heights(HeightGrid& grid) {
        std::size_t row_begin = 0;  // the heights read when the line began
        int line = 0;
        bool in_rows = true;
        const std::size_t n = grid.height.size();
        for (std::size_t k = 0; k <= n; ++k) {
            const std::string_view next = word();
            if (line > 0 && line_ != line && in_rows && k - row_begin != grid.columns) {
                if (row_begin > 0)
                    fail(fmt::format("{} heights on this line; {} are expected", k - row_begin, grid.columns), line);
                in_rows = false;
            }
            if (line_ != line) row_begin = k, line = line_;
            if (k == n) {
                if (!next.empty())
                    fail(fmt::format("'{}' follows after all {} x {} heights", shown(next), grid.columns, grid.rows));
                return;
            }
            if (next.empty())
                fail(fmt::format("the file ends after {} heights; {} x {} = {} are expected", k, grid.columns,
                                 grid.rows, n));
            const auto z = to_number(next);
            if (!z)
                fail(fmt::format("'{}' is no number; the {} of column {} is expected", shown(next), "height",
                                 k % grid.columns + 1));
            const bool none = is_nodata(*z);
            if (!none && !std::isfinite(*z))
                fail(fmt::format("a height is {}; a finite number is expected", shown(next)));
            const std::size_t row = grid.rows - 1 - k / grid.columns;
            grid.height[row * grid.columns + k % grid.columns] = none ? std::nan("") : *z;
        }
    }

    std::string_view text_;
    const std::string& path_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::array<std::optional<double>, kKeys> value_;
    std::array<int, kKeys> at_line_{};
};

// A number that no height is.
double free_mark(const HeightGrid& grid) {
    double mark = kUsualNoData;
    while (std::find(grid.height.begin(), grid.height.end(), mark) != grid.height.end()) mark = 10.0 * mark - 9.0;
    return mark;
}

// The corner, where half a cell from it is the node again to the last bit.
std::string lower_left(const char* axis, double node, double size) {
    const double corner = node - 0.5 * size;
    const bool exact = corner + 0.5 * size == node;
    return fmt::format("{}ll{} {}\n", axis, exact ? "corner" : "center", exact ? corner : node);
}

}  // namespace

HeightGrid parse_esri_grid(std::string_view text, const std::string& path) {
    return Reader(text, path).read();
}

HeightGrid read_esri_grid(const std::string& path) {
    std::string bytes = read_text(path);
    if (is_gzip(bytes)) bytes = gunzip(bytes, path);
    return parse_esri_grid(bytes, path);
}

std::string esri_text(const HeightGrid& grid) {
    const double mark = free_mark(grid);
    std::string text = fmt::format("ncols {}\nnrows {}\n", grid.columns, grid.rows);
    text += lower_left("x", grid.x, grid.dx) + lower_left("y", grid.y, grid.dy);
    text +=
        grid.dx == grid.dy ? fmt::format("cellsize {}\n", grid.dx) : fmt::format("dx {}\ndy {}\n", grid.dx, grid.dy);
    text += fmt::format("NODATA_value {}\n", mark);
    for (std::uint32_t j = grid.rows; j-- > 0;)
        for (std::uint32_t i = 0; i < grid.columns; ++i) {
            const double z = grid.has(i, j) ? grid.at(i, j) : mark;
            fmt::format_to(std::back_inserter(text), "{}{}", z, i + 1 == grid.columns ? '\n' : ' ');
        }
    return text;
}

void write_esri_grid(const std::string& path, const HeightGrid& grid) {
    const std::string text = esri_text(grid);
    write_text_atomically(path, path.ends_with(".gz") ? gzip(text) : text);
}

}  // namespace scree::io
