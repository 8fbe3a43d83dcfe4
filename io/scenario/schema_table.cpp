// The table, from its parts, and what several keys must satisfy together. A row says what a key means and what
// changing it does; that text is the user's reference.
#include "io/scenario/schema_rows.hpp"

namespace scree::io {

const std::vector<Row>& schema_rows() {
    static const std::vector<Row> table = [] {
        std::vector<Row> all;
        for (const auto& part :
             {rows::run(), rows::materials(), rows::shapes(), rows::bodies(), rows::blocks(), rows::walls(),
              rows::flows(), rows::measures(), rows::rasters(), rows::trajectories(), rows::output(), rows::shared()}) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }();
    return table;
}

const std::vector<Rule>& schema_rules() {
    using enum Rule::Kind;
    static const std::vector<Rule> rules{
        {at_most_one, "", {"gravity", "gravity_table"}},
        {ascending, "solver", {"min_sweeps", "max_sweeps"}},
        {exactly_one, "bodies[sphere]", {"radius", "diameter"}},
        {at_least_one, "bodies[lattice]", {"size", "shape"}},
        {at_least_one, "bodies[random]", {"size", "shape"}},
        {exactly_one, "bodies[random]", {"count", "mass", "packing_fraction"}},
        {at_least_one, "bodies[release]", {"size", "shape"}},
        {at_most_one, "bodies[release]", {"count", "solid_fraction"}},
        {at_most_one, "bodies[polyhedron]", {"scale", "diameter"}},
        {exactly_one, "bodies[voronoi]", {"count", "cell_size"}},
        {exactly_one, "bodies[rock_mass]", {"region", "points"}},
        {ascending, "walls", {"appears", "goes"}},
        {ascending, "walls[box]", {"lower", "upper"}},
        {ascending, "walls[].motion", {"start", "end"}},
        {ascending, "outlets", {"from", "until"}},
        {ascending, "inlets", {"from", "until"}},
        {ascending, "measures", {"from", "until"}},
        {ascending, "measures[profile]", {"lower", "upper"}},
        {exactly_one, "trajectories", {"ids", "count"}},
        {ascending, "SIZE[uniform]", {"lower", "upper"}},
        {ascending, "SIZE[normal]", {"lower", "upper"}},
        {ascending, "SIZE[log_normal]", {"lower", "upper"}},
        {ascending, "SIZE[power_law]", {"lower", "upper"}},
        {ascending, "REGION[box]", {"lower", "upper"}},
        {exactly_one, "ORIENTATION", {"quaternion", "axis", "euler", "random"}},
        {at_most_one, "shapes[box]", {"diameter", "volume"}},
        {at_most_one, "shapes[prism]", {"diameter", "volume"}},
        {exactly_one, "shapes[tetrahedron]", {"edge", "diameter", "volume"}},
        {exactly_one, "shapes[octahedron]", {"edge", "diameter", "volume"}},
        {exactly_one, "shapes[dodecahedron]", {"edge", "diameter", "volume"}},
        {exactly_one, "shapes[icosahedron]", {"edge", "diameter", "volume"}},
        {exactly_one, "shapes[eota]", {"length", "diameter", "volume"}},
        {exactly_one, "shapes[rock]", {"length", "diameter", "volume"}},
        {at_most_one, "shapes[hull]", {"scale", "diameter", "volume"}},
        {at_most_one, "shapes[file]", {"scale", "diameter", "volume"}},
    };
    return rules;
}

}  // namespace scree::io
