#include "io/results/body_mesh.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace scree::io {
namespace {

constexpr std::uint32_t kPolygon = 3;  // XDMF's number

// The bodies that have a surface, and how much of it.
struct Surfaces {
    std::vector<std::size_t> body;
    std::uint64_t points = 0, faces = 0;

    Surfaces(const Bodies& bodies, const std::vector<ConvexShape>& shapes) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (bodies.is_sphere(i)) continue;
            body.push_back(i);
            points += shapes[raw(bodies.shape[i])].vertex.size();
            faces += shapes[raw(bodies.shape[i])].face.size();
        }
    }
};

struct Source {
    const Bodies& bodies;
    const std::vector<ConvexShape>& shapes;
    const Surfaces& surfaces;

    const ConvexShape& shape(std::size_t i) const { return shapes[raw(bodies.shape[i])]; }
};

bool single_precision_is_enough(const Source& from, const Vec3& origin, const Communicator& ranks) {
    double farthest = 0.0, smallest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : from.surfaces.body) {
        const Vec3 x = from.bodies.position[i] + origin;
        farthest = std::max(farthest, x.cwiseAbs().maxCoeff() + from.bodies.radius[i]);
        smallest = std::min(smallest, from.bodies.radius[i]);
    }
    constexpr double kRounding = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
    return ranks.max(farthest) * kRounding <= kMovedMost * ranks.min(smallest);
}

template <class Real>
std::vector<Real> points_of(const Source& from, const Vec3& origin) {
    std::vector<Real> points;
    points.reserve(3 * from.surfaces.points);
    for (const std::size_t i : from.surfaces.body) {
        const Mat3 turn = from.bodies.orientation[i].toRotationMatrix();
        const Vec3 centre = from.bodies.position[i] + origin;
        for (const Vec3& vertex : from.shape(i).vertex) {
            const Vec3 x = turn * vertex + centre;
            for (int k = 0; k < 3; ++k) points.push_back(static_cast<Real>(x[k]));
        }
    }
    return points;
}

// `first`: row of this rank's first point.
template <class Index>
std::vector<Index> cells_of(const Source& from, std::uint64_t first) {
    std::vector<Index> cells;
    for (const std::size_t i : from.surfaces.body) {
        const ConvexShape& shape = from.shape(i);
        for (std::size_t f = 0; f < shape.face.size(); ++f) {
            cells.push_back(static_cast<Index>(kPolygon));
            cells.push_back(static_cast<Index>(shape.face[f].count));
            for (const std::uint32_t corner : shape.corners(f)) cells.push_back(static_cast<Index>(first + corner));
        }
        first += shape.vertex.size();
    }
    return cells;
}

std::vector<std::int64_t> body_rows(const Source& from, std::uint64_t first) {
    std::vector<std::int64_t> rows;
    rows.reserve(from.surfaces.faces);
    for (const std::size_t i : from.surfaces.body)
        rows.insert(rows.end(), from.shape(i).face.size(), static_cast<std::int64_t>(first + i));
    return rows;
}

template <class Real>
void write_points(SharedFile& file, const std::vector<Real>& points, const Layout& layout) {
    Rows rows = rows_of(std::span<const Real>(points));
    rows.count = points.size() / 3;
    rows.shape = {3};
    file.rows("mesh/points", rows, {"m", "vertices of polyhedra, body after body", "world"}, layout);
}

template <class Index>
void write_cells(SharedFile& file, const std::vector<Index>& cells, const Layout& layout) {
    file.rows("mesh/cells", rows_of(std::span<const Index>(cells)),
              {"1", "faces of polyhedra: 3 (a polygon), number of corners, rows of mesh/points"}, layout);
}

}  // namespace

void write_body_mesh(SharedFile& file, const Bodies& bodies, const std::vector<ConvexShape>& shapes, const Vec3& origin,
                     const Layout& layout) {
    const Communicator& ranks = file.ranks();
    const Surfaces surfaces(bodies, shapes);
    const Source from{bodies, shapes, surfaces};
    if (single_precision_is_enough(from, origin, ranks)) {
        write_points(file, points_of<float>(from, origin), layout);
    } else {
        write_points(file, points_of<double>(from, origin), layout);
    }
    const std::uint64_t first = ranks.sum_before(surfaces.points);
    if (ranks.sum(surfaces.points) <= std::numeric_limits<std::int32_t>::max()) {
        write_cells(file, cells_of<std::int32_t>(from, first), layout);
    } else {
        write_cells(file, cells_of<std::int64_t>(from, first), layout);
    }
    const std::vector<std::int64_t> rows = body_rows(from, ranks.sum_before(bodies.size()));
    file.rows("mesh/body", rows_of(rows), {"1", "of each face: row of /bodies"}, layout);
}

}  // namespace scree::io
