#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <tuple>

#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

constexpr std::array<std::pair<const char*, Polyhedron (*)(const MeshBytes&)>, 4> kFormats = {
    {{".off", read_off}, {".obj", read_obj}, {".stl", read_stl}, {".ply", read_ply}}};

}  // namespace

Polyhedron parse_mesh(const MeshBytes& file) {
    std::string ending = std::filesystem::path(file.path).extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto format =
        std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return f.first == ending; });
    if (format == kFormats.end())
        throw IoError(
            fmt::format("{}: what kind of mesh it is cannot be told; a name that ends in .off, .obj, .stl or .ply "
                        "is expected",
                        file.path));
    return format->second(file);
}

void join_equal_vertices(Polyhedron& body) {
    using Key = std::tuple<double, double, double>;
    std::map<Key, std::uint32_t> seen;
    std::vector<std::uint32_t> first;
    for (const Vec3& x : body.vertex) {
        const auto place = static_cast<std::uint32_t>(first.size());
        first.push_back(x.allFinite() ? seen.insert({Key(x.x(), x.y(), x.z()), place}).first->second : place);
    }
    for (auto& loop : body.face)
        for (std::uint32_t& v : loop) v = first[v];
    if (!body.face.empty()) drop_unused_vertices(body);
}

}  // namespace scree::scenarios
