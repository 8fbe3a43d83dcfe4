// Rows of the schema table: the run as a whole, its solver and its output.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

std::vector<Row> run() {
    return {
        integer("scenario_version")
            .required()
            .in(between(1, 1))
            .says(
                "The version of these keys. It is 1; a later Scree uses it to read old scenarios as they were meant."),
        text("title").standardly("\"\"").says(
            "A line that names the run in the summary and above pictures. Changes no result."),
        text("description")
            .standardly("\"\"")
            .says("What the scenario shows, in as many lines as you like. Changes no result."),
        row(Kind::text_or_texts, "include")
            .or_else("nothing is included")
            .says("A file, or a list of files, whose keys come first and which this file then changes: maps are "
                  "merged, lists and "
                  "values are replaced, later files win over earlier ones and this file over all. Paths start at the "
                  "folder of the "
                  "file that names them."),
        integer("seed").standardly("1").in(from(0)).says(
            "Picks the random numbers of sizes, positions and inlets. Another seed gives another run of the same kind: "
            "the "
            "scatter between seeds is the error bar of a measured quantity. The number of ranks does not change them."),
        vector("origin", length)
            .or_else("chosen near the bodies")
            .says("The local origin. Positions are held relative to it, so that large coordinates of a national grid "
                  "cost no digits; "
                  "every position in this file and in the output stays absolute."),
        vector("gravity", acceleration)
            .standardly("[0, 0, -9.81]")
            .says("Gravity, constant over the run. Its size sets the speed of everything that falls, and the reference "
                  "velocity of "
                  "the residual."),
        table(
            "gravity_table",
            {{"time", Dimension::time, {}}, {"x", acceleration, {}}, {"y", acceleration, {}}, {"z", acceleration, {}}})
            .or_else("`gravity` holds")
            .says("Gravity that changes in time, in place of `gravity`: rows of time and the three components, in "
                  "order of time, "
                  "linear between rows, constant before the first and after the last."),

        section("time").required().says("How long, and how finely."),
        number("time.end", Dimension::time)
            .required()
            .in(kPositive)
            .says("The simulated time at which the run ends; it starts at 0."),
        number("time.step", Dimension::time)
            .required()
            .in(kPositive)
            .says("The time step. The error of position and of flow rates falls in proportion to it, the run time "
                  "grows as it is "
                  "made smaller. A good start is a step in which gravity moves a resting body by a thousandth of its "
                  "diameter."),
        number("time.max_travel")
            .standardly("1")
            .in(between(0, 1))
            .says("The share of its radius that a body may move in a step. Faster bodies make the step be halved as "
                  "often as "
                  "needed, so that nothing passes through anything; such substeps are counted in the summary. 0: never "
                  "halve."),

        section("solver").standardly("{}").says("How the contact problem of each step is solved."),
        choice("solver.method", {"conjugate_gauss_seidel", "gauss_seidel"})
            .standardly("conjugate_gauss_seidel")
            .says("The solver. `gauss_seidel` makes plain sweeps over the contacts; `conjugate_gauss_seidel` "
                  "accelerates them by a "
                  "nonlinear conjugate gradient and needs fewer sweeps for the same residual in anything deeper than a "
                  "few layers."),
        choice("solver.precision", {"mixed", "double"})
            .standardly("mixed")
            .says(
                "The numbers in which the solver sweeps. `mixed`: single precision (half the memory traffic) in every "
                "step in which its round-off lies far below the tolerance, that is with a tolerance of at least 1e-3, "
                "masses within a factor of 1e6, and bodies in contact not much faster than they move against each "
                "other; the solution is completed and its residual taken in double precision. `double`: double "
                "precision throughout."),
        number("solver.tolerance")
            .standardly("0.01")
            .in(kPositive)
            .says("The residual (scaled natural map, root mean square over the contacts) at which sweeping stops. "
                  "Smaller: more "
                  "sweeps, less penetration, forces nearer to balance. See what a run reached in the summary's "
                  "`residual`."),
        integer("solver.max_sweeps")
            .standardly("100")
            .in(between(1, 1e9))
            .says("Sweeps after which a step ends even if the tolerance is not reached. Such steps are counted in the "
                  "summary; many "
                  "of them mean that the result has a larger error than `tolerance` promises."),
        integer("solver.min_sweeps")
            .standardly("2")
            .in(between(1, 1e9))
            .says(
                "Sweeps that each step makes at least. More guards against a residual that is small by chance. Scenes "
                "with polyhedra make 16 at least."),
        boolean("solver.warm_start")
            .standardly("true")
            .says("Start from the impulses of the last step. Without it a resting pile has to be solved anew in each "
                  "step, at many "
                  "times the sweeps."),
        number("solver.block_size", length)
            .standardly("0")
            .in(kNotNegative)
            .says("Edge of the cubic blocks that order the work; larger than the largest moving body. It changes "
                  "speed, and the "
                  "order of contacts (so the last digits), not accuracy. 0: chosen from the sizes of the bodies."),
        number("solver.look_ahead")
            .standardly("0")
            .in(kNotNegative)
            .says(
                "Contacts that free flight would leave open in this step are held too if their gap is below this share "
                "of what the two bodies move against each other in half a step. Larger: less penetration on impact, "
                "more contacts to solve, and impacts that lose their restitution."),

        section("correction")
            .standardly("{}")
            .says("Takes penetration away by moving bodies, without changing velocities, so that it adds no kinetic "
                  "energy."),
        boolean("correction.enabled")
            .standardly("true")
            .says("Correct penetration. Without it every small overlap stays for ever, and beds pack too densely."),
        integer("correction.sweeps")
            .standardly("40")
            .in(between(1, 1000))
            .says("Sweeps of the correction in each step. More: the correction reaches further through a dense pack, "
                  "and costs more."),
        number("correction.share")
            .standardly("0.83")
            .in(between(0, 1))
            .says("The share of each penetration that one step aims to take away. Large values shake dense packs, "
                  "small ones leave "
                  "more overlap."),
    };
}

std::vector<Row> output() {
    return {
        section("output").standardly("{}").says(
            "What is written, and how often. Changes no result, only files and a little time."),
        number("output.snapshot_interval", Dimension::time)
            .standardly("0")
            .in(kNotNegative)
            .says("Simulated time between snapshots. 0: only the first and the last."),
        number("output.history_interval", Dimension::time)
            .standardly("0")
            .in(kNotNegative)
            .says("Simulated time between rows of the history. 0: every step."),
        number("output.checkpoint_interval", Dimension::time)
            .standardly("600")
            .in(kNotNegative)
            .says("Wall time between checkpoints: what a crash can lose. 0: only at the end or when stopped."),
        number("output.report_interval", Dimension::time)
            .standardly("10")
            .in(kNotNegative)
            .says("Wall time between progress lines when standard error is not a terminal."),
        choices("output.fields", {"velocity", "spin", "material", "mass", "orientation"})
            .standardly("[velocity]")
            .says("What snapshots hold of each body beside id, position and radius. Each costs file size."),
        boolean("output.contacts")
            .standardly("false")
            .says("Write contacts (bodies, point, normal, gap, impulse) into snapshots. They take more room than the "
                  "bodies."),
        boolean("output.mesh")
            .standardly("true")
            .says("Write the surfaces of polyhedra into snapshots, for ParaView: a rock with 20 vertices takes about "
                  "0.3 kB. Scree's own pictures do without. Of no meaning where all bodies are spheres."),
        integer("output.compression")
            .standardly("4")
            .in(between(0, 9))
            .says("Level of gzip in HDF5 files. 0: none, quickest; 9: smallest, slow."),
    };
}

}  // namespace scree::io::rows
