// The table, from its parts, and what several keys must satisfy together. A row says what a key means and what
// changing it does; that text is the user's reference.
#include "io/scenario/schema_rows.hpp"

namespace scree::io {

const std::vector<Row>& schema_rows() {
    static const std::vector<Row> table = [] {
        std::vector<Row> all;
        for (const auto& part :
             {rows::run(), rows::materials(), rows::bodies(), rows::walls(), rows::flows(), rows::measures(),
              rows::rasters(), rows::trajectories(), rows::output(), rows::shared()}) {
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
        {exactly_one, "bodies[random]", {"count", "mass", "packing_fraction"}},
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
    };
    return rules;
}

}  // namespace scree::io
