// One sphere, and bodies on a grid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenarios/figures.hpp"
#include "scenarios/regions.hpp"

namespace scree::scenarios {
namespace {

// Places of the grid [m] from the first one. Hexagonal: close packing of equal spheres whose distance is the pitch (a
// row is sqrt(3)/2 of it away, a layer sqrt(2/3)); every second row is shifted by 1/2, every second layer by
// (1/2, sqrt(3)/6).
struct Grid {
    Vec3 corner, pitch;  // [m]
    bool hexagonal;
    std::array<std::int64_t, 3> cells;
    std::optional<Region> clip;

    // x runs fastest
    Vec3 place(std::uint64_t number) const {
        const auto n = static_cast<std::int64_t>(number);
        const std::int64_t i = n % cells[0], j = n / cells[0] % cells[1], k = n / cells[0] / cells[1];
        Vec3 s(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        if (hexagonal) {
            const double row = std::sqrt(3.0) / 2.0;
            s.x() += 0.5 * static_cast<double>((j & 1) ^ (k & 1));
            s.y() = row * s.y() + static_cast<double>(k & 1) * row / 3.0;
            s.z() *= std::sqrt(2.0 / 3.0);
        }
        return corner + s.cwiseProduct(pitch);
    }
    bool has(std::uint64_t number) const { return !clip || contains(*clip, place(number)); }
    double places() const {
        return static_cast<double>(cells[0]) * static_cast<double>(cells[1]) * static_cast<double>(cells[2]);
    }
};

Grid read_grid(const io::Node& node, const Context& context) {
    Grid grid{context.point(node.at("corner")),
              node.vector("pitch"),
              node.has("arrangement") && node.text("arrangement") == "hexagonal",
              {},
              {}};
    for (std::size_t i = 0; i < 3; ++i) grid.cells[i] = node.at("cells").at(i).integer();
    if (node.has("clip")) grid.clip = build_region(node.at("clip"), context);
    return grid;
}

// Bodies at the places of this rank's part, as long as there are fewer than `count` on this rank and those before it.
struct Filling {
    const Grid& grid;
    std::uint64_t count;

    // How many the ranks before this one make. With a clip they have to be counted.
    std::uint64_t made_before(const Part& part, const Communicator& ranks) const {
        if (!grid.clip) return part.begin;
        std::uint64_t kept = 0;
        if (!ranks.alone())
            for (std::uint64_t place = part.begin; place < part.end; ++place) kept += grid.has(place) ? 1 : 0;
        return std::min(count, ranks.sum_before(kept));
    }
    template <class Make>
    std::uint64_t fill(const Part& part, std::uint64_t before, const Make& make) const {
        std::uint64_t made = 0;
        for (std::uint64_t place = part.begin; place < part.end && before + made < count; ++place)
            if (grid.has(place)) make(place, before + made++);
        return made;
    }
};

}  // namespace

void generate_sphere(const io::Node& node, const Context& context, const Communicator& ranks, BodyList& bodies) {
    const double radius = node.has("radius") ? node.number("radius") : 0.5 * node.number("diameter");
    const MaterialIndex material = context.material(node.at("material"));
    const std::uint64_t id = bodies.next_id++;
    if (id % static_cast<std::uint64_t>(ranks.size()) != static_cast<std::uint64_t>(ranks.rank())) return;
    bodies.add(id, radius, material, context.point(node.at("position")), vector_or(node, "velocity", Vec3::Zero()),
               vector_or(node, "spin", Vec3::Zero()));
}

void generate_lattice(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                      BodyList& bodies) {
    const std::size_t before = context.errors();
    const MaterialIndex material = context.material(node.at("material"));
    const auto figures = Figures::read(node, stream, context, bodies);
    const Grid grid = read_grid(node, context);
    const bool limited = node.has("count");
    const auto count =
        static_cast<std::uint64_t>(limited ? node.integer("count") : std::numeric_limits<std::int64_t>::max());
    // With a clip every place may have to be looked at.
    const double visited = grid.clip ? grid.places() : std::min(grid.places(), static_cast<double>(count));
    if (visited > kMostBodies * ranks.size()) {
        context.error(node.at("cells"), fmt::format("{:g} places are more than one run can hold bodies ({:g})", visited,
                                                    kMostBodies * ranks.size()));
    } else if (limited && grid.places() < static_cast<double>(count)) {
        context.error(node.at("cells"), fmt::format("hold {:g} bodies, fewer than count ({})", grid.places(), count));
    }
    if (context.errors() != before || !figures) return;

    const double jitter = number_or(node, "jitter", 0.0);
    const Vec3 velocity = vector_or(node, "velocity", Vec3::Zero()), spin = vector_or(node, "spin", Vec3::Zero());
    const Filling filling{grid, count};
    const Part part(static_cast<std::uint64_t>(visited), ranks);
    const std::uint64_t made =
        filling.fill(part, filling.made_before(part, ranks), [&](std::uint64_t place, std::uint64_t number) {
            Vec3 x = grid.place(place);
            Random random(context.seed, stream, place);
            const Figure figure = figures->draw(place, random);
            if (jitter > 0.0) {
                for (int axis = 0; axis < 3; ++axis) x[axis] += random.uniform(-jitter, jitter);
            }
            add(bodies, bodies.next_id + number, figure, material, x, velocity, spin);
        });
    const std::uint64_t all = ranks.sum(made);
    bodies.next_id += all;
    if (limited && all < count) {
        context.error(node.at("count"),
                      fmt::format("only {} of {} bodies: no more places of the grid lie inside clip; make cells larger",
                                  all, count));
    }
}

}  // namespace scree::scenarios
