// The rows themselves. A row says what a key means and what changing it does; that text is the user's reference.
#include "io/schema.hpp"

namespace scree::io {
namespace {

using enum Dimension;

Row row(Kind kind, std::string path, Dimension dimension = none) {
    Row result;
    result.path = std::move(path);
    result.kind = kind;
    result.dimension = dimension;
    return result;
}
Row section(std::string path) {
    return row(Kind::section, std::move(path));
}
Row list(std::string path) {
    return row(Kind::list, std::move(path)).standardly("[]");
}
Row variant(std::string path) {
    return row(Kind::variant, std::move(path));
}
Row boolean(std::string path) {
    return row(Kind::boolean, std::move(path));
}
Row integer(std::string path) {
    return row(Kind::integer, std::move(path));
}
Row number(std::string path, Dimension dimension = none) {
    return row(Kind::number, std::move(path), dimension);
}
Row vector(std::string path, Dimension dimension = none) {
    return row(Kind::vector, std::move(path), dimension);
}
Row direction(std::string path) {
    return vector(std::move(path)).nonzero();
}
Row text(std::string path) {
    return row(Kind::text, std::move(path));
}
Row choice(std::string path, std::vector<std::string> choices, Kind kind = Kind::choice) {
    Row result = row(kind, std::move(path));
    result.choices = std::move(choices);
    return result;
}
Row choices(std::string path, std::vector<std::string> names) {
    return choice(std::move(path), std::move(names), Kind::choices);
}
Row listing(Kind kind, std::string path, std::size_t length) {
    Row result = row(kind, std::move(path));
    result.length = length;
    return result;
}
Row table(std::string path, std::vector<Column> columns) {
    Row result = row(Kind::table, std::move(path));
    result.columns = std::move(columns);
    return result;
}

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr Range kPositive{0.0, kNone, true};
constexpr Range kNotNegative{0.0, kNone, false};
constexpr Range from(double lower) {
    return {lower, kNone, false};
}
constexpr Range between(double lower, double upper) {
    return {lower, upper, false};
}

using Rows = std::vector<Row>;

Rows general_rows() {
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
            .says("Sweeps that each step makes at least. More guards against a residual that is small by chance."),
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
            .standardly("1")
            .in(kNotNegative)
            .says("Contacts that are still open at the middle of the step are held if their gap is below this share of "
                  "the distance "
                  "that the bodies move in the step. Larger: less penetration, and more contacts to solve."),

        section("correction")
            .standardly("{}")
            .says("Takes penetration away by moving bodies, without changing velocities, so that it adds no kinetic "
                  "energy."),
        boolean("correction.enabled")
            .standardly("true")
            .says("Correct penetration. Without it every small overlap stays for ever, and beds pack too densely."),
        integer("correction.sweeps")
            .standardly("5")
            .in(between(1, 1000))
            .says("Sweeps of the correction in each step. More: the correction reaches further through a dense pack, "
                  "and costs more."),
        number("correction.share")
            .standardly("0.5")
            .in(between(0, 1))
            .says("The share of each penetration that one step aims to take away. Large values shake dense packs, "
                  "small ones leave "
                  "more overlap."),
    };
}

Rows material_rows() {
    return {
        row(Kind::named, "materials").required().says("The materials, each under a name of your choice."),
        number("materials.*.density", density)
            .required()
            .in(kPositive)
            .says("Mass by volume of the solid (not of the bulk). Scales all forces; between materials, their ratio "
                  "sets who moves whom. "
                  "For the material of a wall only it has no effect."),
        number("materials.*.friction")
            .standardly("0.5")
            .in(between(0, 1e6))
            .says("Coulomb's coefficient of the material with itself. More friction: steeper heaps, looser packings, "
                  "slower flow. "
                  "If every coefficient is 0, spin and tangents are left out of the run, which is then much faster."),
        number("materials.*.restitution")
            .standardly("0")
            .in(between(0, 1))
            .says("Newton's coefficient of the material with itself: speed after over speed before an impact. 0: no "
                  "rebound, 1: no "
                  "loss. Dense flows hardly depend on it; dilute ones do."),

        list("pairs").says("Laws of pairs of materials. A pair that is not listed has the smaller friction and the "
                           "smaller restitution of its two "
                           "materials."),
        listing(Kind::texts, "pairs[].materials", 2)
            .required()
            .naming("materials")
            .says("The two materials, in any order; the same name twice is a material with itself."),
        number("pairs[].friction")
            .in(between(0, 1e6))
            .or_else("the smaller of the two materials' own")
            .says("Coulomb's coefficient between the two. More: steeper heaps against that wall, higher forces along "
                  "it."),
        number("pairs[].restitution")
            .in(between(0, 1))
            .or_else("the mean of the two materials' own")
            .says("Newton's coefficient between the two. More: higher rebounds, longer until rest."),
    };
}

Rows shared_rows() {
    return {
        section("SIZE").picked_by("distribution").says("A distribution of diameters, by number of bodies."),
        variant("SIZE[fixed]").says("All bodies have one size. Equal spheres tend to crystallise along smooth walls."),
        number("SIZE[fixed].diameter", length)
            .required()
            .in(kPositive)
            .says("The diameter. The time that a body takes to fall past its own size, and with it the step that is "
                  "fine enough, grows with its root."),
        variant("SIZE[uniform]").says("Every diameter between two bounds is equally likely."),
        number("SIZE[uniform].lower", length)
            .required()
            .in(kPositive)
            .says("The smallest diameter. Smaller bodies mean more contacts and a smaller step."),
        number("SIZE[uniform].upper", length)
            .required()
            .in(kPositive)
            .says("The largest diameter. A wide range packs more densely and segregates."),
        variant("SIZE[normal]").says("Normal (Gaussian), cut at two bounds."),
        number("SIZE[normal].mean", length).required().in(kPositive).says("The mean before the cut."),
        number("SIZE[normal].deviation", length)
            .required()
            .in(kPositive)
            .says("The standard deviation before the cut. More: a wider range, denser packings."),
        number("SIZE[normal].lower", length)
            .in(kPositive)
            .or_else("mean - 3 deviation, or mean / 10 if that is larger")
            .says("Smaller draws are drawn again."),
        number("SIZE[normal].upper", length)
            .in(kPositive)
            .or_else("mean + 3 deviation")
            .says("Larger draws are drawn again."),
        variant("SIZE[log_normal]")
            .says("The logarithm of the diameter is normal; the usual form of crushed rock and powders."),
        number("SIZE[log_normal].median", length)
            .required()
            .in(kPositive)
            .says("Half of the bodies are smaller than this, before the cut."),
        number("SIZE[log_normal].sigma")
            .required()
            .in(kPositive)
            .says("The standard deviation of the diameter's natural logarithm. 0.1 is narrow, 1 is very wide."),
        number("SIZE[log_normal].lower", length)
            .in(kPositive)
            .or_else("median exp(-3 sigma)")
            .says("Smaller draws are drawn again."),
        number("SIZE[log_normal].upper", length)
            .in(kPositive)
            .or_else("median exp(3 sigma)")
            .says("Larger draws are drawn again."),
        variant("SIZE[power_law]")
            .says("Number density proportional to diameter to the power of -exponent; fragments of rock."),
        number("SIZE[power_law].lower", length)
            .required()
            .in(kPositive)
            .says("The smallest diameter. It sets the number of bodies: with exponent 3, half the bound means about "
                  "four times the bodies at equal mass."),
        number("SIZE[power_law].upper", length).required().in(kPositive).says("The largest diameter."),
        number("SIZE[power_law].exponent")
            .required()
            .in(between(-100, 100))
            .says("The exponent. Larger: more small bodies. 2 to 4 is usual for fragments."),
        variant("SIZE[table]").says("A measured curve."),
        table("SIZE[table].rows", {{"diameter", length, kPositive}, {"cumulative", none, between(0, 1)}})
            .required()
            .says("Rows of diameter and the share by number of bodies that are not larger, rising from 0 to 1; linear "
                  "between rows."),

        section("REGION").picked_by("shape").says("A part of space."),
        variant("REGION[box]").says("A box with edges along the axes."),
        vector("REGION[box].lower", length).required().says("The corner with the smallest coordinates."),
        vector("REGION[box].upper", length).required().says("The opposite corner."),
        variant("REGION[cylinder]").says("A solid cylinder."),
        vector("REGION[cylinder].base", length).required().says("Centre of one end."),
        direction("REGION[cylinder].axis")
            .standardly("[0, 0, 1]")
            .says("Direction from that end to the other; its length does not matter."),
        number("REGION[cylinder].radius", length).required().in(kPositive).says("Radius."),
        number("REGION[cylinder].length", length).required().in(kPositive).says("Distance between the ends."),
        variant("REGION[sphere]").says("A ball."),
        vector("REGION[sphere].centre", length).required().says("Centre."),
        number("REGION[sphere].radius", length).required().in(kPositive).says("Radius."),
        variant("REGION[half_space]").says("All that lies on one side of a plane."),
        vector("REGION[half_space].point", length).required().says("A point of the plane."),
        direction("REGION[half_space].normal").required().says("Points out of the region; its length does not matter."),
    };
}

Rows body_rows() {
    Rows rows{
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

        variant("bodies[lattice]")
            .says("Bodies on a grid: x runs fastest, then y, then z. The cheapest way to many bodies; let them fall to "
                  "lose the order."),
        text("bodies[lattice].material").required().naming("materials").says("Their material."),
        section("bodies[lattice].size")
            .required()
            .like("SIZE")
            .says("Their sizes. Diameters larger than the pitch make neighbours overlap, which is an error."),
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
        section("bodies[random].size").required().like("SIZE").says("Their sizes."),
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

        variant("bodies[file]")
            .says("Bodies from a text file, one a line, numbers separated by blanks, `#` begins a comment."),
        text("bodies[file].path")
            .required()
            .naming_file()
            .says("The file; a relative path starts at the folder of the scenario that names it."),
        choices("bodies[file].columns",
                {"x", "y", "z", "r", "d", "vx", "vy", "vz", "wx", "wy", "wz", "material", "skip"})
            .standardly("[x, y, z, r]")
            .says("What the columns hold: position, radius r or diameter d, velocity, angular velocity, the material's "
                  "name; `skip` "
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
    for (const char* generator : {"sphere", "lattice", "random"}) {
        const std::string path = std::string("bodies[") + generator + "].";
        rows.push_back(vector(path + "velocity", velocity).standardly("[0, 0, 0]").says("Velocity at time 0."));
        rows.push_back(vector(path + "spin", angular_velocity)
                           .standardly("[0, 0, 0]")
                           .says("Angular velocity at time 0. Without effect where nothing has friction."));
    }
    return rows;
}

Rows wall_rows() {
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

Rows flow_rows() {
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

Rows measure_rows() {
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

Rows output_rows() {
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
        integer("output.compression")
            .standardly("4")
            .in(between(0, 9))
            .says("Level of gzip in HDF5 files. 0: none, quickest; 9: smallest, slow."),
    };
}

}  // namespace

const std::vector<Row>& schema_rows() {
    static const std::vector<Row> rows = [] {
        Rows all;
        for (const Rows& part : {general_rows(), material_rows(), body_rows(), wall_rows(), flow_rows(), measure_rows(),
                                 output_rows(), shared_rows()}) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }();
    return rows;
}

const std::vector<Rule>& schema_rules() {
    using enum Rule::Kind;
    static const std::vector<Rule> rules{
        {at_most_one, "", {"gravity", "gravity_table"}},
        {ascending, "solver", {"min_sweeps", "max_sweeps"}},
        {exactly_one, "bodies[sphere]", {"radius", "diameter"}},
        {exactly_one, "bodies[random]", {"count", "mass", "packing_fraction"}},
        {ascending, "walls", {"appears", "goes"}},
        {ascending, "walls[box]", {"lower", "upper"}},
        {ascending, "walls[].motion", {"start", "end"}},
        {ascending, "outlets", {"from", "until"}},
        {ascending, "inlets", {"from", "until"}},
        {ascending, "measures", {"from", "until"}},
        {ascending, "measures[profile]", {"lower", "upper"}},
        {ascending, "SIZE[uniform]", {"lower", "upper"}},
        {ascending, "SIZE[normal]", {"lower", "upper"}},
        {ascending, "SIZE[log_normal]", {"lower", "upper"}},
        {ascending, "SIZE[power_law]", {"lower", "upper"}},
        {ascending, "REGION[box]", {"lower", "upper"}},
    };
    return rules;
}

}  // namespace scree::io
