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

std::string data_item(const DatasetInfo& data, const std::string& file) {
    const NumberType number = number_type(data.type);
    return fmt::format(
        R"(<DataItem Dimensions="{}" NumberType="{}" Precision="{}" Format="HDF">{}:/bodies/{}</DataItem>)",
        fmt::join(data.shape, " "), number.name, number.bytes, escaped(file), data.name);
}

}  // namespace

void XdmfSeries::add(const std::string& snapshot, const std::string& relative) {
    const Hdf5File file = Hdf5File::open(snapshot);
    const Hdf5Group bodies = file.root().existing_group("bodies");
    const DatasetInfo position = bodies.dataset("position");
    const std::size_t n = position.shape.at(0);
    std::string attributes;
    for (const DatasetInfo& data : bodies.datasets()) {
        if (data.name == "position" || data.text) continue;
        // XDMF 2 has no attribute of four numbers that ParaView would read: orientations stay in the HDF5 file.
        const std::size_t width = data.shape.size() == 2 ? data.shape[1] : 1;
        if (data.shape.empty() || (width != 1 && width != 3)) continue;
        attributes += fmt::format(
            "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n          {}\n"
            "        </Attribute>\n",
            escaped(data.name), width == 3 ? "Vector" : "Scalar", data_item(data, relative));
    }
    grids_.push_back(fmt::format(
        "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
        "      <Time Value=\"{}\"/>\n"
        "      <Grid Name=\"spheres\" GridType=\"Uniform\">\n"
        "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
        "NodesPerElement=\"1\"/>\n"
        "        <Geometry GeometryType=\"XYZ\">\n          {}\n        </Geometry>\n{}"
        "      </Grid>\n    </Grid>\n",
        escaped(relative), file.root().number_attribute("time"), n, data_item(position, relative), attributes));
}

void XdmfSeries::write() const {
    std::string text =
        "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
        "<!-- Open with ParaView's \"XDMF Reader\"; show `spheres` as Point Gaussian or as glyphs scaled by radius. "
        "-->\n"
        "<Xdmf Version=\"2.0\">\n<Domain>\n"
        "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const std::string& grid : grids_) text += grid;
    text += "  </Grid>\n</Domain>\n</Xdmf>\n";
    write_text_atomically(path_, text);
}

}  // namespace scree::io
