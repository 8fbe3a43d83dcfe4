// Rows of the schema table: bodies.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

std::vector<Row> bodies() {
    std::vector<Row> rows{
        list("bodies").picked_by("generator").says("What moves. Bodies get their ids in the order of this list."),
        text("bodies[].name")
            .or_else("the generator and its number in the list")
            .unique()
            .says("A name for messages and summaries. Changes no result."),

        variant("bodies[sphere]").says("One sphere."),
        text("bodies[sphere].material")
            .required()
            .naming("materials")
            .says("Its material: density, and the laws of its contacts."),
        vector("bodies[sphere].position", length).required().says("Centre at time 0."),
        number("bodies[sphere].radius", length)
            .in(kPositive)
            .or_else("half of `diameter`")
            .says("Radius; this or `diameter`. Mass grows with its cube."),
        number("bodies[sphere].diameter", length)
            .in(kPositive)
            .or_else("twice `radius`")
            .says("Diameter; this or `radius`."),

        variant("bodies[polyhedron]").says("One polyhedron."),
        text("bodies[polyhedron].shape").required().naming("shapes").says("Its shape."),
        text("bodies[polyhedron].material")
            .required()
            .naming("materials")
            .says("Its material: density, and the laws of its contacts."),
        vector("bodies[polyhedron].position", length)
            .required()
            .says("Where its centre of mass is at time 0; with `placed_by: origin` the origin of its shape's frame."),
        choice("bodies[polyhedron].placed_by", {"centre_of_mass", "origin"})
            .standardly("centre_of_mass")
            .says("The point of the shape that `position` names, and that `orientation` turns it about. `origin`: that "
                  "of the frame in which the shape's points are given, so that position [0, 0, 0] leaves them where "
                  "they are."),
        number("bodies[polyhedron].scale")
            .standardly("1")
            .in(kPositive)
            .says("Makes it so many times as large as its shape."),
        number("bodies[polyhedron].diameter", length)
            .in(kPositive)
            .or_else("the shape's own size, times `scale`")
            .says("Diameter of the ball of equal volume that it shall have."),

        variant("bodies[lattice]")
            .says("Bodies on a grid: x runs fastest, then y, then z. The cheapest way to many bodies; let them fall to "
                  "lose the order."),
        text("bodies[lattice].material").required().naming("materials").says("Their material."),
        section("bodies[lattice].size")
            .or_else("the size of `shape`")
            .like("SIZE")
            .says("Their sizes; needed unless there is a `shape`. Diameters larger than the pitch make neighbours "
                  "overlap, which is an error."),
        vector("bodies[lattice].corner", length).required().says("Centre of the first body, before jitter."),
        row(Kind::number_or_vector, "bodies[lattice].pitch", length)
            .required()
            .in(kPositive)
            .says("Distance between neighbours: one number, or one an axis."),
        listing(Kind::integers, "bodies[lattice].cells", 3)
            .required()
            .in(between(1, 1e9))
            .says("Number of places along x, y and z."),
        choice("bodies[lattice].arrangement", {"cubic", "hexagonal"})
            .standardly("cubic")
            .says("`cubic`: places straight above each other. `hexagonal`: close packing of equal spheres, every "
                  "second row and layer shifted."),
        integer("bodies[lattice].count")
            .in(between(1, 1e12))
            .or_else("every place is filled")
            .says("Stop after so many bodies."),
        number("bodies[lattice].jitter", length)
            .standardly("0")
            .in(kNotNegative)
            .says("Each centre is moved at random by up to this along each axis. A little destroys the crystal as it "
                  "settles."),
        section("bodies[lattice].clip")
            .like("REGION")
            .or_else("the whole grid is used")
            .says("Only places whose centre is in this region are filled."),

        variant("bodies[random]").says("Bodies at random places that do not overlap, put in one after the other."),
        text("bodies[random].material").required().naming("materials").says("Their material."),
        section("bodies[random].size")
            .or_else("the size of `shape`")
            .like("SIZE")
            .says("Their sizes; needed unless there is a `shape`."),
        section("bodies[random].region")
            .required()
            .like("REGION")
            .says("Where they are; whole bodies lie inside, not only centres."),
        integer("bodies[random].count")
            .in(between(1, 1e12))
            .or_else("`mass` or `packing_fraction` says how many")
            .says("Number of bodies."),
        number("bodies[random].mass", mass)
            .in(kPositive)
            .or_else("`count` or `packing_fraction` says how many")
            .says("Bodies are added until their mass reaches this."),
        number("bodies[random].packing_fraction")
            .in({0.0, 0.6, true})
            .or_else("`count` or `mass` says how many")
            .says("Bodies are added until they fill this share of the region. Above 0.3 insertion becomes slow, above "
                  "0.38 it fails for equal spheres."),
        number("bodies[random].gap", length)
            .standardly("0")
            .in(kNotNegative)
            .says("Least distance between surfaces. More: a looser start."),
        integer("bodies[random].attempts")
            .standardly("10000")
            .in(between(1, 1e9))
            .says("Places tried for one body before the run is refused as too dense."),

        variant("bodies[release]")
            .says("Bodies in the place of what was taken from a terrain by its `release`: close packed by the largest "
                  "ball that holds one of them, whole below the former surface. Grains of a released mass are as many "
                  "and as large as asked for here, not those of nature; the solid fraction is at most 0.74 of what "
                  "bodies fill of that ball, less what is lost along the edges."),
        text("bodies[release].wall").required().naming("walls").says("The terrain that has a `release`."),
        text("bodies[release].material").required().naming("materials").says("Their material."),
        section("bodies[release].size")
            .or_else("the size of `shape`")
            .like("SIZE")
            .says("Their sizes; needed unless there is a `shape`. All have the room of the largest: a wide range packs "
                  "loosely."),
        integer("bodies[release].count")
            .in(between(1, 1e12))
            .or_else("every place is filled, or `solid_fraction` holds")
            .says("Number of bodies, from the sliding planes up. More than there are places is an error that says how "
                  "many there are."),
        number("bodies[release].solid_fraction")
            .in({0.0, 0.74, true})
            .or_else("every place is filled, or `count` holds")
            .says("Bodies are added from the sliding planes up until they fill this share of the released volume."),
        number("bodies[release].spheres")
            .standardly("0")
            .in(between(0, 1))
            .says("Each body of a `shape` is with this probability the sphere of the same volume."),
        number("bodies[release].gap", length)
            .standardly("0")
            .in(kNotNegative)
            .says("Added to the distance between places. More: a looser start."),

        variant("bodies[file]")
            .says("Bodies from a text file, one a line, numbers separated by blanks, `#` begins a comment."),
        text("bodies[file].path")
            .required()
            .naming_file()
            .says("The file; a relative path starts at the folder of the scenario that names it."),
        choices("bodies[file].columns", {"x", "y", "z", "r", "d", "vx", "vy", "vz", "wx", "wy", "wz", "qw", "qx", "qy",
                                         "qz", "material", "shape", "skip"})
            .standardly("[x, y, z, r]")
            .says(
                "What the columns hold: position, radius r or diameter d (of polyhedra: of the ball of equal volume), "
                "velocity, angular velocity, orientation as a quaternion, the names of material and shape; `skip` "
                "passes over a column. SI, before `scale`."),
        text("bodies[file].material")
            .naming("materials")
            .or_else("a column says it")
            .says("The material of all; needed unless a column says it."),
        number("bodies[file].scale")
            .standardly("1")
            .in(kPositive)
            .says("Multiplies positions and sizes, not velocities: 0.001 reads millimetres."),
        vector("bodies[file].offset", length).standardly("[0, 0, 0]").says("Added to each position, after `scale`."),
    };
    for (const char* generator : {"lattice", "random", "release", "file"}) {
        const std::string path = std::string("bodies[") + generator + "].";
        rows.push_back(text(path + "shape")
                           .naming("shapes")
                           .or_else(path == "bodies[file]." ? "a column says it, or they are spheres" : "spheres")
                           .says("Their shape. Sizes are then diameters of the ball of equal volume."));
    }
    for (const char* generator : {"polyhedron", "lattice", "random", "release", "file"}) {
        rows.push_back(section(std::string("bodies[") + generator + "].orientation")
                           .like("ORIENTATION")
                           .or_else("that of the shape's own frame")
                           .says("How polyhedra are turned about their centres of mass."));
    }
    for (const char* generator : {"lattice", "random", "release"}) {
        rows.push_back(integer(std::string("bodies[") + generator + "].size_classes")
                           .or_else("20")
                           .in(between(1, 10000))
                           .says("Polyhedra get one of so many sizes, evenly spaced in the logarithm over the range of "
                                 "`size`, the nearest to what was drawn. Each is a shape in memory. Not for "
                                 "spheres."));
    }
    for (const char* generator : {"sphere", "polyhedron", "lattice", "random", "release"}) {
        const std::string path = std::string("bodies[") + generator + "].";
        rows.push_back(vector(path + "velocity", velocity).standardly("[0, 0, 0]").says("Velocity at time 0."));
        rows.push_back(vector(path + "spin", angular_velocity)
                           .standardly("[0, 0, 0]")
                           .says("Angular velocity at time 0. Without effect where nothing has friction."));
    }
    return rows;
}

}  // namespace scree::io::rows
