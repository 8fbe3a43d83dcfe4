#include "io/results/xdmf.hpp"

#include <fmt/format.h>

#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

struct NumberType {
    const char* name;
    int bytes;
};

NumberType number_type(ElementType type) {
    switch (type) {
        case ElementType::f64:
            return {"Float", 8};
        case ElementType::f32:
            return {"Float", 4};
        case ElementType::i64:
            return {"Int", 8};
        case ElementType::u64:
            return {"UInt", 8};
        case ElementType::i32:
            return {"Int", 4};
        case ElementType::u32:
            return {"UInt", 4};
        case ElementType::u16:
            return {"UInt", 2};
        case ElementType::u8:
            return {"UChar", 1};
    }
    return {"Float", 8};
}

std::string data_item(const DatasetInfo& data, const std::string& group, const std::string& file) {
    const NumberType number = number_type(data.type);
    return fmt::format(R"(<DataItem Dimensions="{}" NumberType="{}" Precision="{}" Format="HDF">{}:/{}/{}</DataItem>)",
                       fmt::join(data.shape, " "), number.name, number.bytes, escaped(file), group, data.name);
}

// A field of the bodies. XDMF 2 has no attribute of four numbers that ParaView would read: orientations stay in the
// HDF5 file.
struct Field {
    DatasetInfo data;
    std::size_t width;  // 1 or 3

    const char* type() const { return width == 3 ? "Vector" : "Scalar"; }
};
std::vector<Field> fields_of(const Hdf5Group& bodies) {
    std::vector<Field> fields;
    for (const DatasetInfo& data : bodies.datasets()) {
        if (data.name == "position" || data.text || data.shape.empty()) continue;
        const std::size_t width = data.shape.size() == 2 ? data.shape[1] : 1;
        if (width == 1 || width == 3) fields.push_back({data, width});
    }
    return fields;
}

std::string attribute(const Field& field, const char* center, const std::string& item) {
    return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                       escaped(field.data.name), field.type(), center, item);
}

// One vertex a body.
std::string centres(const Hdf5Group& root, const std::string& name, const std::string& file) {
    const Hdf5Group bodies = root.existing_group("bodies");
    const DatasetInfo position = bodies.dataset("position");
    std::string text = fmt::format(
        "      <Grid Name=\"{}\" GridType=\"Uniform\">\n"
        "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n"
        "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        name, position.shape.at(0), data_item(position, "bodies", file));
    for (const Field& field : fields_of(bodies)) {
        text += attribute(field, "Node", data_item(field.data, "bodies", file));
    }
    return text + "      </Grid>\n";
}

// The fields of the bodies on the faces of their surfaces: element [body of the face] of each dataset. A vector's
// components are taken apart and joined again, since $0[$1] counts single numbers.
std::string on_faces(const Field& field, const std::string& file, const std::string& body, std::size_t faces) {
    const std::string all = data_item(field.data, "bodies", file);
    const auto chosen = [&](const std::string& numbers) {
        return fmt::format(R"(<DataItem ItemType="Function" Function="$0[$1]" Dimensions="{}">{}{}</DataItem>)", faces,
                           numbers, body);
    };
    if (field.width == 1) return chosen(all);
    std::string components;
    for (int k = 0; k < 3; ++k) {
        components += chosen(
            fmt::format(R"(<DataItem ItemType="HyperSlab" Dimensions="{0}"><DataItem Dimensions="3 2" Format="XML">)"
                        R"(0 {1} 1 1 {0} 1</DataItem>{2}</DataItem>)",
                        field.data.shape[0], k, all));
    }
    return fmt::format(
        R"x(<DataItem ItemType="Function" Function="JOIN($0 , $1 , $2)" Dimensions="{} 3">{}</DataItem>)x", faces,
        components);
}

std::string surfaces(const Hdf5Group& root, const std::string& file) {
    const Hdf5Group mesh = root.existing_group("mesh");
    const DatasetInfo cells = mesh.dataset("cells"), points = mesh.dataset("points"), body = mesh.dataset("body");
    const std::size_t faces = body.shape.at(0);
    std::string text = fmt::format(
        "      <Grid Name=\"polyhedra\" GridType=\"Uniform\">\n"
        "        <Topology TopologyType=\"Mixed\" NumberOfElements=\"{}\">{}</Topology>\n"
        "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        faces, data_item(cells, "mesh", file), data_item(points, "mesh", file));
    for (const Field& field : fields_of(root.existing_group("bodies"))) {
        text += attribute(field, "Cell", on_faces(field, file, data_item(body, "mesh", file), faces));
    }
    return text + "      </Grid>\n";
}

// The ground of each terrain wall.
std::string terrains(const Hdf5Group& root, const std::string& file) {
    std::string text;
    if (!root.has("terrain")) return text;
    for (const DatasetInfo& triangles : root.datasets()) {
        const std::size_t name = triangles.name.rfind("/triangle");
        if (!triangles.name.starts_with("terrain/") || name == std::string::npos) continue;
        const Hdf5Group group = root.existing_group(triangles.name.substr(0, name));
        const std::string path = group.path().substr(1);
        text += fmt::format(
            "      <Grid Name=\"terrain\" GridType=\"Uniform\">\n"
            "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n"
            "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
            "      </Grid>\n",
            triangles.shape.at(0), data_item(group.dataset("triangle"), path, file),
            data_item(group.dataset("vertex"), path, file));
    }
    return text;
}

}  // namespace

void XdmfSeries::add(const std::string& snapshot, const std::string& relative) {
    const Hdf5File file = Hdf5File::open(snapshot);
    const Hdf5Group& root = file.root();
    const bool has_surfaces = root.has("mesh/body") && root.dataset("mesh/body").shape.at(0) > 0;
    grids_.push_back(
        fmt::format("    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
                    "      <Time Value=\"{}\"/>\n{}{}{}    </Grid>\n",
                    escaped(relative), root.number_attribute("time"),
                    centres(root, root.has("bodies/shape") ? "centres" : "spheres", relative),
                    has_surfaces ? surfaces(root, relative) : "", terrains(root, relative)));
}

void XdmfSeries::write() const {
    std::string text =
        "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
        "<!-- Open with ParaView's \"XDMF Reader\"; show `spheres` as Point Gaussian or as glyphs scaled by radius. "
        "With\n     polyhedra, `polyhedra` are their surfaces and `centres` all bodies: hide them, or show those of "
        "`shape` -1. -->\n"
        "<Xdmf Version=\"2.0\">\n<Domain>\n"
        "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const std::string& grid : grids_) text += grid;
    text += "  </Grid>\n</Domain>\n</Xdmf>\n";
    write_text_atomically(path_, text);
}

}  // namespace scree::io
