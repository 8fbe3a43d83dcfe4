// Rows of the schema table: walls and their motion.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

std::vector<Row> walls() {
    const std::vector<std::string> sides{"inside", "outside"};
    return {
        list("walls").picked_by("shape").says("Exact surfaces, fixed or with a given motion; bodies do not move them."),
        text("walls[].name").required().unique().says("Names the wall in measures, messages and output."),
        text("walls[].material")
            .required()
            .naming("materials")
            .says("Its material, for friction and restitution against bodies."),
        number("walls[].appears", Dimension::time)
            .standardly("0")
            .says("The time from which it is there. A wall that appears inside bodies pushes them out."),
        number("walls[].goes", Dimension::time)
            .or_else("it stays")
            .says("The time at which it is taken away: the way to open an outlet or lift a gate at once."),

        variant("walls[plane]").says("An infinite plane; bodies stay on the side that the normal points to."),
        vector("walls[plane].point", length).required().says("A point of the plane."),
        direction("walls[plane].normal")
            .required()
            .says("Points to the bodies; its length does not matter. The other way round, bodies fall for ever."),
        variant("walls[box]").says("The faces of a box with edges along the axes."),
        vector("walls[box].lower", length).required().says("The corner with the smallest coordinates."),
        vector("walls[box].upper", length).required().says("The opposite corner."),
        choice("walls[box].keeps", sides)
            .standardly("inside")
            .says("Where bodies are kept: `inside` a container, or `outside` a block."),
        boolean("walls[box].open_top")
            .standardly("false")
            .says("Leave out the face at the largest z. Only for `keeps: inside`."),
        boolean("walls[box].open_bottom")
            .standardly("false")
            .says("Leave out the face at the smallest z. Only for `keeps: inside`."),
        variant("walls[cylinder]")
            .says("The curved surface of a cylinder. Inside it has no ends: add a plane, a disc or a floor."),
        vector("walls[cylinder].base", length).required().says("Centre of one end."),
        direction("walls[cylinder].axis")
            .standardly("[0, 0, 1]")
            .says("Direction from that end to the other; its length does not matter."),
        number("walls[cylinder].radius", length)
            .required()
            .in(kPositive)
            .says("Radius. A container narrower than about ten bodies feels its wall throughout."),
        number("walls[cylinder].length", length)
            .in(kPositive)
            .or_else("infinite")
            .says("Distance between the ends. Bodies above it are not held."),
        choice("walls[cylinder].keeps", sides)
            .standardly("inside")
            .says("Where bodies are kept: `inside` a silo, or `outside` a pillar."),
        variant("walls[cone]").says("The curved surface of a cone or frustum: a hopper or a funnel. It has no ends."),
        vector("walls[cone].base", length).required().says("Centre of the end with `radius_base`."),
        direction("walls[cone].axis")
            .standardly("[0, 0, 1]")
            .says("Direction from the base to the other end; its length does not matter."),
        number("walls[cone].radius_base", length)
            .required()
            .in(kNotNegative)
            .says("Radius at the base. As the outlet of a hopper it sets the flow rate (about to the power of 2.5) and "
                  "whether it clogs."),
        number("walls[cone].radius_end", length).required().in(kNotNegative).says("Radius at the other end."),
        number("walls[cone].length", length)
            .required()
            .in(kPositive)
            .says("Distance between the ends; with the radii it sets the slope."),
        choice("walls[cone].keeps", sides)
            .standardly("inside")
            .says("Where bodies are kept: `inside` a hopper, or `outside` a spike."),
        variant("walls[disc]").says("A thin round plate that acts on both sides."),
        vector("walls[disc].centre", length).required().says("Centre."),
        direction("walls[disc].normal")
            .standardly("[0, 0, 1]")
            .says("Across the plate; length and sign do not matter."),
        number("walls[disc].radius", length).required().in(kPositive).says("Radius."),
        variant("walls[orifice_floor]").says("An infinite thin plane with a round hole; acts on both sides."),
        vector("walls[orifice_floor].centre", length).required().says("Centre of the hole."),
        direction("walls[orifice_floor].normal")
            .standardly("[0, 0, 1]")
            .says("Across the plane; length and sign do not matter."),
        number("walls[orifice_floor].hole_diameter", length)
            .required()
            .in(kPositive)
            .says("Diameter of the hole. The flow rate grows about to its power of 2.5; below five bodies it clogs."),
        variant("walls[slot_floor]").says("An infinite thin plane with a rectangular hole; acts on both sides."),
        vector("walls[slot_floor].centre", length).required().says("Centre of the slot."),
        direction("walls[slot_floor].normal")
            .standardly("[0, 0, 1]")
            .says("Across the plane; length and sign do not matter."),
        direction("walls[slot_floor].along")
            .standardly("[1, 0, 0]")
            .says("Along the slot; the part across the plane is dropped."),
        number("walls[slot_floor].width", length)
            .required()
            .in(kPositive)
            .says("Width of the slot. The flow rate by length grows about to its power of 1.5."),
        number("walls[slot_floor].length", length).in(kPositive).or_else("infinite").says("Length of the slot."),
        variant("walls[terrain]")
            .says("A surface of triangles from a file: ground that bodies stay above, or any other that they stay on "
                  "the outer side of. It does not move. A grid of heights is solid below: nothing gets through it. A "
                  "mesh is a sheet."),
        text("walls[terrain].path")
            .required()
            .naming_file()
            .says("The file: heights in ESRI's ASCII format (.asc, packed .asc.gz), or a mesh (.off, .obj, .stl, .ply) "
                  "whose faces are counter-clockwise seen from the bodies' side. A relative path starts at the folder "
                  "of the scenario that names it."),
        choice("walls[terrain].border", {"open", "closed"})
            .standardly("open")
            .says("What is at the border and around holes. `open`: bodies leave over the edge and fall; the ground has "
                  "upright sides, which are felt from outside, as far below its lowest point as it is wide. `closed`: "
                  "upright walls that keep bodies inside, as far above its highest point as it is wide."),
        number("walls[terrain].scale")
            .standardly("1")
            .in(kPositive)
            .says("Multiplies coordinates and heights: 0.001 reads millimetres."),
        vector("walls[terrain].offset", length).standardly("[0, 0, 0]").says("Added to each position, after `scale`."),
        numbers("walls[terrain].cell", 2, length)
            .in(kPositive)
            .or_else("the file says it")
            .says("Grids: distance between nodes along x and y in place of the file's, for a grid in degrees. The "
                  "file's corner is then left aside: the lower left node is at `offset`."),
        numbers("walls[terrain].crop", 4)
            .or_else("all is used")
            .says("Grids: only nodes within [x0, y0, x1, y1], in the coordinates of the file, before `scale` and "
                  "`cell`."),
        integer("walls[terrain].stride")
            .or_else("1")
            .in(between(1, 1e6))
            .says("Grids: only every so many-th node along x and y is used, from the lower left on. Memory and detail "
                  "go down with its square; a node takes about 0.5 kB on each rank."),
        number("walls[terrain].fill_nodata", length)
            .or_else("nodes without data are holes")
            .says("Grids: height of nodes without data, before `offset`. Holes are treated as the border is."),
        text("walls[terrain].checksum")
            .or_else("any file is taken")
            .says(
                "Checksum of the file's bytes: another file is refused. A run writes it into its resolved scenario, so "
                "that it goes on with the terrain that it began with."),
        list("walls[terrain].zones")
            .says("Parts of the surface with another material, each within a polygon seen from above. Later ones lie "
                  "over earlier ones; a triangle belongs to the zone that its middle lies in."),
        text("walls[terrain].zones[].material").required().naming("materials").says("The material of this part."),
        table("walls[terrain].zones[].polygon", {{"x", length, {}}, {"y", length, {}}})
            .required()
            .says("Its corners in order, in the coordinates of the scenario: three or more; the last is joined to the "
                  "first."),

        section("walls[terrain].release")
            .or_else("the ground stays as the file has it")
            .says("Grids: what slides. Within a perimeter the ground is lowered to sliding planes where it lies above "
                  "them; the generator `release` puts bodies in its place. `scree check` tells its volume."),
        table("walls[terrain].release.perimeter", {{"x", length, {}}, {"y", length, {}}})
            .required()
            .says("Corners of the perimeter in order, in the coordinates of the scenario: three or more; the last is "
                  "joined to the first. A node is within or outside as a whole, so the scar's edge is stepped by a "
                  "cell."),
        list("walls[terrain].release.planes").required().says("Sliding planes; the highest one counts at each place."),
        vector("walls[terrain].release.planes[].point", length).required().says("A point of the plane."),
        number("walls[terrain].release.planes[].dip", angle)
            .required()
            .in({0.0, 1.57, false})
            .says("Its steepest slope, from the horizontal."),
        number("walls[terrain].release.planes[].dip_direction", angle)
            .standardly("0")
            .says("Where it falls to, as an azimuth: clockwise from north, which is +y; 90 deg is east, +x."),

        section("walls[].motion")
            .or_else("the wall is fixed")
            .says("A motion given in time: a steady velocity, a sine, a rotation, or all together. Bodies feel the "
                  "surface's velocity."),
        vector("walls[].motion.velocity", velocity)
            .standardly("[0, 0, 0]")
            .says("Steady velocity while the motion lasts."),
        vector("walls[].motion.amplitude", length)
            .standardly("[0, 0, 0]")
            .says("Amplitude of the oscillation, along each axis. Its greatest acceleration is amplitude (2 pi "
                  "frequency)^2; above gravity a vertical one lifts bodies off."),
        number("walls[].motion.frequency", frequency)
            .standardly("0")
            .in(kNotNegative)
            .says("Oscillations a second. Keep at least 20 steps in one."),
        number("walls[].motion.phase", angle)
            .standardly("0")
            .says("Phase of the sine at the start. The wall starts from where it is described in any case."),
        vector("walls[].motion.centre", length).standardly("[0, 0, 0]").says("A point of the axis of rotation."),
        direction("walls[].motion.axis")
            .standardly("[0, 0, 1]")
            .says("Direction of the axis of rotation (right-hand rule); its length does not matter."),
        number("walls[].motion.rate", angular_velocity)
            .standardly("0")
            .says("Angular velocity, \"30 rpm\" too. Negative turns the other way."),
        number("walls[].motion.start", Dimension::time).standardly("0").says("When the motion begins."),
        number("walls[].motion.end", Dimension::time)
            .or_else("it lasts for ever")
            .says("When it ends; the wall then stays where it has come to."),
    };
}

}  // namespace scree::io::rows
