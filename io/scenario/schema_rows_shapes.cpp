// Rows of the schema table: shapes.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {
namespace {

// A size in place of the one that the form's own keys give.
void add_sizes(std::vector<Row>& rows, const char* kind, const char* otherwise) {
    const std::string path = std::string("shapes[") + kind + "].";
    rows.push_back(number(path + "diameter", length)
                       .in(kPositive)
                       .or_else(otherwise)
                       .says("Diameter of the ball of equal volume: the usual size of a grain. The proportions stay."));
    rows.push_back(number(path + "volume", Dimension::volume)
                       .in(kPositive)
                       .or_else(otherwise)
                       .says("Its volume; with the density it gives the mass. The proportions stay."));
}

}  // namespace

std::vector<Row> shapes() {
    std::vector<Row> rows{
        list("shapes").picked_by("kind").says(
            "Convex polyhedra by name, for bodies to take. All bodies of one shape and size share it in memory."),
        text("shapes[].name").required().unique().says("The name that bodies take it by."),

        variant("shapes[box]").says("A box with edges along x, y, z of its own frame."),
        row(Kind::number_or_vector, "shapes[box].size", length)
            .required()
            .in(kPositive)
            .says("Lengths of its edges: three numbers, or one for a cube."),
        variant("shapes[prism]").says("A regular prism along z of its own frame, with one corner on the x axis."),
        integer("shapes[prism].sides").required().in(between(3, 1000)).says("Number of its side faces."),
        number("shapes[prism].radius", length)
            .required()
            .in(kPositive)
            .says("Radius of the circle through the corners of its section."),
        number("shapes[prism].height", length).required().in(kPositive).says("Length along z."),
    };
    add_sizes(rows, "box", "`size` holds");
    add_sizes(rows, "prism", "`radius` and `height` hold");

    for (const auto& [kind, faces] : {std::pair{"tetrahedron", "4 triangles"},
                                      {"octahedron", "8 triangles"},
                                      {"dodecahedron", "12 pentagons"},
                                      {"icosahedron", "20 triangles"}}) {
        const std::string path = std::string("shapes[") + kind + "]";
        rows.push_back(variant(path).says(std::string("The regular solid of ") + faces + "."));
        rows.push_back(number(path + ".edge", length)
                           .in(kPositive)
                           .or_else("`diameter` or `volume` says the size")
                           .says("Length of its edges."));
        add_sizes(rows, kind, "another key says the size");
    }

    const std::vector<Row> more{
        variant("shapes[eota]")
            .says("The block that rockfall barriers are tested with (ETAG 027): a cube with its edges cut off, or one "
                  "drawn out in one or two directions."),
        choice("shapes[eota].form", {"EOTA111", "EOTA211", "EOTA221"})
            .standardly("EOTA111")
            .says("Its proportions: the cube 1:1:1, the long 2:1:1, or the plate 2:2:1, which runs out like a wheel."),
        number("shapes[eota].length", length)
            .in(kPositive)
            .or_else("`diameter` or `volume` says the size")
            .says("Its longest side."),

        variant("shapes[rock]").says("Random rocks: hulls of points spread over an ellipsoid."),
        integer("shapes[rock].points")
            .standardly("12")
            .in(between(6, 1000))
            .says("Number of corners: 8 to 15 angular, 100 well rounded. The cost of a contact grows with it."),
        number("shapes[rock].elongation")
            .standardly("0.8")
            .in({0.0, 1.0, true})
            .says("Breadth over length, met exactly. 1: equant; small: rods."),
        number("shapes[rock].flatness")
            .standardly("0.8")
            .in({0.0, 1.0, true})
            .says("Thickness over breadth, met exactly. Small: plates."),
        integer("shapes[rock].variants")
            .standardly("1")
            .in(between(1, 100000))
            .says("How many different rocks of this form the name stands for. Bodies take one of them at random; it is "
                  "picked by `seed`, the rocks by `seed` and the name."),
        number("shapes[rock].length", length)
            .in(kPositive)
            .or_else("`diameter` or `volume` says the size")
            .says("Longest side of the box around it."),

        variant("shapes[hull]").says("The convex hull of points."),
        table("shapes[hull].points", {{"x", length, {}}, {"y", length, {}}, {"z", length, {}}})
            .required()
            .says("The points, at least 4 that are not in one plane. Those inside the hull are left out."),
        number("shapes[hull].scale").standardly("1").in(kPositive).says("Multiplies the points."),

        variant("shapes[file]").says("A shape from a mesh file: OFF, OBJ, STL or PLY, told by the end of its name."),
        text("shapes[file].path")
            .required()
            .naming_file()
            .says("The file; a relative path starts at the folder of the scenario that names it. It must be the closed "
                  "surface of one convex body, faces counter-clockwise seen from outside, unless `hull` is true."),
        number("shapes[file].scale")
            .standardly("1")
            .in(kPositive)
            .says("Metres in one unit of the file: 0.001 reads millimetres."),
        boolean("shapes[file].hull")
            .standardly("false")
            .says("true: take the convex hull of the file's points, whatever their faces are."),
    };
    rows.insert(rows.end(), more.begin(), more.end());
    add_sizes(rows, "eota", "another key says the size");
    add_sizes(rows, "rock", "another key says the size");
    add_sizes(rows, "hull", "`scale` holds");
    add_sizes(rows, "file", "`scale` holds");
    return rows;
}

}  // namespace scree::io::rows
