#include "scenarios/shapes/mesh_file.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

#include "scenarios/shapes/convex_hull.hpp"
#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::array<std::pair<const char*, Polyhedron (*)(const MeshBytes&)>, 4> kFormats = {
    {{".off", read_off}, {".obj", read_obj}, {".stl", read_stl}, {".ply", read_ply}}};

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw IoError(fmt::format("{}: cannot be opened for reading", path));
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad() || std::filesystem::is_directory(path)) throw IoError(fmt::format("{}: cannot be read", path));
    return bytes;
}

auto format_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto format =
        std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return f.first == ending; });
    if (format == kFormats.end())
        throw IoError(
            fmt::format("{}: what kind of mesh it is cannot be told; a name that ends in .off, .obj, .stl or .ply "
                        "is expected",
                        path));
    return format->second;
}

// Vertices at the very same place become one: STL repeats them for each triangle, OBJ where normals differ.
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

// How many pairs of triangles cross, for a mesh that passed edges_of.
std::size_t crossings(const Polyhedron& body) {
    Mesh mesh;
    for (const Vec3& x : body.vertex) mesh.add_vertex(Kernel::Point_3(x.x(), x.y(), x.z()));
    for (const auto& loop : body.face) {
        std::vector<Mesh::Vertex_index> corners;
        for (const std::uint32_t v : loop) corners.emplace_back(v);
        if (mesh.add_face(corners) == Mesh::null_face()) return 0;
    }
    pmp::triangulate_faces(mesh);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    pmp::self_intersections(mesh, std::back_inserter(pairs));
    return pairs.size();
}

PlacedShape convex_body(const Polyhedron& body) {
    constexpr const char* kUseHull =
        "; only convex bodies can be used as they are: with `hull: true` its convex hull is taken";
    try {
        return make_shape(body, kSinglePrecisionTolerance);
    } catch (const ShapeError& error) {
        if (error.fault() == ShapeFault::not_oriented || error.fault() == ShapeFault::not_planar ||
            error.fault() == ShapeFault::not_convex) {
            const std::size_t pairs = crossings(body);
            if (pairs > 0)
                throw ShapeError(
                    ShapeFault::self_crossing,
                    fmt::format("its surface crosses itself in {} pairs of triangles, where none is expected", pairs));
        }
        if (error.fault() == ShapeFault::not_convex || error.fault() == ShapeFault::not_planar ||
            error.fault() == ShapeFault::not_manifold || error.fault() == ShapeFault::not_connected)
            throw ShapeError(error.fault(), error.what() + std::string(kUseHull));
        throw;
    }
}

}  // namespace

PlacedShape read_mesh(const std::string& path, const MeshOptions& options) {
    format_of(path);  // before the file is opened
    return read_mesh_bytes(path, bytes_of(path), options);
}

PlacedShape read_mesh_bytes(const std::string& path, const std::string& bytes, const MeshOptions& options) {
    Polyhedron body = format_of(path)({path, bytes});
    for (Vec3& x : body.vertex) x *= options.scale;
    join_equal_vertices(body);
    try {
        return options.hull ? convex_hull(body.vertex, kSinglePrecisionTolerance) : convex_body(body);
    } catch (const ShapeError& error) {
        throw ShapeError(error.fault(), fmt::format("{}: {}", path, error.what()));
    }
}

}  // namespace scree::scenarios
