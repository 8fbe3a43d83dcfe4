#include "app/overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "core/random.hpp"

namespace scree::app {
namespace {

using solvers::Overlap;

constexpr double kCellSize = 8.0;       // mean diameters
constexpr double kFarthestCell = 1e15;  // beyond it cells are one
constexpr double kMostCells = 1000.0;   // of one body, or it goes to all ranks

struct Traveller {
    std::uint64_t id;
    double x, y, z, radius;  // [m]
    bool home;               // it lies in a cell of the receiving rank
};

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

class Cells {
  public:
    Cells(double edge, const Communicator& ranks) : edge_(edge), ranks_(ranks) {}

    int rank_at(const Vec3& x) const { return rank_of(index(x[0]), index(x[1]), index(x[2])); }
    // The ranks that have a cell within `reach` of a place on each axis: increasing, each once.
    void ranks_near(const Vec3& x, double reach, std::vector<int>& found) const {
        found.clear();
        std::array<std::int64_t, 3> low{}, high{};
        double cells = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            low[k] = index(x[axis] - reach);
            high[k] = index(x[axis] + reach);
            cells *= static_cast<double>(high[k] - low[k] + 1);
        }
        if (cells > kMostCells) {
            found.resize(static_cast<std::size_t>(ranks_.size()));
            std::iota(found.begin(), found.end(), 0);
            return;
        }
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
            for (std::int64_t j = low[1]; j <= high[1]; ++j)
                for (std::int64_t k = low[2]; k <= high[2]; ++k) found.push_back(rank_of(i, j, k));
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
    }

  private:
    std::int64_t index(double x) const {
        return static_cast<std::int64_t>(std::clamp(std::floor(x / edge_), -kFarthestCell, kFarthestCell));
    }
    int rank_of(std::int64_t i, std::int64_t j, std::int64_t k) const {
        const std::uint64_t hash = mix64(mix64(mix64(static_cast<std::uint64_t>(i)) ^ static_cast<std::uint64_t>(j)) ^
                                         static_cast<std::uint64_t>(k));
        return static_cast<int>(hash % static_cast<std::uint64_t>(ranks_.size()));
    }

    double edge_;
    const Communicator& ranks_;
};

// 0 if there are no bodies.
double mean_diameter(const Bodies& bodies, const Communicator& ranks) {
    ExactSum sum;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!bodies.is_ghost(i)) sum.add(2.0 * bodies.radius[i]);
    const std::uint64_t count = ranks.sum(static_cast<std::uint64_t>(bodies.owned()));
    return count == 0 ? 0.0 : ranks.sum(sum) / static_cast<double>(count);
}

// Bodies where they lie and nearby ones, in order of id.
std::vector<Traveller> bring_together(const Bodies& bodies, const Communicator& ranks) {
    const double edge = kCellSize * mean_diameter(bodies, ranks);
    if (edge == 0.0) return {};
    const Cells cells(edge, ranks);
    std::map<int, Packer> outgoing;
    std::vector<int> targets;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const Vec3& x = bodies.position[i];
        const int home = cells.rank_at(x);
        cells.ranks_near(x, 2.0 * bodies.radius[i], targets);
        for (const int rank : targets)
            outgoing[rank].put(Traveller{raw(bodies.id[i]), x.x(), x.y(), x.z(), bodies.radius[i], rank == home});
    }
    std::vector<Communicator::Message> messages;
    for (auto& [rank, packer] : outgoing) messages.push_back({rank, std::move(packer.bytes)});
    std::vector<Traveller> all;
    for (const Communicator::Message& message : ranks.exchange(messages))
        for (Unpacker bytes(message.bytes); !bytes.empty();) all.push_back(bytes.get<Traveller>());
    std::sort(all.begin(), all.end(), [](const Traveller& a, const Traveller& b) { return a.id < b.id; });
    return all;
}

// Those that this rank counts.
std::vector<Overlap> overlaps_here(const Scene& scene, const State& state, double relative, const Communicator& ranks) {
    const std::vector<Traveller> here = bring_together(state.bodies, ranks);
    State together;
    together.time = state.time;
    for (const Traveller& t : here) {
        together.bodies.id.push_back(BodyId{t.id});
        together.bodies.position.emplace_back(t.x, t.y, t.z);
        together.bodies.radius.push_back(t.radius);
    }
    const auto find = [&here](std::uint64_t id) -> const Traveller& {
        return *std::lower_bound(here.begin(), here.end(), id,
                                 [](const Traveller& t, std::uint64_t wanted) { return t.id < wanted; });
    };
    std::vector<Overlap> overlaps = solvers::find_overlaps(scene, together, relative);
    const auto is_elsewhere = [&](const Overlap& o) {
        const Traveller& a = find(o.key.a);
        if (o.key.is_wall()) return !a.home;
        const Traveller& b = find(o.key.b);
        return !(b.radius < a.radius ? b : a).home;
    };
    overlaps.erase(std::remove_if(overlaps.begin(), overlaps.end(), is_elsewhere), overlaps.end());
    return overlaps;
}

}  // namespace

Overlaps count_overlaps(const Scene& scene, const State& state, double relative, const Communicator& ranks) {
    const std::vector<Overlap> own =
        ranks.alone() ? solvers::find_overlaps(scene, state, relative) : overlaps_here(scene, state, relative, ranks);
    Overlaps result;
    result.count = ranks.sum(static_cast<std::uint64_t>(own.size()));
    std::vector<Overlap> worst;
    for (const std::vector<double>& row : ranks.gather(to_row(worst_of(own))))
        if (const auto o = from_row(row)) worst.push_back(*o);
    result.deepest = worst_of(worst);
    return result;
}

}  // namespace scree::app
