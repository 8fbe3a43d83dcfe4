// Rows of the schema table: outlets, inlets and measures.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

std::vector<Row> flows() {
    return {
        list("outlets").says("Regions that take bodies out of the run; their number and mass are kept."),
        text("outlets[].name").required().unique().says("Names the outlet in the history."),
        section("outlets[].region")
            .required()
            .like("REGION")
            .says("A body whose centre is here at the end of a step is taken away. Put it where bodies no longer "
                  "matter: what is taken no longer carries or pushes."),
        number("outlets[].from", Dimension::time).standardly("0").says("When it begins to take."),
        number("outlets[].until", Dimension::time).or_else("it never ends").says("When it stops taking."),

        list("inlets").says("Regions that make bodies at free places while the run goes on."),
        text("inlets[].name").required().unique().says("Names the inlet in the history."),
        text("inlets[].material").required().naming("materials").says("Material of the new bodies."),
        section("inlets[].size").required().like("SIZE").says("Sizes of the new bodies."),
        section("inlets[].region")
            .required()
            .like("REGION", {"box"})
            .says("Where they are made, whole bodies inside. If it is full, the inlet waits, and the rate is not "
                  "reached."),
        number("inlets[].mass_rate", mass_rate).required().in(kPositive).says("Mass made in a second."),
        vector("inlets[].velocity", velocity)
            .standardly("[0, 0, 0]")
            .says("Velocity of a new body. Fast enough to leave the region free for the next ones."),
        number("inlets[].from", Dimension::time).standardly("0").says("When it begins."),
        number("inlets[].until", Dimension::time).or_else("it never ends").says("When it ends."),
        number("inlets[].max_mass", mass)
            .in(kPositive)
            .or_else("no limit")
            .says("It stops when it has made this mass."),
    };
}

std::vector<Row> measures() {
    return {
        list("measures")
            .picked_by("measure")
            .says("What is measured: columns of the history, and means in the summary. They change no result."),
        text("measures[].name").required().unique().says("Name of the measure: the first part of its columns' names."),
        number("measures[].from", Dimension::time)
            .standardly("0")
            .says("Start of the window over which the summary's mean is taken. Leave the start-up out."),
        number("measures[].until", Dimension::time).or_else("the end of the run").says("End of that window."),

        variant("measures[flow_rate]")
            .says("Mass and number of bodies that pass through a plane, by the second and in all."),
        vector("measures[flow_rate].point", length)
            .required()
            .says("A point of the plane; the centre of the disc if there is a `radius`."),
        direction("measures[flow_rate].normal")
            .required()
            .says("The direction that counts as positive; its length does not matter."),
        number("measures[flow_rate].radius", length)
            .in(kPositive)
            .or_else("the whole plane")
            .says("Only within this distance of `point`."),
        variant("measures[mass_in]").says("Mass and number of bodies in a region."),
        section("measures[mass_in].region").required().like("REGION").says("A body counts if its centre is here."),
        variant("measures[wall_force]").says("Force and torque of the bodies on a wall, mean over each step."),
        text("measures[wall_force].wall").required().naming("walls").says("The wall's name."),
        variant("measures[coordination]")
            .says("Contacts that carry an impulse, a body, and the share of bodies with none."),
        section("measures[coordination].region")
            .like("REGION")
            .or_else("all bodies")
            .says("A body counts if its centre is here. Leave layers at walls out for the bulk's value."),
        variant("measures[packing_fraction]")
            .says("Volume of the bodies in a region over the region's volume; bodies are cut at its border."),
        section("measures[packing_fraction].region")
            .required()
            .like("REGION", {"box", "cylinder", "sphere"})
            .says("The region. Keep it a diameter away from walls for the bulk's value."),
        variant("measures[profile]").says("Packing fraction and mean velocity in slices along an axis."),
        section("measures[profile].region")
            .like("REGION")
            .or_else("all bodies")
            .says("Only bodies whose centre is here."),
        direction("measures[profile].axis")
            .standardly("[0, 0, 1]")
            .says("Across the slices; its length does not matter."),
        number("measures[profile].lower", length)
            .required()
            .says("Coordinate along the axis where the first slice begins."),
        number("measures[profile].upper", length).required().says("Coordinate where the last slice ends."),
        integer("measures[profile].bins")
            .required()
            .in(between(1, 10000))
            .says("Number of slices. Slices thinner than a diameter show layers and scatter more."),
        variant("measures[extent]")
            .says("Lowest and highest point of the bodies along an axis, and their centre of mass: fill height, "
                  "run-out."),
        direction("measures[extent].axis").standardly("[0, 0, 1]").says("The axis; its length does not matter."),
        section("measures[extent].region")
            .like("REGION")
            .or_else("all bodies")
            .says("Only bodies whose centre is here: leaves stray ones out."),
    };
}

}  // namespace scree::io::rows
