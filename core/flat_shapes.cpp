#include "core/flat_shapes.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace scree {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

void require(bool sound) {
    if (!sound) throw IoError("the shapes of the bodies do not fit together");
}

// Walks through flat arrays, shape after shape.
class Cursor {
  public:
    explicit Cursor(const FlatShapes& flat) : flat_(flat) {}

    ConvexShape next(std::size_t s) {
        const std::uint64_t vertices = flat_.vertices[s], faces = flat_.faces[s], corners = flat_.corners[s],
                            edges = flat_.edges[s];
        require(fits(vertex_, vertices, flat_.vertex.size()) && fits(face_, faces, flat_.sides.size()) &&
                fits(corner_, corners, flat_.corner.size()) && fits(edge_, edges, flat_.from.size()));
        ConvexShape shape;
        const auto part = [](const auto& all, std::uint64_t begin, std::uint64_t count) {
            const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
            return std::vector(first, first + static_cast<std::ptrdiff_t>(count));
        };
        shape.vertex = part(flat_.vertex, vertex_, vertices);
        shape.corner = part(flat_.corner, corner_, corners);
        const auto is_vertex = [&](std::uint32_t v) { return v < vertices; };
        require(std::all_of(shape.corner.begin(), shape.corner.end(), is_vertex));
        std::uint64_t begin = 0;
        for (std::uint64_t f = face_; f < face_ + faces; ++f) {
            require(fits(begin, flat_.sides[f], corners));
            shape.face.push_back({flat_.face_normal[f], flat_.face_offset[f], static_cast<std::uint32_t>(begin),
                                  static_cast<std::uint32_t>(flat_.sides[f])});
            begin += flat_.sides[f];
        }
        for (std::uint64_t e = edge_; e < edge_ + edges; ++e) {
            require(is_vertex(flat_.from[e]) && is_vertex(flat_.to[e]) && flat_.left[e] < faces &&
                    flat_.right[e] < faces);
            shape.edge.push_back({flat_.from[e], flat_.to[e], flat_.left[e], flat_.right[e]});
        }
        link_vertices(shape);
        shape.volume = flat_.volume[s];
        shape.inertia = flat_.inertia[s];
        shape.radius = flat_.radius[s];
        shape.inner_radius = flat_.inner_radius[s];
        vertex_ += vertices, face_ += faces, corner_ += corners, edge_ += edges;
        return shape;
    }

  private:
    static bool fits(std::uint64_t begin, std::uint64_t count, std::uint64_t all) {
        return begin <= all && count <= all - begin;
    }

    const FlatShapes& flat_;
    std::uint64_t vertex_ = 0, face_ = 0, corner_ = 0, edge_ = 0;
};

}  // namespace

FlatShapes flatten(const std::vector<ConvexShape>& shapes) {
    FlatShapes flat;
    for (const ConvexShape& shape : shapes) {
        flat.vertices.push_back(shape.vertex.size());
        flat.faces.push_back(shape.face.size());
        flat.corners.push_back(shape.corner.size());
        flat.edges.push_back(shape.edge.size());
        flat.volume.push_back(shape.volume);
        flat.radius.push_back(shape.radius);
        flat.inner_radius.push_back(shape.inner_radius);
        flat.inertia.push_back(shape.inertia);
        append(flat.vertex, shape.vertex);
        append(flat.corner, shape.corner);
        for (const ConvexShape::Face& face : shape.face) {
            flat.face_normal.push_back(face.normal);
            flat.face_offset.push_back(face.offset);
            flat.sides.push_back(face.count);
        }
        for (const ConvexShape::Edge& edge : shape.edge) {
            flat.from.push_back(edge.from);
            flat.to.push_back(edge.to);
            flat.left.push_back(edge.left);
            flat.right.push_back(edge.right);
        }
    }
    return flat;
}

std::vector<ConvexShape> unflatten(const FlatShapes& flat) {
    const std::size_t n = flat.vertices.size();
    for (const std::size_t size : {flat.faces.size(), flat.corners.size(), flat.edges.size(), flat.volume.size(),
                                   flat.radius.size(), flat.inner_radius.size(), flat.inertia.size()})
        require(size == n);
    require(flat.face_normal.size() == flat.sides.size() && flat.face_offset.size() == flat.sides.size());
    for (const std::size_t size : {flat.to.size(), flat.left.size(), flat.right.size()})
        require(size == flat.from.size());
    std::vector<ConvexShape> shapes;
    Cursor cursor(flat);
    for (std::size_t s = 0; s < n; ++s) shapes.push_back(cursor.next(s));
    return shapes;
}

}  // namespace scree
