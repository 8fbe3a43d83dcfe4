#include "scenarios/build.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/body_file.hpp"
#include "scenarios/context.hpp"
#include "scenarios/flows.hpp"
#include "scenarios/generators.hpp"
#include "scenarios/materials.hpp"
#include "scenarios/measures.hpp"
#include "scenarios/named_shapes.hpp"
#include "scenarios/origin.hpp"
#include "scenarios/point_file.hpp"
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

// What the files of the scenario's bodies hold, in the order of the list.
struct InputFiles {
    std::vector<BodyFile> bodies;
    std::vector<PointFile> points;
};

InputFiles read_files(const io::Node& scenario, const Context& context, const Communicator& ranks) {
    InputFiles files;
    const io::Node::List& items = items_of(scenario, "bodies");
    const std::size_t whole = made_whole(scenario);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::string& generator = items[i].text("generator");
        if (generator == "file") files.bodies.push_back(read_body_file(items[i], i, context, ranks, i < whole));
        if (generator == "hulls") files.points.push_back(read_point_file(items[i], context, ranks));
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
    Context context{diagnostics, folder, 1, Vec3::Zero(), {}, {}};
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

BodyList generate(const io::Node& scenario, const InputFiles& files, const Context& context, const Scene& scene,
                  const Communicator& ranks) {
    BodyList bodies;
    std::uint64_t stream = 0;
    auto file = files.bodies.begin();
    auto points = files.points.begin();
    const std::size_t whole = made_whole(scenario);
    for (const io::Node& node : items_of(scenario, "bodies")) {
        const std::string& generator = node.text("generator");
        const Communicator& sharing = stream < whole ? Communicator::self() : ranks;
        if (generator == "sphere") {
            generate_sphere(node, context, sharing, bodies);
        } else if (generator == "polyhedron") {
            generate_polyhedron(node, stream, context, sharing, bodies);
        } else if (generator == "lattice") {
            generate_lattice(node, stream, context, sharing, bodies);
        } else if (generator == "voronoi") {
            generate_voronoi(node, stream, context, sharing, bodies);
        } else if (generator == "rock_mass") {
            generate_rock_mass(node, stream, context, sharing, bodies);
        } else if (generator == "hulls") {
            add_hulls(node, *points++, context, sharing, bodies);
        } else if (generator == "wall_of_blocks") {
            generate_wall_of_blocks(node, context, sharing, bodies);
        } else if (generator == "arch") {
            generate_arch(node, context, sharing, bodies);
        } else if (generator == "release") {
            generate_release(node, stream, context, scene, sharing, bodies);
        } else if (generator == "random") {
            generate_random(node, stream, context, scene, bodies);
        } else {
            SCREE_CHECK(generator == "file" && file != files.bodies.end());
            add_file_bodies(*file++, context, bodies);
        }
        if (++stream == whole) keep_part(ranks, bodies);
    }
    return bodies;
}

// Sizes and variants that no body of any rank took.
void drop_unused_shapes(const Communicator& ranks, BodyList& bodies) {
    std::vector<std::uint64_t> count(bodies.shapes.size(), 0);
    for (const ShapeIndex s : bodies.shape)
        if (s != kSphere) ++count[raw(s)];
    ranks.sum(count);
    std::vector<ShapeIndex> now(count.size(), kSphere);
    std::uint32_t kept = 0;
    for (std::size_t s = 0; s < count.size(); ++s) {
        if (count[s] == 0) continue;
        now[s] = ShapeIndex{kept};
        if (kept != s) {
            bodies.shapes[kept] = std::move(bodies.shapes[s]);
            bodies.shape_name[kept] = std::move(bodies.shape_name[s]);
        }
        ++kept;
    }
    bodies.shapes.resize(kept);
    bodies.shape_name.resize(kept);
    for (ShapeIndex& s : bodies.shape)
        if (s != kSphere) s = now[raw(s)];
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
        build_shapes(scenario, ranks, context);
        const InputFiles files = read_files(scenario, context, ranks);
        chosen = choose_origin(scenario, context.shapes, files.bodies, files.points, terrains);
    }
    return build_in_frame(scenario, chosen, std::move(terrains), context, std::move(scene));
}

Built build(const io::Node& scenario, const std::string& folder, io::Diagnostics& diagnostics,
            const Communicator& ranks) {
    Context context = make_context(scenario, folder, diagnostics);
    Scene scene;
    build_materials(scenario, context, scene);
    build_shapes(scenario, ranks, context);
    const InputFiles files = read_files(scenario, context, ranks);
    std::vector<TerrainFile> terrains = read_terrains(scenario, context, ranks);
    const Vec3 origin = scenario.has("origin")
                            ? scenario.vector("origin")
                            : choose_origin(scenario, context.shapes, files.bodies, files.points, terrains);
    Built built;
    built.scene = build_in_frame(scenario, origin, std::move(terrains), context, std::move(scene));
    BodyList bodies = generate(scenario, files, context, built.scene, ranks);
    drop_unused_shapes(ranks, bodies);
    built.shape_name = std::move(bodies.shape_name);
    if (!bodies.shapes.empty()) {
        check_measures_of_polyhedra(scenario, context);
        check_walls_of_polyhedra(scenario, built.scene, context);
    }
    built.state = make_state(std::move(bodies), built.scene, scenario, context, ranks);
    return built;
}

}  // namespace scree::scenarios
