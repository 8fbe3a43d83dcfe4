#include "core/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/terrain.hpp"

namespace scree {
namespace {

// A pair of materials that can meet, with its law.
struct Meeting {
    MaterialIndex a, b;
    PairLaw law;
};

// Bodies with bodies (a material meets itself only if there are two bodies of it), and bodies with walls.
std::vector<Meeting> meetings(const Scene& scene, const Bodies& bodies, const Communicator& ranks) {
    const std::size_t n = scene.materials.size();
    std::vector<std::uint64_t> count(n, 0);
    for (std::size_t i = 0; i < bodies.material.size(); ++i)
        if (!bodies.is_ghost(i)) ++count[raw(bodies.material[i])];
    ranks.sum(count);
    for (const Inlet& inlet : scene.inlets) count[raw(inlet.material)] += 2;
    std::vector<bool> wall(n, false);
    for (const Wall& w : scene.walls) {
        wall[raw(w.material)] = true;
        if (const auto* zoned = std::get_if<TerrainWall>(&w.shape))
            for (const MaterialIndex m : zoned->terrain->material) wall[raw(m)] = true;
    }

    std::vector<Meeting> found;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i; j < n; ++j) {
            const bool meet_bodies = i == j ? count[i] >= 2 : count[i] > 0 && count[j] > 0;
            const bool meet_wall = (count[i] > 0 && wall[j]) || (count[j] > 0 && wall[i]);
            if (!meet_bodies && !meet_wall) continue;
            const MaterialIndex a{static_cast<std::uint16_t>(i)}, b{static_cast<std::uint16_t>(j)};
            found.push_back({a, b, scene.pairs(a, b)});
        }
    }
    return found;
}

struct Largest {
    double value = 0.0;
    std::string pair;  // "glass with steel"
};

Largest largest(const Scene& scene, const std::vector<Meeting>& meetings, double PairLaw::*coefficient) {
    Largest result;
    for (const Meeting& m : meetings) {
        if (m.law.*coefficient <= result.value) continue;
        result.value = m.law.*coefficient;
        result.pair = fmt::format("{} with {}", scene.materials[raw(m.a)].name, scene.materials[raw(m.b)].name);
    }
    return result;
}

void decide_laws(Plan& plan, const Scene& scene, const Bodies& bodies, const Communicator& ranks) {
    const std::vector<Meeting> meet = meetings(scene, bodies, ranks);
    const Largest mu = largest(scene, meet, &PairLaw::friction);
    const Largest e = largest(scene, meet, &PairLaw::restitution);
    plan.restitution = e.value > 0.0;
    // A checkpoint of a run with friction carries spins: the run goes on as it began, even if the bodies that had
    // friction are gone.
    plan.polyhedra = ranks.any(bodies.has_shapes());
    plan.friction = mu.value > 0.0 || (!plan.polyhedra && ranks.any(bodies.has_spin()));
    plan.spin = plan.friction || plan.polyhedra;

    const auto add = [&](const char* feature, bool on, std::string reason) {
        plan.lines.push_back({feature, on, std::move(reason)});
    };
    if (mu.value > 0.0) {
        add("friction", true, fmt::format("tangential impulses and spin: friction up to {} ({})", mu.value, mu.pair));
    } else if (plan.friction) {
        add("friction", true, "tangential impulses and spin: the bodies carry spins from the start of the run");
    } else if (meet.empty()) {
        add("friction", false, "no tangential impulse, no spin: nothing can touch in this scene");
    } else {
        add("friction", false, "no tangential impulse, no spin: every friction coefficient is 0");
    }
    if (plan.restitution) {
        add("restitution", true, fmt::format("restitution up to {} ({})", e.value, e.pair));
    } else {
        add("restitution", false, "every restitution coefficient is 0: impacts are plastic");
    }
}

void decide_outputs(Plan& plan, const Scene& scene) {
    const auto& fields = scene.output.fields;
    const bool asked = std::find(fields.begin(), fields.end(), "orientation") != fields.end();
    plan.orientation = plan.polyhedra || asked;
    std::string why = "not integrated: output.fields has no `orientation`, and spheres need none";
    if (plan.polyhedra) {
        why = "polyhedra turn";
    } else if (asked) {
        why = "output.fields has `orientation`";
    }
    plan.lines.push_back({"orientation", plan.orientation, why});

    const auto reads_contacts = [](const Measure& m) { return m.kind == MeasureKind::coordination; };
    const auto measure = std::find_if(scene.measures.begin(), scene.measures.end(), reads_contacts);
    std::string reason = "no output.contacts and no measure that reads single contacts";
    if (scene.output.contacts) {
        reason = "output.contacts is true";
    } else if (measure != scene.measures.end()) {
        reason = fmt::format("measure `{}` counts contacts", measure->name);
    }
    plan.contact_records = scene.output.contacts || measure != scene.measures.end();
    plan.lines.push_back({"contact records", plan.contact_records, reason});
}

void decide_surroundings(Plan& plan, const Scene& scene) {
    const auto moving =
        std::find_if(scene.walls.begin(), scene.walls.end(), [](const Wall& w) { return w.motion.moves(); });
    plan.moving_walls = moving != scene.walls.end();
    plan.lines.push_back({"moving walls", plan.moving_walls,
                          plan.moving_walls ? fmt::format("wall `{}` has a motion", moving->name)
                                            : std::string("no wall has a motion")});
    plan.inlets = !scene.inlets.empty();
    plan.lines.push_back(
        {"inlets", plan.inlets,
         plan.inlets ? fmt::format("{} in the scene", scene.inlets.size()) : std::string("none in the scene")});
    plan.outlets = !scene.outlets.empty();
    plan.lines.push_back(
        {"outlets", plan.outlets,
         plan.outlets ? fmt::format("{} in the scene", scene.outlets.size()) : std::string("none in the scene")});
    plan.changing_gravity = !scene.gravity.is_constant();
    plan.lines.push_back({"changing gravity", plan.changing_gravity,
                          plan.changing_gravity ? "gravity_table has more than one row" : "gravity is constant"});
}

void decide_method(Plan& plan, const Scene& scene) {
    plan.correction = scene.correction.on && scene.correction.sweeps > 0 && scene.correction.share > 0.0;
    std::string reason = "correction.enabled is false";
    if (plan.correction) {
        reason =
            fmt::format("correction.sweeps {}, correction.share {}", scene.correction.sweeps, scene.correction.share);
    } else if (scene.correction.on) {
        reason = "correction.share is 0";
    }
    plan.lines.push_back({"position correction", plan.correction, reason});
    plan.warm_start = scene.solver.warm_start;
    plan.lines.push_back(
        {"warm start", plan.warm_start, plan.warm_start ? "solver.warm_start is true" : "solver.warm_start is false"});
    plan.acceleration = scene.solver.method == SolverMethod::conjugate_gauss_seidel;
    plan.lines.push_back(
        {"acceleration", plan.acceleration,
         plan.acceleration ? "solver.method is conjugate_gauss_seidel" : "solver.method is gauss_seidel"});
}

}  // namespace

Plan make_plan(const Scene& scene, const Bodies& bodies, const Communicator& ranks) {
    Plan plan;
    decide_laws(plan, scene, bodies, ranks);
    decide_outputs(plan, scene);
    decide_surroundings(plan, scene);
    decide_method(plan, scene);
    plan.lines.push_back({"polyhedra", plan.polyhedra,
                          plan.polyhedra ? "some bodies are polyhedra: contacts have lever arms and 3x3 local problems"
                                         : "every body is a sphere"});
    const auto terrain = std::find_if(scene.walls.begin(), scene.walls.end(),
                                      [](const Wall& w) { return std::holds_alternative<TerrainWall>(w.shape); });
    plan.lines.push_back({"terrain", terrain != scene.walls.end(),
                          terrain != scene.walls.end() ? fmt::format("wall `{}` is one", terrain->name)
                                                       : std::string("every wall is an exact surface")});
    plan.lines.push_back({"cohesion", false, "no pair of materials has cohesion"});
    plan.lines.push_back({"rolling friction", false, "no pair of materials has rolling friction"});
    return plan;
}

}  // namespace scree
