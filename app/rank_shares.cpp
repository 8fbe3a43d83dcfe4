#include "app/rank_shares.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/check_report.hpp"
#include "app/human_text.hpp"
#include "core/parallel/blocks.hpp"
#include "core/parallel/halo.hpp"
#include "core/parallel/partition.hpp"
#include "solvers/layout.hpp"

namespace scree::app {
namespace {

constexpr std::size_t kMostLines = 40;
struct Column {
    double min = 0.0, mean = 0.0, max = 0.0;
};
template <class Get>
Column over_ranks(const std::vector<RankShare>& shares, const Get& get) {
    Column c{get(shares.front()), 0.0, get(shares.front())};
    for (const RankShare& s : shares) {
        c.min = std::min(c.min, get(s));
        c.max = std::max(c.max, get(s));
        c.mean += get(s) / static_cast<double>(shares.size());
    }
    return c;
}

std::string line(const std::string& name, double bodies, double contacts, double border, double memory) {
    const auto count = [](double n) { return count_text(static_cast<std::uint64_t>(n + 0.5)); };
    return fmt::format("  {:<8} {:>14} {:>14} {:>14} {:>12}\n", name, count(bodies), count(contacts), count(border),
                       bytes_text(memory));
}

}  // namespace

std::vector<RankShare> share_out(const Scene& scene, const State& state, int ranks) {
    std::vector<RankShare> shares(static_cast<std::size_t>(ranks));
    const Bodies& bodies = state.bodies;
    const double size = scene.solver.block_size > 0.0 ? scene.solver.block_size : solvers::choose_block_size(bodies);
    if (size == 0.0) return shares;
    std::vector<BlockWork> work;
    work.reserve(bodies.size());
    for (const Vec3& x : bodies.position) work.push_back({block_of(x, size), 1});
    const Partition partition = Partition::bisect(Communicator::self(), work, ranks);
    std::vector<int> holders;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const int owner = partition.owner(work[i].block);
        ++shares[static_cast<std::size_t>(owner)].bodies;
        const double room = room_to_move(bodies.radius[i], bodies.velocity[i].norm(), scene.time.step);
        const Vec3 far = Vec3::Constant(reach(bodies.radius[i], room, margin_covered(0.0, size)));
        holders.clear();
        partition.owners(block_of(bodies.position[i] - far, size), block_of(bodies.position[i] + far, size), holders);
        for (const int rank : holders) shares[static_cast<std::size_t>(rank)].border += rank == owner ? 0 : 1;
    }
    return shares;
}

std::string shares_text(const std::vector<RankShare>& shares, const Plan& plan) {
    const auto bodies = [](const RankShare& s) { return static_cast<double>(s.bodies); };
    const auto contacts = [&](const RankShare& s) { return contacts_per_body(plan) * static_cast<double>(s.bodies); };
    const auto border = [](const RankShare& s) { return static_cast<double>(s.border); };
    const auto memory = [&](const RankShare& s) {
        return static_cast<double>(plan.bytes_per_body) * (bodies(s) + border(s)) +
               static_cast<double>(plan.bytes_per_contact) * contacts(s);
    };
    std::string text = fmt::format(
        "{} at the start (estimates; shares follow the flow). border: copies of bodies of other ranks\n"
        "  {:<8} {:>14} {:>14} {:>14} {:>12}\n",
        plural(shares.size(), "rank", "ranks"), "rank", "bodies", "contacts", "border", "memory");
    if (shares.size() <= kMostLines) {
        for (std::size_t r = 0; r < shares.size(); ++r) {
            const RankShare& s = shares[r];
            text += line(std::to_string(r), bodies(s), contacts(s), border(s), memory(s));
        }
    }
    const Column b = over_ranks(shares, bodies), c = over_ranks(shares, contacts), g = over_ranks(shares, border),
                 m = over_ranks(shares, memory);
    text += line("least", b.min, c.min, g.min, m.min) + line("mean", b.mean, c.mean, g.mean, m.mean) +
            line("most", b.max, c.max, g.max, m.max);
    if (b.mean > 0.0)
        text += fmt::format("  imbalance {:.3f} (most bodies over the mean), {} of the bodies in borders\n",
                            b.max / b.mean, percent_text(g.mean / b.mean));
    return text;
}

}  // namespace scree::app
