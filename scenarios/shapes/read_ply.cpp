#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

enum class Kind { whole, natural, real };  // signed, unsigned, floating point
struct Type {
    Kind kind;
    std::size_t bytes;
};
struct Property {
    std::string name;
    std::optional<Type> count;  // of a list
    Type type;
};
struct Element {
    std::string name;
    std::int64_t count;
    std::vector<Property> properties;
};
enum class Format { text, little, big };
struct Header {
    Format format = Format::text;
    std::vector<Element> elements;
};

Type type_named(std::string_view name, const MeshText& text) {
    struct Named {
        std::string_view name, other;
        Type type;
    };
    constexpr std::array<Named, 8> kTypes = {{{"char", "int8", {Kind::whole, 1}},
                                              {"uchar", "uint8", {Kind::natural, 1}},
                                              {"short", "int16", {Kind::whole, 2}},
                                              {"ushort", "uint16", {Kind::natural, 2}},
                                              {"int", "int32", {Kind::whole, 4}},
                                              {"uint", "uint32", {Kind::natural, 4}},
                                              {"float", "float32", {Kind::real, 4}},
                                              {"double", "float64", {Kind::real, 8}}}};
    for (const Named& known : kTypes)
        if (name == known.name || name == known.other) return known.type;
    text.fail(fmt::format("'{:.40}' where a type is expected (float, int, uchar, ...)", name));
}

Header read_header(MeshText& text) {
    if (text.at_end() || text.word() != "ply") text.fail("the word ply is expected first");
    Header header;
    for (;;) {
        const std::string_view what = text.word();
        if (what == "format") {
            const std::string_view name = text.word();
            if (name == "ascii")
                header.format = Format::text;
            else if (name == "binary_little_endian")
                header.format = Format::little;
            else if (name == "binary_big_endian")
                header.format = Format::big;
            else
                text.fail(
                    fmt::format("'{:.40}' where ascii, binary_little_endian or binary_big_endian is expected", name));
        } else if (what == "element") {
            const std::string name(text.word());
            header.elements.push_back({name, text.whole("a number of elements"), {}});
        } else if (what == "property") {
            if (header.elements.empty()) text.fail("a property before the first element");
            Property property{};
            std::string_view type = text.word();
            if (type == "list") {
                property.count = type_named(text.word(), text);
                type = text.word();
            }
            property.type = type_named(type, text);
            property.name = text.word();
            header.elements.back().properties.push_back(property);
        } else if (what == "end_header") {
            text.next_line();
            return header;
        } else if (what != "comment" && what != "obj_info") {
            text.fail(fmt::format("'{:.40}' is not a line of a PLY header", what));
        }
        text.next_line();
    }
}

// Numbers one after the other, whatever they are written in.
class Values {
  public:
    Values(const MeshBytes& file, const MeshText& text, Format format)
        : file_(file), text_(text), format_(format), at_(text.position()) {}

    double next(Type type, std::string_view what) {
        if (format_ == Format::text) return text_.number(what);
        if (file_.bytes.size() - at_ < type.bytes) throw IoError(file_.path + ": the file ends too early");
        std::uint64_t bits = 0;
        for (std::size_t k = 0; k < type.bytes; ++k) {
            const std::size_t place = format_ == Format::little ? k : type.bytes - 1 - k;
            bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(file_.bytes[at_ + k])) << (8 * place);
        }
        at_ += type.bytes;
        if (type.kind == Kind::real)
            return type.bytes == 8 ? std::bit_cast<double>(bits)
                                   : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        const std::size_t unused = 64 - 8 * type.bytes;
        if (type.kind == Kind::natural) return static_cast<double>(bits);
        return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
    }
    std::int64_t next_whole(Type type, std::string_view what) {
        const double x = next(type, what);
        if (!(std::abs(x) <= 0x1p53) || x != std::floor(x))
            fail(fmt::format("{:g} where {} is expected, a whole number", x, what));
        return static_cast<std::int64_t>(x);
    }
    [[noreturn]] void fail(const std::string& what) const {
        if (format_ == Format::text) text_.fail(what);
        throw IoError(fmt::format("{}: {}", file_.path, what));
    }

  private:
    const MeshBytes& file_;
    MeshText text_;
    Format format_;
    std::size_t at_;
};

void read_vertex(const Element& element, Values& values, Polyhedron& body) {
    Vec3& x = body.vertex.emplace_back(Vec3::Zero());
    for (const Property& property : element.properties) {
        std::int64_t count = 1;
        if (property.count) count = values.next_whole(*property.count, "the length of a list");
        for (std::int64_t k = 0; k < count; ++k) {
            const double value = values.next(property.type, "a coordinate");
            if (!property.count && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
                x[property.name[0] - 'x'] = value;
        }
    }
}

void read_face(const Element& element, Values& values, Polyhedron& body) {
    for (const Property& property : element.properties) {
        const bool corners = property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (corners) body.face.emplace_back();
        std::int64_t count = 1;
        if (property.count) count = values.next_whole(*property.count, "the length of a list");
        for (std::int64_t k = 0; k < count; ++k) {
            if (!corners) {
                values.next(property.type, "a number of a face");
                continue;
            }
            const std::int64_t v = values.next_whole(property.type, "a vertex of a face");
            if (v < 0 || static_cast<std::uint64_t>(v) >= body.vertex.size())
                values.fail(fmt::format("a face names vertex {}, counted from 0; there are {}", v, body.vertex.size()));
            body.face.back().push_back(static_cast<std::uint32_t>(v));
        }
    }
}

}  // namespace

Polyhedron read_ply(const MeshBytes& file) {
    MeshText text(file);
    const Header header = read_header(text);
    Values values(file, text, header.format);
    Polyhedron body, other;
    for (const Element& element : header.elements)
        for (std::int64_t k = 0; k < element.count && !element.properties.empty(); ++k) {
            if (element.name == "vertex") {
                read_vertex(element, values, body);
            } else if (element.name == "face") {
                read_face(element, values, body);
            } else {
                read_vertex(element, values, other);
                other.vertex.clear();
            }
        }
    return body;
}

}  // namespace scree::scenarios
