#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;  // bytes: 80 of anything and a count; 12 floats and 2 bytes

// Little-endian, whatever the machine is.
std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
    return word;
}

void add_triangle(Polyhedron& body) {
    const auto n = static_cast<std::uint32_t>(body.vertex.size());
    body.face.push_back({n - 3, n - 2, n - 1});
}

Polyhedron read_binary(const std::string& bytes) {
    Polyhedron body;
    for (std::size_t at = kHeader; at < bytes.size(); at += kTriangle) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Vec3& x = body.vertex.emplace_back();
            for (std::size_t i = 0; i < 3; ++i)
                x[static_cast<int>(i)] = std::bit_cast<float>(word_at(bytes, at + 12 + 12 * corner + 4 * i));
        }
        add_triangle(body);
    }
    return body;
}

void expect(MeshText& text, std::string_view word) {
    const std::string_view found = text.word();
    if (found != word) text.fail(fmt::format("'{:.40}' where '{}' is expected", found, word));
}

Polyhedron read_text(const MeshBytes& file) {
    MeshText text(file);
    expect(text, "solid");
    text.next_line();
    Polyhedron body;
    for (;;) {
        const std::string_view word = text.word();
        if (word == "endsolid") return body;
        if (word != "facet") text.fail(fmt::format("'{:.40}' where 'facet' or 'endsolid' is expected", word));
        expect(text, "normal");
        for (int i = 0; i < 3; ++i) text.word();  // not used: the order of the corners tells
        expect(text, "outer");
        expect(text, "loop");
        for (int corner = 0; corner < 3; ++corner) {
            expect(text, "vertex");
            Vec3& x = body.vertex.emplace_back();
            for (int i = 0; i < 3; ++i) x[i] = text.number("a coordinate");
        }
        expect(text, "endloop");
        expect(text, "endfacet");
        add_triangle(body);
    }
}

}  // namespace

// Binary files may begin with the word solid, too: their length tells.
Polyhedron read_stl(const MeshBytes& file) {
    const std::string& bytes = file.bytes;
    if (bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * word_at(bytes, 80)) return read_binary(bytes);
    if (bytes.find("solid") < std::min<std::size_t>(80, bytes.find_first_not_of(" \t\r\n") + 1)) return read_text(file);
    if (bytes.size() < kHeader)
        throw IoError(fmt::format("{}: {} bytes are too few for a binary STL file, and one of text begins with 'solid'",
                                  file.path, bytes.size()));
    throw IoError(
        fmt::format("{}: a binary STL file of {} triangles has {} bytes, but there are {}; one of text begins with "
                    "'solid'",
                    file.path, word_at(bytes, 80), kHeader + kTriangle * word_at(bytes, 80), bytes.size()));
}

}  // namespace scree::scenarios
