// What `scree check` prints: what a scenario holds, what it leaves out, and what a run would cost in memory and disk.
#pragma once

#include <string>
#include <vector>

#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::app {

// Monodisperse spheres at rest with friction touch 4 to 6 others: 2 to 3 contacts a body; those that are near count
// too.
inline constexpr double kContactsPerBody = 3.0;
// Polyhedra touch at several points each, all of them counted: 5 (dominoes) to 15 (blocks of a rock mass) in the
// scenarios that come with Scree.
inline constexpr double kContactsPerPolyhedron = 8.0;
inline double contacts_per_body(const Plan& plan) {
    return plan.polyhedra ? kContactsPerPolyhedron : kContactsPerBody;
}

// Rough sizes in bytes, without compression. `contacts`: expected in a dense bed.
struct CostEstimate {
    double contacts = 0.0;
    double memory = 0.0;
    double snapshot = 0.0;
    double snapshots = 0.0;  // all of them
    double history = 0.0;
    double checkpoint = 0.0;  // one; two are kept
};
CostEstimate estimate_cost(const Scene& scene, const Plan& plan, const State& state);

// The shapes of the bodies, a line for each name; "" when all are spheres. `name`: of each of state.shapes.
std::string shapes_lines(const State& state, const std::vector<std::string>& name);

// `shape_name`: of each of state.shapes, what it was made from. `ranks`: how the bodies would be shared out; 0: not
// asked for.
std::string check_report(const std::string& scenario_name, const Scene& scene, const Plan& plan, const State& state,
                         const std::vector<std::string>& shape_name, const std::vector<std::string>& warnings,
                         int ranks = 0);

}  // namespace scree::app
