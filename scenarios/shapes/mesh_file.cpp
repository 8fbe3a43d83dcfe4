#include "scenarios/shapes/mesh_file.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "scenarios/shapes/convex_hull.hpp"
#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (std::filesystem::is_directory(path)) throw IoError(fmt::format("{}: cannot be read", path));
    if (!file) throw IoError(fmt::format("{}: cannot be opened for reading", path));
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad()) throw IoError(fmt::format("{}: cannot be read", path));
    return bytes;
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
    check_mesh_name(path);  // before the file is opened
    return read_mesh_bytes(path, bytes_of(path), options);
}

PlacedShape read_mesh_bytes(const std::string& path, const std::string& bytes, const MeshOptions& options) {
    Polyhedron body = parse_mesh({path, bytes});
    for (Vec3& x : body.vertex) x *= options.scale;
    join_equal_vertices(body);
    try {
        return options.hull ? convex_hull(body.vertex, kSinglePrecisionTolerance) : convex_body(body);
    } catch (const ShapeError& error) {
        throw ShapeError(error.fault(), fmt::format("{}: {}", path, error.what()));
    }
}

}  // namespace scree::scenarios
