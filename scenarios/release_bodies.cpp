// Bodies in the place of what was taken from a terrain: at the places of close packing of balls as large as the largest
// ball that holds one of them, as far as these lie whole between the lowered and the former surface. Fewer than fit
// take the places nearest to the sliding planes, by their share of the depth there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "contact/walls/wall_contact.hpp"
#include "core/terrain.hpp"
#include "scenarios/figures.hpp"

namespace scree::scenarios {
namespace {

struct Place {
    Vec3 centre;   // [m]
    double share;  // of the depth, from the lowered surface up
};

class ReleasedVolume {
  public:
    explicit ReleasedVolume(const WallShape& shape)
        : shape_(shape), terrain_(*std::get<TerrainWall>(shape).terrain), grid_(*terrain_.grid) {
        const std::vector<double>& thickness = terrain_.release->thickness;
        const double far = std::numeric_limits<double>::infinity();
        lower_ = Vec3::Constant(far), upper_ = Vec3::Constant(-far);
        for (std::uint32_t j = 0; j < grid_.rows; ++j)
            for (std::uint32_t i = 0; i < grid_.columns; ++i) {
                const double taken = thickness[std::size_t{j} * grid_.columns + i];
                if (!(taken > 0.0)) continue;
                const Vec3 base(grid_.x + i * grid_.dx, grid_.y + j * grid_.dy, grid_.at(i, j));
                const Vec3 cell(grid_.dx, grid_.dy, 0.0);
                lower_ = lower_.cwiseMin(base - cell);
                upper_ = upper_.cwiseMax(base + cell + Vec3(0.0, 0.0, taken));
            }
    }
    const Vec3& lower() const { return lower_; }
    const Vec3& upper() const { return upper_; }

    // A ball here is clear of the lowered surface, and does not reach above the former one over its centre.
    std::optional<Place> place(const Vec3& centre, double radius) const {
        const double taken = thickness(centre.x(), centre.y());
        if (!(taken > 2.0 * radius)) return std::nullopt;
        const auto column = terrain_.column(centre.x(), centre.y());
        if (!column) return std::nullopt;
        const TerrainMesh::Triangle& t = terrain_.mesh.triangle[*column];
        const double above = t.normal.dot(centre - terrain_.mesh.vertex[t.corner[0]]) / t.normal.z();
        if (above < radius || above + radius > taken) return std::nullopt;
        contact::WallContacts contacts;
        contact::find_contacts(shape_, centre, radius, 0.0, contacts);
        for (int k = 0; k < contacts.count; ++k)
            if (contacts.item[static_cast<std::size_t>(k)].gap < 0.0) return std::nullopt;
        return Place{centre, above / taken};
    }

  private:
    // Bilinear between nodes [m].
    double thickness(double x, double y) const {
        const double s = (x - grid_.x) / grid_.dx, t = (y - grid_.y) / grid_.dy;
        if (!(s >= 0.0 && t >= 0.0 && s < grid_.columns - 1 && t < grid_.rows - 1)) return 0.0;
        const auto i = static_cast<std::size_t>(s), j = static_cast<std::size_t>(t);
        const double a = s - static_cast<double>(i), b = t - static_cast<double>(j);
        const double* low = terrain_.release->thickness.data() + j * grid_.columns + i;
        const double* high = low + grid_.columns;
        return (1.0 - b) * ((1.0 - a) * low[0] + a * low[1]) + b * ((1.0 - a) * high[0] + a * high[1]);
    }

    const WallShape& shape_;
    const Terrain& terrain_;
    const HeightGrid& grid_;
    Vec3 lower_, upper_;  // [m] a box around it
};

// Layers of close packing, spheres of diameter `pitch` touching.
std::vector<Place> close_packed(const ReleasedVolume& volume, double pitch, double radius) {
    const double row = pitch * std::sqrt(3.0) / 2.0, layer = pitch * std::sqrt(2.0 / 3.0);
    const Vec3 size = volume.upper() - volume.lower();
    const auto nx = static_cast<std::int64_t>(size.x() / pitch) + 2, ny = static_cast<std::int64_t>(size.y() / row) + 2,
               nz = static_cast<std::int64_t>(size.z() / layer) + 2;
    std::vector<Place> places;
    for (std::int64_t k = 0; k < nz; ++k)
        for (std::int64_t j = 0; j < ny; ++j)
            for (std::int64_t i = 0; i < nx; ++i) {
                const Vec3 step(pitch * (static_cast<double>(i) + 0.5 * static_cast<double>((j & 1) ^ (k & 1))),
                                row * (static_cast<double>(j) + static_cast<double>(k & 1) / 3.0),
                                layer * static_cast<double>(k));
                if (const auto place = volume.place(volume.lower() + step, radius)) places.push_back(*place);
            }
    return places;
}

// The figure, or with this probability the sphere of the same volume.
Figure as_sphere(const Figure& figure, double probability, Random& random) {
    if (probability == 0.0 || !(random.uniform() < probability)) return figure;
    return {std::cbrt(0.75 * figure.volume / std::numbers::pi), figure.volume};
}

const Wall* released_wall(const io::Node& node, const Context& context, const Scene& scene) {
    const std::string& name = node.at("wall").text();
    const auto wall =
        std::find_if(scene.walls.begin(), scene.walls.end(), [&](const Wall& w) { return w.name == name; });
    if (wall == scene.walls.end()) return nullptr;
    const auto* terrain = std::get_if<TerrainWall>(&wall->shape);
    if (terrain != nullptr && terrain->terrain->release) return &*wall;
    // a terrain that could not be made is reported already
    if (context.errors() == 0) context.error(node.at("wall"), fmt::format("wall '{}' has no `release`", name));
    return nullptr;
}

constexpr double kMostPlaces = 1e8;

}  // namespace

void generate_release(const io::Node& node, std::uint64_t stream, const Context& context, const Scene& scene,
                      const Communicator& ranks, BodyList& bodies) {
    const std::size_t before = context.errors();
    const MaterialIndex material = context.material(node.at("material"));
    const auto figures = Figures::read(node, stream, context, bodies);
    const Wall* wall = released_wall(node, context, scene);
    if (context.errors() != before || !figures || wall == nullptr) return;

    const ReleasedVolume volume(wall->shape);
    const double taken = std::get<TerrainWall>(wall->shape).terrain->release->volume;
    const double radius = figures->largest_radius(), pitch = 2.0 * radius + number_or(node, "gap", 0.0);
    const Vec3 size = (volume.upper() - volume.lower()).cwiseMax(Vec3::Constant(pitch)) / pitch;
    if (size.prod() > kMostPlaces) {
        context.error(node,
                      fmt::format("bodies in balls of {:g} m are too small for a release of {:.4g} m3: about {:.2g} "
                                  "places would have to be looked at",
                                  2.0 * radius, taken, size.prod()));
        return;
    }
    const std::vector<Place> places = close_packed(volume, pitch, radius);
    const double spheres = number_or(node, "spheres", 0.0);
    std::vector<Figure> figure;
    double solid = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        Random random(context.seed, stream, k);
        const Figure drawn = figures->draw(k, random);
        figure.push_back(as_sphere(drawn, spheres, random));
        solid += figure.back().volume;
    }
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return places[a].share < places[b].share; });
    std::size_t count = order.size();
    const auto refuse = [&](const char* key, const std::string& asked) {
        context.error(node.at(key), fmt::format("{}: only {} bodies in balls of up to {:g} m have room in the release "
                                                "of {:.4g} m3 (solid fraction {:.3f}); ask for less, or for smaller "
                                                "bodies",
                                                asked, places.size(), 2.0 * radius, taken, solid / taken));
    };
    if (places.empty()) return refuse("wall", "not one body fits");
    if (node.has("count")) {
        const auto wanted = static_cast<std::size_t>(node.integer("count"));
        if (wanted > count) return refuse("count", fmt::format("{} bodies do not fit", wanted));
        count = wanted;
    } else if (node.has("solid_fraction")) {
        const double share = node.number("solid_fraction");
        if (solid < share * taken) return refuse("solid_fraction", fmt::format("{:g} is not reached", share));
        count = 0;
        for (double sum = 0.0; sum < share * taken; sum += figure[order[count++]].volume) {
        }
    }
    order.resize(count);
    std::sort(order.begin(), order.end());
    const Vec3 velocity = vector_or(node, "velocity", Vec3::Zero()), spin = vector_or(node, "spin", Vec3::Zero());
    const Part part(count, ranks);
    for (std::uint64_t n = part.begin; n < part.end; ++n) {
        const std::size_t k = order[n];
        add(bodies, bodies.next_id + n, figure[k], material, places[k].centre, velocity, spin);
    }
    bodies.next_id += count;
}

}  // namespace scree::scenarios
