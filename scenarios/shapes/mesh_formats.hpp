// Readers of the mesh formats: vertices and faces as the file has them, in its units. Normals, colours and the like are
// passed over. A fault is an IoError `path:line: ...` (binary files: without a line). CGAL 5.5 has readers too; they
// say nothing of where a fault is, and the one for PLY crashes on damaged files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/polyhedron.hpp"

namespace scree::scenarios {

struct MeshBytes {
    std::string path, bytes;
};

Polyhedron read_off(const MeshBytes& file);
Polyhedron read_obj(const MeshBytes& file);
Polyhedron read_stl(const MeshBytes& file);  // text or binary; three corners a triangle, equal ones not yet joined
Polyhedron read_ply(const MeshBytes& file);  // text or binary, of either byte order

// By the name's ending; a fault if it is none of these.
Polyhedron parse_mesh(const MeshBytes& file);
// Vertices at the very same place become one: STL repeats them for each triangle, OBJ where normals differ.
void join_equal_vertices(Polyhedron& body);

// Walks through a text word by word.
class MeshText {
  public:
    MeshText(const MeshBytes& file, std::size_t begin = 0) : file_(file), at_(begin) {}

    std::string_view word();          // the next one; a fault at the end of the file
    std::string_view word_of_line();  // empty at the end of the line
    void next_line();                 // passes over the rest of the line
    bool at_end();                    // nothing but blanks and comments is left
    double number(std::string_view what);
    std::int64_t whole(std::string_view what);
    // Faces name vertices [0, vertices).
    std::uint32_t index(std::size_t vertices);
    std::size_t position() const { return at_; }

    [[noreturn]] void fail(const std::string& what) const;
    double as_number(std::string_view word, std::string_view what) const;
    std::int64_t as_whole(std::string_view word, std::string_view what) const;
    std::uint32_t as_index(std::int64_t index, std::size_t vertices) const;
    void comments_begin_with(std::string_view sign) { comment_ = sign; }

  private:
    void skip_blanks(bool lines);

    const MeshBytes& file_;
    std::size_t at_;
    std::string_view comment_;
};

}  // namespace scree::scenarios
