#include "scenarios/point_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "scenarios/named_shapes.hpp"
#include "scenarios/placed_blocks.hpp"
#include "scenarios/shapes/convex_hull.hpp"
#include "scenarios/shared_text.hpp"

namespace scree::scenarios {
namespace {

constexpr std::size_t kMostFaults = 20;  // in one file; more of them tell nobody more
constexpr std::string_view kBlanks = " \t\r";

class Reader {
  public:
    Reader(const Context& context, std::string path, double scale, const Vec3& offset)
        : context_(context), scale_(scale) {
        file_.path = std::move(path);
        file_.offset = offset;
    }

    // Piece after piece; false when there are so many faults that no more will be read.
    bool read(std::string_view text) {
        for (std::size_t begin = 0; begin < text.size() && faults_ < kMostFaults;) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            ++line_;
            read_line(text.substr(begin, end - begin));
            begin = end + 1;
        }
        return faults_ < kMostFaults;
    }
    PointFile finish() {
        if (faults_ >= kMostFaults) fault(1, "further faults of this file are not shown");
        return std::move(file_);
    }

  private:
    void fault(std::size_t column, const std::string& message) {
        ++faults_;
        context_.diagnostics.error({file_.path, line_, static_cast<int>(column)}, message);
    }

    void read_line(std::string_view line) {
        if (line.find_first_not_of(kBlanks) == std::string_view::npos) {
            inside_ = false;
            return;
        }
        line = line.substr(0, line.find('#'));
        Vec3 x = Vec3::Zero();
        int found = 0;
        for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;
             at = line.find_first_not_of(kBlanks, at), ++found) {
            const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
            if (found < 3 && !read_number(line.substr(at, end - at), at + 1, x[found])) return;
            at = end;
        }
        if (found == 0) return;  // a comment
        if (found != 3) return fault(1, fmt::format("{} numbers, expected 3 (x y z)", found));
        add(scale_ * x);
    }

    bool read_number(std::string_view word, std::size_t place, double& value) {
        const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (code == std::errc{} && end == digits.data() + digits.size() && std::isfinite(value)) return true;
        fault(place, fmt::format("'{}' is not a finite number", word));
        return false;
    }

    void add(const Vec3& x) {
        if (!inside_) {
            file_.points.emplace_back();
            file_.line.push_back(line_);
            inside_ = true;
        }
        file_.points.back().push_back(x);
        file_.lower = file_.lower.cwiseMin(x + file_.offset);
        file_.upper = file_.upper.cwiseMax(x + file_.offset);
    }

    const Context& context_;
    double scale_;
    PointFile file_;
    int line_ = 0;
    bool inside_ = false;  // of a body
    std::size_t faults_ = 0;
};

}  // namespace

PointFile read_point_file(const io::Node& node, const Context& context, const Communicator& ranks) {
    const std::string path = (std::filesystem::path(context.folder) / node.text("path")).lexically_normal().string();
    SharedText text(path, ranks);
    if (!text.is_file()) {
        context.error(node.at("path"), fmt::format("cannot read '{}'", path));
        return {};
    }
    const std::size_t before = context.errors();
    Reader reader(context, path, node.number("scale"), node.vector("offset"));
    for (std::string piece = text.next(); !piece.empty() && reader.read(piece);) piece = text.next();
    if (text.failed()) {
        context.error(node.at("path"), fmt::format("'{}' could not be read to its end", path));
        return {};
    }
    PointFile file = reader.finish();
    if (context.errors() == before && file.points.empty())
        context.error(node.at("path"), fmt::format("'{}' holds no points", path));
    return file;
}

void add_hulls(const io::Node& node, const PointFile& file, const Context& context, const Communicator& ranks,
               BodyList& bodies) {
    std::vector<PlacedShape> blocks;
    std::size_t faults = 0;
    for (std::size_t k = 0; k < file.points.size() && faults < kMostFaults; ++k) {
        try {
            blocks.push_back(convex_hull(file.points[k]));
            check_features(blocks.back().shape);
            blocks.back().centre += file.offset - context.origin;
        } catch (const ShapeError& error) {
            ++faults;
            context.diagnostics.error({file.path, file.line[k], 1}, error.what());
        }
    }
    if (faults == 0) add_blocks(node, context, ranks, std::move(blocks), bodies);
}

}  // namespace scree::scenarios
