// One sphere, and spheres on a grid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenarios/generators.hpp"
#include "scenarios/regions.hpp"

namespace scree::scenarios {
namespace {

// Places of the grid [m] from the first one. Hexagonal: close packing of equal spheres whose distance is the pitch (a
// row is sqrt(3)/2 of it away, a layer sqrt(2/3)); every second row is shifted by 1/2, every second layer by
// (1/2, sqrt(3)/6).
struct Grid {
    Vec3 pitch;
    bool hexagonal;

    Vec3 place(std::int64_t i, std::int64_t j, std::int64_t k) const {
        Vec3 s(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        if (hexagonal) {
            const double row = std::sqrt(3.0) / 2.0;
            s.x() += 0.5 * static_cast<double>((j & 1) ^ (k & 1));
            s.y() = row * s.y() + static_cast<double>(k & 1) * row / 3.0;
            s.z() *= std::sqrt(2.0 / 3.0);
        }
        return s.cwiseProduct(pitch);
    }
};

}  // namespace

void generate_sphere(const io::Node& node, const Context& context, BodyList& bodies) {
    const double radius = node.has("radius") ? node.number("radius") : 0.5 * node.number("diameter");
    bodies.add(radius, context.material(node.at("material")), context.point(node.at("position")),
               vector_or(node, "velocity", Vec3::Zero()), vector_or(node, "spin", Vec3::Zero()));
}

void generate_lattice(const io::Node& node, std::uint64_t stream, const Context& context, BodyList& bodies) {
    const std::size_t before = context.errors();
    const MaterialIndex material = context.material(node.at("material"));
    const auto size = build_size(node.at("size"), context);
    std::optional<Region> clip;
    if (node.has("clip")) clip = build_region(node.at("clip"), context);

    std::array<std::int64_t, 3> cells{};
    double product = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        cells[i] = node.at("cells").at(i).integer();
        product *= static_cast<double>(cells[i]);
    }
    const bool limited = node.has("count");
    const auto count =
        static_cast<std::size_t>(limited ? node.integer("count") : std::numeric_limits<std::int64_t>::max());
    // With a clip every place may have to be looked at.
    const double visited = clip ? product : std::min(product, static_cast<double>(count));
    if (visited > kMostBodies) {
        context.error(node.at("cells"),
                      fmt::format("{:g} places are more than one run can hold bodies ({:g})", visited, kMostBodies));
    } else if (limited && product < static_cast<double>(count)) {
        context.error(node.at("cells"), fmt::format("hold {:g} bodies, fewer than count ({})", product, count));
    }
    if (context.errors() != before) return;

    const Vec3 corner = context.point(node.at("corner"));
    const double jitter = number_or(node, "jitter", 0.0);
    const Vec3 velocity = vector_or(node, "velocity", Vec3::Zero()), spin = vector_or(node, "spin", Vec3::Zero());
    const Grid grid{node.vector("pitch"), node.has("arrangement") && node.text("arrangement") == "hexagonal"};
    std::uint64_t place = 0;
    std::size_t made = 0;
    for (std::int64_t k = 0; k < cells[2]; ++k) {
        for (std::int64_t j = 0; j < cells[1]; ++j) {
            for (std::int64_t i = 0; i < cells[0]; ++i, ++place) {
                if (made == count) return;
                Vec3 x = corner + grid.place(i, j, k);
                if (clip && !contains(*clip, x)) continue;
                Random random(context.seed, stream, place);
                const double radius = 0.5 * draw_diameter(*size, random);
                if (jitter > 0.0) {
                    for (int axis = 0; axis < 3; ++axis) x[axis] += random.uniform(-jitter, jitter);
                }
                bodies.add(radius, material, x, velocity, spin);
                ++made;
            }
        }
    }
    if (limited && made < count) {
        context.error(node.at("count"),
                      fmt::format("only {} of {} bodies: no more places of the grid lie inside clip; make cells larger",
                                  made, count));
    }
}

}  // namespace scree::scenarios
