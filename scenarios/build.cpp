#include "scenarios/build.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/body_file.hpp"
#include "scenarios/context.hpp"
#include "scenarios/flows.hpp"
#include "scenarios/generators.hpp"
#include "scenarios/materials.hpp"
#include "scenarios/measures.hpp"
#include "scenarios/origin.hpp"
#include "scenarios/rasters.hpp"
#include "scenarios/settings.hpp"
#include "scenarios/walls.hpp"

namespace scree::scenarios {
namespace {

// Random insertion keeps clear of all bodies before it: up to the last item of that kind each rank makes all of them.
std::size_t made_whole(const io::Node& scenario) {
    const io::Node::List& items = items_of(scenario, "bodies");
    std::size_t whole = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].text("generator") == "random") whole = i + 1;
    return whole;
}

std::vector<BodyFile> read_body_files(const io::Node& scenario, const Context& context, const Communicator& ranks) {
    std::vector<BodyFile> files;
    const io::Node::List& items = items_of(scenario, "bodies");
    const std::size_t whole = made_whole(scenario);
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i].text("generator") == "file") files.push_back(read_body_file(items[i], context, ranks, i < whole));
    }
    return files;
}

// The origin first: everything after it is built in the local frame.
Scene build_in_frame(const io::Node& scenario, const Vec3& origin, std::vector<TerrainFile> terrains, Context& context,
                     Scene scene) {
    context.origin = origin;
    scene.origin = origin;
    build_settings(scenario, context, scene);
    build_walls(scenario, context, std::move(terrains), scene);
    build_inlets(scenario, context, scene);
    build_outlets(scenario, context, scene);
    build_measures(scenario, context, scene);
    build_rasters(scenario, context, scene);
    build_trajectories(scenario, scene);
    return scene;
}

Context make_context(const io::Node& scenario, const std::string& folder, io::Diagnostics& diagnostics) {
    Context context{diagnostics, folder, 1, Vec3::Zero(), {}};
    if (scenario.has("seed")) context.seed = static_cast<std::uint64_t>(scenario.integer("seed"));
    return context;
}

template <class T>
void keep(const Part& part, std::vector<T>& values) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(part.end), values.end());
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(part.begin));
    values.shrink_to_fit();
}

void keep_part(const Communicator& ranks, BodyList& bodies) {
    if (ranks.alone()) return;
    const Part part(bodies.size(), ranks);
    keep(part, bodies.id);
    keep(part, bodies.radius);
    keep(part, bodies.material);
    keep(part, bodies.position);
    keep(part, bodies.velocity);
    keep(part, bodies.spin);
    keep(part, bodies.shape);
    keep(part, bodies.orientation);
}

BodyList generate(const io::Node& scenario, const std::vector<BodyFile>& files, const Context& context,
                  const Scene& scene, const Communicator& ranks) {
    BodyList bodies;
    std::uint64_t stream = 0;
    auto file = files.begin();
    const std::size_t whole = made_whole(scenario);
    for (const io::Node& node : items_of(scenario, "bodies")) {
        const std::string& generator = node.text("generator");
        const Communicator& sharing = stream < whole ? Communicator::self() : ranks;
        if (generator == "sphere") {
            generate_sphere(node, context, sharing, bodies);
        } else if (generator == "lattice") {
            generate_lattice(node, stream, context, sharing, bodies);
        } else if (generator == "random") {
            generate_random(node, stream, context, scene, bodies);
        } else {
            SCREE_CHECK(generator == "file" && file != files.end());
            add_file_bodies(*file++, context, bodies);
        }
        if (++stream == whole) keep_part(ranks, bodies);
    }
    return bodies;
}

State make_state(BodyList list, const Scene& scene, const io::Node& scenario, const Context& context,
                 const Communicator& ranks) {
    State state;
    Bodies& bodies = state.bodies;
    const std::uint64_t most = ranks.max(static_cast<std::uint64_t>(list.size()));
    if (static_cast<double>(most) > kMostBodies) {
        context.error(scenario.at("bodies"),
                      fmt::format("{} bodies are more than one rank can hold ({:g})", most, kMostBodies));
        return state;
    }
    const bool polyhedra = !list.shapes.empty();
    for (std::size_t i = 0; i < list.size(); ++i) {
        const double density = scene.materials[raw(list.material[i])].density, radius = list.radius[i];
        const ConvexShape* shape = list.shape[i] == kSphere ? nullptr : &list.shapes[raw(list.shape[i])];
        bodies.id.push_back(BodyId{list.id[i]});
        bodies.mass.push_back(shape == nullptr ? Bodies::sphere_mass(radius, density) : density * shape->volume);
        if (!polyhedra) continue;
        bodies.inertia.push_back(shape == nullptr
                                     ? Vec3::Constant(Bodies::kSphereInertia * bodies.mass.back() * radius * radius)
                                     : Vec3(density * shape->inertia));
    }
    if (polyhedra) bodies.shape = std::move(list.shape);
    state.shapes = std::move(list.shapes);
    bodies.radius = std::move(list.radius);
    bodies.material = std::move(list.material);
    bodies.position = std::move(list.position);
    bodies.velocity = std::move(list.velocity);
    const Plan plan = make_plan(scene, bodies, ranks);
    if (plan.spin) {
        bodies.spin = std::move(list.spin);
    } else if (ranks.any(
                   std::any_of(list.spin.begin(), list.spin.end(), [](const Vec3& w) { return !w.isZero(0.0); }))) {
        context.warning(scenario.at("bodies"),
                        "the spin of bodies has no effect where nothing has friction, and is left out");
    }
    if (plan.orientation) bodies.orientation = std::move(list.orientation);
    state.next_id = list.next_id;
    state.inlets.resize(scene.inlets.size());
    state.outlets.resize(scene.outlets.size());
    state.measures.resize(scene.measures.size());
    return state;
}

}  // namespace

Scene build_scene(const io::Node& scenario, const std::string& folder, io::Diagnostics& diagnostics,
                  const std::optional<Vec3>& origin, const Communicator& ranks) {
    Context context = make_context(scenario, folder, diagnostics);
    Scene scene;
    build_materials(scenario, context, scene);
    std::vector<TerrainFile> terrains = read_terrains(scenario, context, ranks);
    Vec3 chosen = Vec3::Zero();
    if (scenario.has("origin")) {
        chosen = scenario.vector("origin");
    } else if (origin) {
        chosen = *origin;
    } else {
        chosen = choose_origin(scenario, read_body_files(scenario, context, ranks), terrains);
    }
    return build_in_frame(scenario, chosen, std::move(terrains), context, std::move(scene));
}

Built build(const io::Node& scenario, const std::string& folder, io::Diagnostics& diagnostics,
            const Communicator& ranks) {
    Context context = make_context(scenario, folder, diagnostics);
    Scene scene;
    build_materials(scenario, context, scene);
    const std::vector<BodyFile> files = read_body_files(scenario, context, ranks);
    std::vector<TerrainFile> terrains = read_terrains(scenario, context, ranks);
    const Vec3 origin = scenario.has("origin") ? scenario.vector("origin") : choose_origin(scenario, files, terrains);
    Built built;
    built.scene = build_in_frame(scenario, origin, std::move(terrains), context, std::move(scene));
    built.state =
        make_state(generate(scenario, files, context, built.scene, ranks), built.scene, scenario, context, ranks);
    return built;
}

}  // namespace scree::scenarios
