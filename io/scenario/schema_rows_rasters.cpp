// Rows of the schema table: rasters of what flowed over the ground, trajectories of single bodies.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

std::vector<Row> rasters() {
    return {
        section("rasters")
            .or_else("none are kept")
            .says("Keeps what flowed over each cell of a grid seen from above: largest flow depth, height and speed, "
                  "arrival time, and the deposit at the end; written to rasters/ as HDF5 and ESRI grids. The summary "
                  "gets runout, H/L, centres of mass and areas. Changes no result."),
        text("rasters.terrain")
            .naming("walls")
            .or_else("the terrain of the scene, if there is one made of a grid")
            .says("The terrain wall above which heights count, and whose nodes are the centres of the cells unless "
                  "`cell` is given."),
        number("rasters.cell", length)
            .in(kPositive)
            .or_else("that of the terrain's grid")
            .says("Edge of square cells. Cells smaller than bodies show single bodies; flow depth needs cells of a few "
                  "diameters."),
        numbers("rasters.lower", 2, length)
            .or_else("all of the terrain")
            .says("Lowest x and y of what is kept. A cell takes 32 bytes in memory and in checkpoints, shared by the "
                  "ranks."),
        numbers("rasters.upper", 2, length).or_else("all of the terrain").says("Largest x and y of what is kept."),
        number("rasters.level", length).standardly("0").says("Height of level ground, in a scene without terrain."),
        number("rasters.interval", Dimension::time)
            .in(kPositive)
            .or_else("every tenth step")
            .says("Simulated time between samples. A front that passes a cell between two of them leaves no trace in "
                  "it; each sample costs about as much as finding where the bodies are."),
        number("rasters.solid_fraction")
            .standardly("1")
            .in(Range{0.0, 1.0, true})
            .says("Share of the flow that is body and not pore: flow depth is the volume of the bodies over a cell, "
                  "divided by the area of the cell and by this. 1: depth of the solid alone; about 0.6: as "
                  "depth-averaged models give it."),
        boolean("rasters.at_snapshots")
            .standardly("false")
            .says("Write the rasters as they stand with each snapshot too, as rasters/NNNNNN.h5: `deposit` is then the "
                  "flow depth at that time."),
        number("rasters.covered", length)
            .standardly("0")
            .in(kNotNegative)
            .says("Flow depth above which a cell counts as covered: for arrival, the area of the deposit, and its "
                  "farthest point. Above the depth of scattered blocks, the runout is that of the mass."),
    };
}

std::vector<Row> trajectories() {
    return {
        section("trajectories")
            .or_else("no body is followed")
            .says("Follows single bodies: position, velocity, spin and orientation (where the scene has them) in "
                  "trajectories.h5. Changes no result."),
        listing(Kind::integers, "trajectories.ids", 0)
            .in(from(0))
            .or_else("by `count`")
            .says("Ids of the bodies to follow."),
        integer("trajectories.count")
            .in(between(1, 100000))
            .or_else("by `ids`")
            .says("Follows so many bodies, spread evenly over the ids of those that are there at the start."),
        number("trajectories.interval", Dimension::time)
            .standardly("0")
            .in(kNotNegative)
            .says("Simulated time between rows. 0: every step."),
    };
}

}  // namespace scree::io::rows
