// Rows of the schema table: materials, and the sections that several places share.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

std::vector<Row> materials() {
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

std::vector<Row> shared() {
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

        section("ORIENTATION").says("How bodies are turned from the frame that their shape is given in."),
        listing(Kind::numbers, "ORIENTATION.quaternion", 4)
            .or_else("another key says it")
            .says("The unit quaternion [w, x, y, z] of the rotation."),
        direction("ORIENTATION.axis")
            .or_else("another key says it")
            .says("Axis of the rotation by `angle`, right-handed; its length does not matter."),
        number("ORIENTATION.angle", angle).or_else("there is no `axis`").says("Angle about `axis`; they go together."),
        vector("ORIENTATION.euler", angle)
            .or_else("another key says it")
            .says("Angles [x, y, z] about the fixed axes, first about x, then y, then z: roll, pitch and yaw."),
        boolean("ORIENTATION.random")
            .or_else("another key says it")
            .says("true: each body is turned at random, every orientation equally likely."),

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

}  // namespace scree::io::rows
