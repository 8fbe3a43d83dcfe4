#include <fmt/format.h>

#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {

// OFF, vertices, faces, edges (not used); x y z; corners and their numbers, the rest of the line is colour.
Polyhedron read_off(const MeshBytes& file) {
    MeshText text(file);
    text.comments_begin_with("#");
    if (text.at_end() || text.word() != "OFF")
        text.fail("the word OFF is expected first (variants such as COFF are not read)");
    const std::int64_t vertices = text.whole("the number of vertices"), faces = text.whole("the number of faces");
    text.next_line();
    Polyhedron body;
    for (std::int64_t v = 0; v < vertices; ++v) {
        Vec3& x = body.vertex.emplace_back();
        for (int i = 0; i < 3; ++i) x[i] = text.number("a coordinate");
    }
    for (std::int64_t f = 0; f < faces; ++f) {
        auto& loop = body.face.emplace_back();
        const std::int64_t corners = text.whole("the number of corners of a face");
        for (std::int64_t k = 0; k < corners; ++k) loop.push_back(text.index(body.vertex.size()));
        text.next_line();
    }
    return body;
}

// v x y z and f with vertices counted from 1, or from the last one backwards as -1, -2, ...; what follows a slash is
// texture and normal. Lines with other words are passed over.
Polyhedron read_obj(const MeshBytes& file) {
    MeshText text(file);
    text.comments_begin_with("#");
    Polyhedron body;
    while (!text.at_end()) {
        const std::string_view what = text.word();
        if (what == "v") {
            Vec3& x = body.vertex.emplace_back();
            for (int i = 0; i < 3; ++i) x[i] = text.as_number(text.word_of_line(), "a coordinate");
        } else if (what == "f") {
            auto& loop = body.face.emplace_back();
            for (auto corner = text.word_of_line(); !corner.empty(); corner = text.word_of_line()) {
                const std::int64_t n = text.as_whole(corner.substr(0, corner.find('/')), "a vertex of a face");
                const auto count = static_cast<std::int64_t>(body.vertex.size());
                loop.push_back(text.as_index(n < 0 ? count + n : n - 1, body.vertex.size()));
            }
        }
        text.next_line();
    }
    return body;
}

}  // namespace scree::scenarios
