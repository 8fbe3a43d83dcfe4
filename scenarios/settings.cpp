#include "scenarios/settings.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace scree::scenarios {
namespace {

using Node = io::Node;

int integer_or(const Node& map, std::string_view key, int otherwise) {
    return map.has(key) ? static_cast<int>(map.integer(key)) : otherwise;
}
bool boolean_or(const Node& map, std::string_view key, bool otherwise) {
    return map.has(key) ? map.boolean(key) : otherwise;
}

TimeSettings build_time(const Node& node, const Context& context) {
    TimeSettings time;
    time.end = node.number("end");
    time.step = node.number("step");
    time.max_travel = number_or(node, "max_travel", time.max_travel);
    // Beyond 2^53 steps a count of steps has no exact double, and step * count no meaning.
    if (time.step > time.end) {
        context.error(node.at("step"),
                      fmt::format("must not be more than time.end ({:g} s), is {:g} s", time.end, time.step));
    } else if (time.end / time.step > 0x1.0p53) {
        context.error(node.at("step"), fmt::format("{:g} steps of {:g} s to time.end are more than can be counted",
                                                   time.end / time.step, time.step));
    }
    return time;
}

SolverSettings build_solver(const Node& node, const Context& context) {
    SolverSettings solver;
    if (node.has("method") && node.text("method") == "gauss_seidel") solver.method = SolverMethod::gauss_seidel;
    if (node.has("precision") && node.text("precision") == "double") solver.precision = SolverPrecision::full;
    solver.tolerance = number_or(node, "tolerance", solver.tolerance);
    solver.max_sweeps = integer_or(node, "max_sweeps", solver.max_sweeps);
    solver.min_sweeps = integer_or(node, "min_sweeps", solver.min_sweeps);
    solver.warm_start = boolean_or(node, "warm_start", solver.warm_start);
    solver.block_size = number_or(node, "block_size", solver.block_size);
    solver.look_ahead = number_or(node, "look_ahead", solver.look_ahead);
    if (solver.min_sweeps > solver.max_sweeps) {
        context.error(node.at("max_sweeps"),
                      fmt::format("must be at least min_sweeps ({}), is {}", solver.min_sweeps, solver.max_sweeps));
    }
    return solver;
}

CorrectionSettings build_correction(const Node& node) {
    CorrectionSettings correction;
    correction.on = boolean_or(node, "enabled", correction.on);
    correction.sweeps = integer_or(node, "sweeps", correction.sweeps);
    correction.share = number_or(node, "share", correction.share);
    return correction;
}

OutputSettings build_output(const Node& node) {
    OutputSettings output;
    output.snapshot_interval = number_or(node, "snapshot_interval", output.snapshot_interval);
    output.history_interval = number_or(node, "history_interval", output.history_interval);
    output.checkpoint_interval = number_or(node, "checkpoint_interval", output.checkpoint_interval);
    output.report_interval = number_or(node, "report_interval", output.report_interval);
    for (const Node& field : items_of(node, "fields")) output.fields.push_back(field.text());
    output.contacts = boolean_or(node, "contacts", output.contacts);
    output.mesh = boolean_or(node, "mesh", output.mesh);
    output.compression = integer_or(node, "compression", output.compression);
    return output;
}

TimeTable build_gravity_table(const Node& node, const Context& context) {
    TimeTable table;
    for (const Node& row : node.items()) {
        const double time = row.at(0).number();
        if (!table.time.empty() && !(time > table.time.back())) {
            context.error(
                row, fmt::format("times must increase from row to row: {:g} s after {:g} s", time, table.time.back()));
        }
        table.time.push_back(time);
        table.value.emplace_back(row.at(1).number(), row.at(2).number(), row.at(3).number());
    }
    if (table.time.empty()) {
        context.error(node, "needs at least one row [time, x, y, z]");
        return TimeTable::constant(Vec3::Zero());
    }
    return table;
}

}  // namespace

void build_settings(const Node& scenario, const Context& context, Scene& scene) {
    if (scenario.has("title")) scene.title = scenario.text("title");
    scene.seed = context.seed;
    if (scenario.has("gravity_table")) {
        scene.gravity = build_gravity_table(scenario.at("gravity_table"), context);
        if (scenario.has("gravity") && scenario.at("gravity").given) {
            context.error(scenario.at("gravity_table"), "gravity is given twice: keep `gravity` or `gravity_table`");
        }
    } else if (scenario.has("gravity")) {
        scene.gravity = TimeTable::constant(scenario.vector("gravity"));
    }
    scene.time = build_time(scenario.at("time"), context);
    if (scenario.has("solver")) scene.solver = build_solver(scenario.at("solver"), context);
    if (scenario.has("correction")) scene.correction = build_correction(scenario.at("correction"));
    if (scenario.has("output")) scene.output = build_output(scenario.at("output"));
}

}  // namespace scree::scenarios
