#include "scenarios/body_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "scenarios/shared_text.hpp"

namespace scree::scenarios {
namespace {

constexpr std::size_t kMostFaults = 20;  // in one file; more of them tell nobody more

enum class Column { x, y, z, r, d, vx, vy, vz, wx, wy, wz, qw, qx, qy, qz, material, shape, skip };
constexpr std::array<std::string_view, 18> kColumnNames = {
    "x", "y", "z", "r", "d", "vx", "vy", "vz", "wx", "wy", "wz", "qw", "qx", "qy", "qz", "material", "shape", "skip"};
constexpr double kUnitTolerance = 1e-3;                                       // of a quaternion's length
constexpr std::size_t kNumbers = static_cast<std::size_t>(Column::material);  // columns that hold a number

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

// What a row has unless a column says otherwise.
struct Common {
    MaterialIndex material{};
    std::optional<std::size_t> shape{};  // of context.shapes; none: a sphere
};

// Reads one file; a fault is reported once, and the line passed over.
class Reader {
  public:
    // Keeps the bodies whose lines begin inside `part`, counted in bytes of the file.
    Reader(const Context& context, std::string path, std::vector<Column> columns, const Part& part, double scale,
           const Common& common, const Vec3& offset, RowFigures& figures)
        : context_(context),
          path_(std::move(path)),
          columns_(std::move(columns)),
          part_(part),
          scale_(scale),
          common_(common),
          figures_(figures),
          turned_(std::find(columns_.begin(), columns_.end(), Column::qw) != columns_.end()) {
        file_.offset = offset;
    }

    // Piece after piece; false when there are so many faults that no more will be read.
    bool read(std::string_view text) {
        for (std::size_t begin = 0; begin < text.size() && faults_ < kMostFaults;) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            ++line_;
            kept_ = part_.has(read_ + begin);
            read_line(text.substr(begin, end - begin));
            begin = end + 1;
        }
        read_ += text.size();
        return faults_ < kMostFaults;
    }
    BodyFile finish() {
        if (faults_ >= kMostFaults) fault(1, "further faults of this file are not shown");
        if (faults_ > 0) context_.diagnostics.add_source(path_, lines_read());
        return std::move(file_);
    }

  private:
    void fault(std::size_t column, const std::string& message) {
        ++faults_;
        context_.diagnostics.error({path_, line_, static_cast<int>(column)}, message);
    }

    // Once more from the file, for messages that show the lines with faults.
    std::string lines_read() const {
        std::ifstream stream(path_, std::ios::binary);
        std::string text, line;
        for (int i = 0; i < line_ && std::getline(stream, line); ++i) text += line + '\n';
        return text;
    }

    void read_line(std::string_view line) {
        line = line.substr(0, line.find('#'));
        std::array<double, kNumbers> number{};
        Common names = common_;
        std::size_t found = 0, at = 0;
        for (;;) {
            while (at < line.size() && is_blank(line[at])) ++at;
            if (at == line.size()) break;
            std::size_t end = at;
            while (end < line.size() && !is_blank(line[end])) ++end;
            if (found < columns_.size() &&
                !read_word(line.substr(at, end - at), at + 1, columns_[found], number, names)) {
                return;
            }
            ++found;
            at = end;
        }
        if (found == 0) return;
        if (found != columns_.size()) {
            fault(1, fmt::format("{} columns, expected {} ({})", found, columns_.size(), column_list()));
            return;
        }
        if (turned_ && std::abs(quaternion(number).coeffs().stableNorm() - 1.0) > kUnitTolerance) {
            fault(1, fmt::format("qw qx qy qz are no unit quaternion: its length is {:g}",
                                 quaternion(number).coeffs().stableNorm()));
            return;
        }
        add(number, names);
    }

    static Quat quaternion(const std::array<double, kNumbers>& number) {
        const auto get = [&](Column c) { return number[static_cast<std::size_t>(c)]; };
        return {get(Column::qw), get(Column::qx), get(Column::qy), get(Column::qz)};
    }

    bool read_word(std::string_view word, std::size_t place, Column column, std::array<double, kNumbers>& number,
                   Common& names) {
        if (column == Column::skip) return true;
        if (column == Column::material) return read_material(word, place, names.material);
        if (column == Column::shape) return read_shape(word, place, names.shape);
        const auto index = static_cast<std::size_t>(column);
        double& value = number[index];
        const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (code != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
            fault(place,
                  fmt::format("'{}' is not a finite number; column {} is expected here", word, kColumnNames[index]));
            return false;
        }
        if ((column == Column::r || column == Column::d) && !(value > 0.0)) {
            fault(place,
                  fmt::format("the {} must be above 0, is {}", column == Column::r ? "radius" : "diameter", word));
            return false;
        }
        return true;
    }

    bool read_material(std::string_view word, std::size_t place, MaterialIndex& material) {
        const auto found = find(word, place, context_.materials, "material");
        if (found) material = MaterialIndex{static_cast<std::uint16_t>(*found)};
        return found.has_value();
    }

    bool read_shape(std::string_view word, std::size_t place, std::optional<std::size_t>& shape) {
        std::vector<std::string> names;
        for (const NamedShape& named : context_.shapes) names.push_back(named.name);
        shape = find(word, place, names, "shape");
        return shape.has_value();
    }

    std::optional<std::size_t> find(std::string_view word, std::size_t place, const std::vector<std::string>& names,
                                    std::string_view what) {
        const auto known = std::find(names.begin(), names.end(), word);
        if (known != names.end()) return static_cast<std::size_t>(known - names.begin());
        const std::string near = io::nearest_name(word, names);
        fault(place, near.empty() ? fmt::format("there is no {} '{}'; there are: {}", what, word,
                                                names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")))
                                  : fmt::format("there is no {} '{}' (did you mean '{}'?)", what, word, near));
        return std::nullopt;
    }

    void add(const std::array<double, kNumbers>& number, const Common& names) {
        const auto get = [&](Column c) { return number[static_cast<std::size_t>(c)]; };
        const std::uint64_t row = file_.bodies++;
        // Of r and d one is a column, the other is 0; both are where a shape has its own size.
        double radius = scale_ * (get(Column::r) + 0.5 * get(Column::d));
        std::optional<RowFigure> figure;
        if (names.shape) {
            const std::optional<Quat> turned = turned_ ? std::optional(quaternion(number).normalized()) : std::nullopt;
            figure = figures_.figure(row, *names.shape, 2.0 * radius, turned);
            if (!figure) return;  // the shape is faulty, which has been reported
            radius = figure->radius;
        }
        const Vec3 position = scale_ * Vec3(get(Column::x), get(Column::y), get(Column::z));
        const Vec3 absolute = position + file_.offset, reach = Vec3::Constant(radius);
        file_.lower = file_.lower.cwiseMin(absolute - reach);
        file_.upper = file_.upper.cwiseMax(absolute + reach);
        if (!kept_) return;
        file_.row.push_back(row);
        file_.radius.push_back(radius);
        file_.material.push_back(names.material);
        file_.position.push_back(position);
        file_.velocity.emplace_back(get(Column::vx), get(Column::vy), get(Column::vz));
        file_.spin.emplace_back(get(Column::wx), get(Column::wy), get(Column::wz));
        if (figure) {
            file_.instance.push_back(figure->instance);
            file_.orientation.push_back(figure->orientation);
        }
    }

    std::string column_list() const {
        std::vector<std::string_view> names;
        for (Column c : columns_) names.push_back(kColumnNames[static_cast<std::size_t>(c)]);
        return fmt::format("{}", fmt::join(names, " "));
    }

    const Context& context_;
    std::string path_;
    std::vector<Column> columns_;
    Part part_;
    double scale_;
    Common common_;
    RowFigures& figures_;
    bool turned_;  // columns hold quaternions
    BodyFile file_;
    std::uint64_t read_ = 0;  // [bytes] of the pieces before this one
    int line_ = 0;
    bool kept_ = true;  // the body of this line
    std::size_t faults_ = 0;
};

std::vector<Column> read_columns(const io::Node& node, const Context& context) {
    std::vector<Column> columns = {Column::x, Column::y, Column::z, Column::r};
    if (!node.has("columns")) return columns;
    columns.clear();
    std::array<int, kColumnNames.size()> times{};
    for (const io::Node& name : node.at("columns").items()) {
        const auto known = std::find(kColumnNames.begin(), kColumnNames.end(), name.text());
        const auto index = static_cast<std::size_t>(known - kColumnNames.begin());
        if (known == kColumnNames.end()) {
            context.error(name, fmt::format("there is no column '{}'", name.text()));
            continue;
        }
        columns.push_back(static_cast<Column>(index));
        if (++times[index] > 1 && columns.back() != Column::skip) {
            context.error(name, fmt::format("column '{}' is given twice", name.text()));
        }
    }
    const auto has = [&](Column c) { return times[static_cast<std::size_t>(c)] > 0; };
    const auto times_of = [&](std::initializer_list<Column> of) {
        return static_cast<int>(std::count_if(of.begin(), of.end(), has));
    };
    if (!has(Column::x) || !has(Column::y) || !has(Column::z)) {
        context.error(node.at("columns"), "must name x, y and z");
    }
    const bool shapes = has(Column::shape) || node.has("shape");
    if (has(Column::r) && has(Column::d)) {
        context.error(node.at("columns"), "must name one of r (radius) and d (diameter), not both");
    } else if (!has(Column::r) && !has(Column::d) && !shapes) {
        context.error(node.at("columns"), "must name one of r (radius) and d (diameter)");
    }
    const int turns = times_of({Column::qw, Column::qx, Column::qy, Column::qz});
    if (turns != 0 && turns != 4) context.error(node.at("columns"), "must name all of qw, qx, qy and qz, or none");
    if (turns != 0 && !shapes) context.error(node.at("columns"), "qw, qx, qy and qz are for polyhedra: give a `shape`");
    if (turns != 0 && node.has("orientation"))
        context.error(node.at("orientation"), "columns qw, qx, qy and qz say it already");
    if (node.has("orientation") && !shapes) context.error(node.at("orientation"), "needs a `shape`: these are spheres");
    if (has(Column::shape) && node.has("shape"))
        context.error(node.at("columns"), "names a shape, and so does the key `shape`");
    if (has(Column::material) == node.has("material")) {
        context.error(node.at("columns"), has(Column::material) ? "names a material, and so does the key `material`"
                                                                : "has no material: give the key `material`");
    }
    return columns;
}

std::string resolve(const io::Node& path, const Context& context) {
    return (std::filesystem::path(context.folder) / path.text()).lexically_normal().string();
}

}  // namespace

BodyFile read_body_file(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                        bool whole) {
    const std::size_t before = context.errors();
    Common common;
    if (node.has("material")) common.material = context.material(node.at("material"));
    if (node.has("shape")) common.shape = context.shape(node.at("shape"));
    RowFigures figures(node, stream, context);
    std::vector<Column> columns = read_columns(node, context);
    if (!node.has("columns") && !node.has("material"))
        context.error(node, "needs `material`, or a column that holds it");

    const std::string path = resolve(node.at("path"), context);
    SharedText text(path, ranks);
    if (!text.is_file()) context.error(node.at("path"), fmt::format("cannot read '{}'", path));
    if (context.errors() != before) return {};

    const Communicator& sharing = whole ? Communicator::self() : ranks;
    Part part(text.size(), sharing);
    if (sharing.rank() + 1 == sharing.size())
        part.end = std::numeric_limits<std::uint64_t>::max();  // it may have grown
    Reader reader(context, path, std::move(columns), part, number_or(node, "scale", 1.0), common,
                  vector_or(node, "offset", Vec3::Zero()), figures);
    for (std::string piece = text.next(); !piece.empty() && reader.read(piece);) piece = text.next();
    if (text.failed()) {
        context.error(node.at("path"), fmt::format("'{}' could not be read to its end", path));
        return {};
    }
    BodyFile file = reader.finish();
    file.instances = figures.instances();
    if (context.errors() == before && file.bodies == 0) {
        context.error(node.at("path"), fmt::format("'{}' holds no bodies", path));
    }
    return file;
}

void add_file_bodies(const BodyFile& file, const Context& context, BodyList& bodies) {
    const Vec3 offset = file.offset - context.origin;
    std::vector<ShapeIndex> shapes;
    for (const RowInstance& instance : file.instances)
        shapes.push_back(bodies.add_instance(context.shapes[instance.shape], instance.variant, instance.factor));
    for (std::size_t i = 0; i < file.radius.size(); ++i) {
        const std::uint64_t id = bodies.next_id + file.row[i];
        const Vec3 position = file.position[i] + offset;
        if (file.instance.empty()) {
            bodies.add(id, file.radius[i], file.material[i], position, file.velocity[i], file.spin[i]);
        } else {
            bodies.add(id, shapes[file.instance[i]], file.material[i], position, file.orientation[i], file.velocity[i],
                       file.spin[i]);
        }
    }
    bodies.next_id += file.bodies;
}

}  // namespace scree::scenarios
