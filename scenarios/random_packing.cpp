// Random sequential insertion (Feder 1980, J. Theor. Biol. 87, 237): bodies are put one after the other at uniformly
// random places, a place where one would overlap is thrown away. The largest come first, since they need the most room.
// It saturates at a packing fraction of about 0.38 for equal spheres. Polyhedra are kept apart by the balls that hold
// them, and fill less.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "contact/walls/wall_contact.hpp"
#include "scenarios/figures.hpp"
#include "scenarios/regions.hpp"
#include "scenarios/sphere_grid.hpp"

namespace scree::scenarios {
namespace {

// The places for the centre of a whole sphere inside the region, or none if it does not fit.
std::optional<Region> shrunk(const Region& region, double radius) {
    if (const auto* box = std::get_if<BoxRegion>(&region)) {
        const BoxRegion inner{box->lower + Vec3::Constant(radius), box->upper - Vec3::Constant(radius)};
        if ((inner.lower.array() <= inner.upper.array()).all()) return inner;
    } else if (const auto* cylinder = std::get_if<CylinderRegion>(&region)) {
        const CylinderRegion inner{cylinder->base + radius * cylinder->axis, cylinder->axis, cylinder->radius - radius,
                                   cylinder->length - 2.0 * radius};
        if (inner.radius >= 0.0 && inner.length >= 0.0) return inner;
    } else if (const auto* sphere = std::get_if<SphereRegion>(&region)) {
        if (sphere->radius >= radius) return SphereRegion{sphere->centre, sphere->radius - radius};
    }
    return std::nullopt;
}

// Walls that are there at time 0, where they are then.
class StandingWalls {
  public:
    explicit StandingWalls(const Scene& scene) {
        for (const Wall& wall : scene.walls) {
            if (wall.present(0.0)) walls_.push_back({&wall.shape, pose_at(wall.motion, 0.0)});
        }
    }
    bool is_free(const Vec3& centre, double radius, double gap) const {
        contact::WallContacts contacts;
        for (const auto& [shape, pose] : walls_) {
            contact::find_contacts(*shape, pose.to_local(centre), radius, gap, contacts);
            for (int i = 0; i < contacts.count; ++i) {
                if (contacts.item[static_cast<std::size_t>(i)].gap < gap) return false;
            }
        }
        return true;
    }

  private:
    struct Standing {
        const WallShape* shape;
        WallPose pose;
    };
    std::vector<Standing> walls_;
};

// What is to be put in: bodies and their random numbers, in the order in which they were drawn.
struct Wanted {
    std::vector<Figure> figure;
    std::vector<Random> random;

    void draw(const Figures& figures, const Context& context, std::uint64_t stream) {
        Random numbers(context.seed, stream, figure.size());
        figure.push_back(figures.draw(figure.size(), numbers));
        random.push_back(numbers);
    }
};

Wanted draw_bodies(const io::Node& node, std::uint64_t stream, const Figures& figures, const Region& region,
                   double density, const Context& context) {
    Wanted wanted;
    if (node.has("count")) {
        const std::int64_t count = node.integer("count");
        if (static_cast<double>(count) > kMostBodies) {
            context.error(node.at("count"), fmt::format("is more than one run can hold ({:g})", kMostBodies));
            return wanted;
        }
        for (std::int64_t i = 0; i < count; ++i) wanted.draw(figures, context, stream);
        return wanted;
    }
    const bool by_mass = node.has("mass");
    const io::Node& amount = node.at(by_mass ? "mass" : "packing_fraction");
    const double volume_wanted = by_mass ? amount.number() / density : amount.number() * volume(region);
    if (volume_wanted > volume(region)) {
        context.error(amount, fmt::format("{:g} m3 of bodies do not fit into the region's {:g} m3", volume_wanted,
                                          volume(region)));
        return wanted;
    }
    if (volume_wanted / figures.largest_volume() > kMostBodies) {
        context.error(amount, fmt::format("makes more bodies than one run can hold ({:g})", kMostBodies));
        return wanted;
    }
    for (double sum = 0.0; sum < volume_wanted; sum += wanted.figure.back().volume)
        wanted.draw(figures, context, stream);
    return wanted;
}

// A uniformly random point of a region with an end.
Vec3 random_point(const Region& region, Random& random) {
    if (const auto* box = std::get_if<BoxRegion>(&region)) {
        Vec3 x;
        for (int axis = 0; axis < 3; ++axis) x[axis] = random.uniform(box->lower[axis], box->upper[axis]);
        return x;
    }
    const double angle = 2.0 * std::numbers::pi * random.uniform();
    if (const auto* cylinder = std::get_if<CylinderRegion>(&region)) {
        const double r = cylinder->radius * std::sqrt(random.uniform());
        const Vec3 s = cylinder->axis.unitOrthogonal(), t = cylinder->axis.cross(s);
        return cylinder->base + random.uniform(0.0, cylinder->length) * cylinder->axis +
               r * (std::cos(angle) * s + std::sin(angle) * t);
    }
    const auto& sphere = std::get<SphereRegion>(region);
    const double z = random.uniform(-1.0, 1.0), r = sphere.radius * std::cbrt(random.uniform());
    const double across = std::sqrt(1.0 - z * z);
    return sphere.centre + r * Vec3(across * std::cos(angle), across * std::sin(angle), z);
}

struct Placement {
    std::vector<Vec3> position;  // [m], in the order of the draws
    std::size_t placed = 0;
    double volume = 0.0;    // [m3] of the bodies that were placed
    std::size_t stuck = 0;  // the body that found no place, if not all did
    bool fits = true;       // it could be inside the region at all
};

Placement place(Wanted& wanted, const Region& region, double gap, std::int64_t attempts, SphereGrid& grid,
                const StandingWalls& walls) {
    const std::size_t count = wanted.figure.size();
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wanted.figure[a].radius > wanted.figure[b].radius; });
    Placement result;
    result.position.resize(count);
    for (const std::size_t k : order) {
        const double radius = wanted.figure[k].radius;
        const auto inner = shrunk(region, radius);
        bool found = false;
        for (std::int64_t attempt = 0; inner && !found && attempt < attempts; ++attempt) {
            const Vec3 x = random_point(*inner, wanted.random[k]);
            found = grid.is_free(x, radius, gap) && walls.is_free(x, radius, gap);
            result.position[k] = x;
        }
        if (!found) {
            result.stuck = k;
            result.fits = inner.has_value();
            return result;
        }
        grid.add(result.position[k], radius);
        result.volume += wanted.figure[k].volume;
        ++result.placed;
    }
    return result;
}

}  // namespace

void generate_random(const io::Node& node, std::uint64_t stream, const Context& context, const Scene& scene,
                     BodyList& bodies) {
    const std::size_t before = context.errors();
    const MaterialIndex material = context.material(node.at("material"));
    const auto figures = Figures::read(node, stream, context, bodies);
    const auto region = build_finite_region(node.at("region"), context);
    if (context.errors() != before || !figures) return;
    Wanted wanted = draw_bodies(node, stream, *figures, *region, scene.materials[raw(material)].density, context);
    if (context.errors() != before) return;

    SphereGrid grid;
    for (std::size_t i = 0; i < bodies.size(); ++i) grid.add(bodies.position[i], bodies.radius[i]);
    const std::int64_t attempts = node.has("attempts") ? node.integer("attempts") : 10000;
    const Placement found = place(wanted, *region, number_or(node, "gap", 0.0), attempts, grid, StandingWalls(scene));
    const std::size_t count = wanted.figure.size();
    if (found.placed < count) {
        const Figure& stuck = wanted.figure[found.stuck];
        const char* const of = stuck.shape == kSphere ? "a body" : "a polyhedron in a ball";
        const double diameter = 2.0 * stuck.radius;
        const std::string why =
            found.fits ? fmt::format("{} places were tried for {} of {:g} m diameter", attempts, of, diameter)
                       : fmt::format("{} of {:g} m diameter is too large for the region", of, diameter);
        context.error(
            node.at("region"),
            fmt::format("only {} of {} bodies could be placed (packing fraction {:.3f}): {}; enlarge the region, or "
                        "ask for fewer or smaller bodies",
                        found.placed, count, found.volume / volume(*region), why));
        return;
    }
    const Vec3 velocity = vector_or(node, "velocity", Vec3::Zero()), spin = vector_or(node, "spin", Vec3::Zero());
    for (std::size_t k = 0; k < count; ++k)
        add(bodies, bodies.next_id + k, wanted.figure[k], material, found.position[k], velocity, spin);
    bodies.next_id += count;
}

}  // namespace scree::scenarios
