#include "app/overlaps.hpp"

#include <array>
#include <tuple>

namespace scree::app {
namespace {

using solvers::Overlap;

// A row of numbers for rank 0: depth, key, point.
using Row = std::array<double, 6>;
constexpr double kNoDepth = -1.0;

bool is_earlier(const ContactKey& a, const ContactKey& b) {
    const auto order = [](const ContactKey& k) {
        return k.is_wall() ? std::tuple(true, k.b, k.a) : std::tuple(false, k.a, k.b);
    };
    return order(a) < order(b);
}
bool is_worse(const Overlap& a, const Overlap& b) {
    return a.depth > b.depth || (a.depth == b.depth && is_earlier(a.key, b.key));
}

std::optional<Overlap> worst_of(const std::vector<Overlap>& overlaps) {
    std::optional<Overlap> worst;
    for (const Overlap& o : overlaps)
        if (!worst || is_worse(o, *worst)) worst = o;
    return worst;
}

// Ids are below 2^53 in any run that fits into memory: a double holds them.
Row to_row(const std::optional<Overlap>& o) {
    if (!o) return {kNoDepth, 0, 0, 0, 0, 0};
    const double b = o->key.is_wall() ? -1.0 - raw(o->key.wall_index()) : static_cast<double>(o->key.b);
    return {o->depth, static_cast<double>(o->key.a), b, o->point.x(), o->point.y(), o->point.z()};
}
std::optional<Overlap> from_row(const std::vector<double>& row) {
    if (row[0] == kNoDepth) return std::nullopt;
    const BodyId a{static_cast<std::uint64_t>(row[1])};
    const ContactKey key = row[2] < 0.0 ? ContactKey::wall(a, WallIndex{static_cast<std::uint32_t>(-1.0 - row[2])}, 0)
                                        : ContactKey::bodies(a, BodyId{static_cast<std::uint64_t>(row[2])});
    return Overlap{key, row[0], Vec3(row[3], row[4], row[5])};
}

}  // namespace

Overlaps count_overlaps(const Scene& scene, const State& state, double relative, const Communicator& ranks) {
    const std::vector<Overlap> own = solvers::find_overlaps(scene, state, relative, ranks);
    Overlaps result;
    result.count = ranks.sum(static_cast<std::uint64_t>(own.size()));
    std::vector<Overlap> worst;
    for (const std::vector<double>& row : ranks.gather(to_row(worst_of(own))))
        if (const auto o = from_row(row)) worst.push_back(*o);
    result.deepest = worst_of(worst);
    return result;
}

}  // namespace scree::app
