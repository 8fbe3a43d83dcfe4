#include "scenarios/body_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace scree::scenarios {
namespace {

constexpr std::size_t kMostFaults = 20;  // in one file; more of them tell nobody more

enum class Column { x, y, z, r, d, vx, vy, vz, wx, wy, wz, material, skip };
constexpr std::array<std::string_view, 13> kColumnNames = {"x",  "y",  "z",  "r",  "d",        "vx",  "vy",
                                                           "vz", "wx", "wy", "wz", "material", "skip"};
constexpr std::size_t kNumbers = static_cast<std::size_t>(Column::material);  // columns that hold a number

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

// Reads one file; a fault is reported once, and the line passed over.
class Reader {
  public:
    Reader(const Context& context, std::string path, std::string text, std::vector<Column> columns, double scale,
           MaterialIndex material)
        : context_(context),
          path_(std::move(path)),
          text_(std::move(text)),
          columns_(std::move(columns)),
          scale_(scale),
          material_(material) {}

    BodyFile read() {
        const std::string_view text = text_;
        for (std::size_t begin = 0; begin < text.size() && faults_ < kMostFaults;) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            ++line_;
            read_line(text.substr(begin, end - begin));
            begin = end + 1;
        }
        if (faults_ >= kMostFaults) fault(1, "further faults of this file are not shown");
        return std::move(file_);
    }

  private:
    void fault(std::size_t column, const std::string& message) {
        if (faults_++ == 0) context_.diagnostics.add_source(path_, text_);
        context_.diagnostics.error({path_, line_, static_cast<int>(column)}, message);
    }

    void read_line(std::string_view line) {
        line = line.substr(0, line.find('#'));
        std::array<double, kNumbers> number{};
        MaterialIndex material = material_;
        std::size_t found = 0, at = 0;
        for (;;) {
            while (at < line.size() && is_blank(line[at])) ++at;
            if (at == line.size()) break;
            std::size_t end = at;
            while (end < line.size() && !is_blank(line[end])) ++end;
            if (found < columns_.size() &&
                !read_word(line.substr(at, end - at), at + 1, columns_[found], number, material)) {
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
        add(number, material);
    }

    bool read_word(std::string_view word, std::size_t place, Column column, std::array<double, kNumbers>& number,
                   MaterialIndex& material) {
        if (column == Column::skip) return true;
        if (column == Column::material) return read_material(word, place, material);
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
        const auto known = std::find(context_.materials.begin(), context_.materials.end(), word);
        if (known != context_.materials.end()) {
            material = MaterialIndex{static_cast<std::uint16_t>(known - context_.materials.begin())};
            return true;
        }
        const std::string near = io::nearest_name(word, context_.materials);
        fault(place, near.empty() ? fmt::format("there is no material '{}'; there are: {}", word,
                                                fmt::join(context_.materials, ", "))
                                  : fmt::format("there is no material '{}' (did you mean '{}'?)", word, near));
        return false;
    }

    void add(const std::array<double, kNumbers>& number, MaterialIndex material) {
        const auto get = [&](Column c) { return number[static_cast<std::size_t>(c)]; };
        // Of r and d one is a column, the other is 0.
        file_.radius.push_back(scale_ * (get(Column::r) + 0.5 * get(Column::d)));
        file_.material.push_back(material);
        file_.position.emplace_back(scale_ * Vec3(get(Column::x), get(Column::y), get(Column::z)));
        file_.velocity.emplace_back(get(Column::vx), get(Column::vy), get(Column::vz));
        file_.spin.emplace_back(get(Column::wx), get(Column::wy), get(Column::wz));
    }

    std::string column_list() const {
        std::vector<std::string_view> names;
        for (Column c : columns_) names.push_back(kColumnNames[static_cast<std::size_t>(c)]);
        return fmt::format("{}", fmt::join(names, " "));
    }

    const Context& context_;
    std::string path_, text_;
    std::vector<Column> columns_;
    double scale_;
    MaterialIndex material_;
    BodyFile file_;
    int line_ = 0;
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
    if (!has(Column::x) || !has(Column::y) || !has(Column::z)) {
        context.error(node.at("columns"), "must name x, y and z");
    }
    if (has(Column::r) == has(Column::d))
        context.error(node.at("columns"), "must name one of r (radius) and d (diameter)");
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

BodyFile read_body_file(const io::Node& node, const Context& context) {
    const std::size_t before = context.errors();
    MaterialIndex material{};
    if (node.has("material")) material = context.material(node.at("material"));
    std::vector<Column> columns = read_columns(node, context);
    if (!node.has("columns") && !node.has("material"))
        context.error(node, "needs `material`, or a column that holds it");

    const std::string path = resolve(node.at("path"), context);
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    const bool is_file = stream && std::filesystem::is_regular_file(path);
    if (!is_file) context.error(node.at("path"), fmt::format("cannot read '{}'", path));
    if (context.errors() != before) return {};

    std::string text(static_cast<std::size_t>(stream.tellg()), '\0');
    stream.seekg(0);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!stream) {
        context.error(node.at("path"), fmt::format("'{}' could not be read to its end", path));
        return {};
    }
    Reader reader(context, path, std::move(text), std::move(columns), number_or(node, "scale", 1.0), material);
    BodyFile file = reader.read();
    file.offset = vector_or(node, "offset", Vec3::Zero());
    if (context.errors() == before && file.radius.empty()) {
        context.error(node.at("path"), fmt::format("'{}' holds no bodies", path));
    }
    return file;
}

void add_file_bodies(const BodyFile& file, const Context& context, BodyList& bodies) {
    const Vec3 offset = file.offset - context.origin;
    for (std::size_t i = 0; i < file.radius.size(); ++i) {
        bodies.add(file.radius[i], file.material[i], file.position[i] + offset, file.velocity[i], file.spin[i]);
    }
}

}  // namespace scree::scenarios
