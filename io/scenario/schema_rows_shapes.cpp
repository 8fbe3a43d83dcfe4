// Rows of the schema table: shapes, and the generators that make many polyhedra at once.
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

std::vector<Row> blocks() {
    std::vector<Row> rows{
        variant("bodies[voronoi]")
            .says("A box filled with the Voronoi cells of random points: grains that fit without gaps."),
        section("bodies[voronoi].region").required().like("REGION", {"box"}).says("The box."),
        integer("bodies[voronoi].count")
            .in(between(1, 1e7))
            .or_else("`cell_size` says how many")
            .says("Number of cells."),
        number("bodies[voronoi].cell_size", length)
            .in(kPositive)
            .or_else("`count` says how many")
            .says("Mean size of a cell: diameter of the ball of equal volume."),

        variant("bodies[rock_mass]")
            .says("A convex part of rock, cut through by sets of parallel joints into blocks that fill it. x is east, "
                  "y north, z up."),
        section("bodies[rock_mass].region")
            .like("REGION", {"box"})
            .or_else("`points` say it")
            .says("The rock before it is cut, as a box."),
        table("bodies[rock_mass].points", {{"x", length, {}}, {"y", length, {}}, {"z", length, {}}})
            .or_else("`region` says it")
            .says("The rock before it is cut, as the convex hull of these points: a slope, for instance."),
        list("bodies[rock_mass].joints").says("The joint sets; every joint runs through the whole mass."),
        number("bodies[rock_mass].joints[].dip", angle)
            .required()
            .in(between(0, 1.5707963267948966))
            .says("Angle of steepest descent below the horizontal: 0 bedding that lies flat, 90 deg upright."),
        number("bodies[rock_mass].joints[].dip_direction", angle)
            .standardly("0")
            .says("Azimuth of the steepest descent, clockwise from north: 90 deg falls to the east."),
        number("bodies[rock_mass].joints[].spacing", length)
            .required()
            .in(kPositive)
            .says("Mean distance between neighbours, along their normal. The number of blocks grows with its third "
                  "inverse power if all sets have it."),
        number("bodies[rock_mass].joints[].spacing_scatter")
            .standardly("0")
            .in(between(0, 0.99))
            .says("Distances are uniform in spacing (1 +- this)."),
        number("bodies[rock_mass].joints[].angle_scatter", angle)
            .standardly("0")
            .in(between(0, 0.3))
            .says("Standard deviation of the normal's direction. Above 0 joints of one set may cross, which makes thin "
                  "wedges."),

        variant("bodies[hulls]")
            .says("Blocks from a text file of points, x y z a line; an empty line ends a block, `#` begins a comment. "
                  "Each is the convex hull of its points, where they are."),
        text("bodies[hulls].path")
            .required()
            .naming_file()
            .says("The file; a relative path starts at the folder of the scenario that names it."),
        number("bodies[hulls].scale")
            .standardly("1")
            .in(kPositive)
            .says("Multiplies the points: 0.001 reads millimetres."),
        vector("bodies[hulls].offset", length).standardly("[0, 0, 0]").says("Added to each point, after `scale`."),

        variant("bodies[wall_of_blocks]").says("A wall of equal blocks in courses."),
        vector("bodies[wall_of_blocks].corner", length)
            .required()
            .says("The lower corner that the wall extends from: along `direction`, to the left of it, and up."),
        direction("bodies[wall_of_blocks].direction")
            .standardly("[1, 0, 0]")
            .says("Along the wall; the part along `up` is dropped."),
        direction("bodies[wall_of_blocks].up").standardly("[0, 0, 1]").says("From course to course."),
        integer("bodies[wall_of_blocks].rows").required().in(between(1, 1e6)).says("Number of courses."),
        integer("bodies[wall_of_blocks].columns").required().in(between(1, 1e6)).says("Number of blocks in a course."),
        vector("bodies[wall_of_blocks].size", length)
            .required()
            .says("A block: length along the wall, thickness across it, height."),
        choice("bodies[wall_of_blocks].bond", {"running", "stack"})
            .standardly("running")
            .says("`running`: every second course is shifted by half a block and ends in two half blocks, so that the "
                  "ends are flush. `stack`: blocks straight above each other."),

        variant("bodies[arch]")
            .says("A round arch of equal voussoirs with radial joints. Inner and outer faces are flat, between corners "
                  "on the two circles."),
        vector("bodies[arch].centre", length).required().says("Centre of the circle, in the middle of the depth."),
        direction("bodies[arch].direction")
            .standardly("[1, 0, 0]")
            .says("Across the opening; bodies count up this way. The part along `up` is dropped."),
        direction("bodies[arch].up").standardly("[0, 0, 1]").says("From the centre to the crown."),
        integer("bodies[arch].count").required().in(between(1, 10000)).says("Number of voussoirs."),
        number("bodies[arch].radius", length).required().in(kPositive).says("Radius of the line midway through it."),
        number("bodies[arch].thickness", length)
            .required()
            .in(kPositive)
            .says("Length of the joints, along the radius. A semicircle falls below about 0.107 of the radius."),
        number("bodies[arch].depth", length).required().in(kPositive).says("Along the axis."),
        number("bodies[arch].embrace", angle)
            .standardly("180 deg")
            .in({0.0, 6.283185307179586, true})
            .says("Angle between the first and the last joint: 180 deg is a semicircle."),
    };
    for (const char* generator : {"voronoi", "rock_mass", "wall_of_blocks"}) {
        rows.push_back(number(std::string("bodies[") + generator + "].gap", length)
                           .standardly("0")
                           .in(kNotNegative)
                           .says("Distance between neighbours at the start. 0: they touch."));
    }
    for (const char* generator : {"voronoi", "rock_mass"}) {
        rows.push_back(
            number(std::string("bodies[") + generator + "].smallest", length)
                .standardly("0")
                .in(kNotNegative)
                .says("Blocks whose ball of equal volume has a smaller diameter are left out: slivers, which "
                      "would ask for a finer step than all others."));
    }
    for (const char* generator : {"voronoi", "rock_mass", "hulls", "wall_of_blocks", "arch"}) {
        const std::string path = std::string("bodies[") + generator + "].";
        rows.push_back(text(path + "material").required().naming("materials").says("Their material."));
        rows.push_back(vector(path + "velocity", velocity).standardly("[0, 0, 0]").says("Velocity at time 0."));
        rows.push_back(vector(path + "spin", angular_velocity)
                           .standardly("[0, 0, 0]")
                           .says("Angular velocity at time 0, of each body about its own centre of mass."));
    }
    return rows;
}

}  // namespace scree::io::rows
