#include "solvers/trajectories.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "core/parallel/sorted_slices.hpp"

namespace scree::solvers {
namespace {

std::vector<std::uint64_t> spread_evenly(std::uint64_t count, const Bodies& bodies, const Communicator& ranks) {
    std::vector<SortedSlices::Row> rows;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!bodies.is_ghost(i)) rows.push_back({{raw(bodies.id[i]), 0, 0}, i});
    const SortedSlices slices(std::move(rows), 1, ranks);
    const std::vector<BodyId> here = slices.move(bodies.id);
    std::vector<std::uint64_t> chosen;
    count = std::min(count, slices.total());
    for (std::uint64_t k = 0; k < count; ++k) {
        // The middle of the k-th of so many equal parts.
        const std::uint64_t row = (2 * k + 1) * slices.total() / (2 * count);
        if (slices.begin() <= row && row < slices.end()) chosen.push_back(raw(here[row - slices.begin()]));
    }
    const std::vector<std::byte> bytes = ranks.all_gather(std::as_bytes(std::span<const std::uint64_t>(chosen)));
    chosen.resize(bytes.size() / sizeof(std::uint64_t));
    if (!bytes.empty()) std::memcpy(chosen.data(), bytes.data(), bytes.size());
    return chosen;
}

}  // namespace

std::vector<std::uint64_t> choose_followed(const TrajectorySettings& settings, const Bodies& bodies,
                                           const Communicator& ranks) {
    return settings.count > 0 ? spread_evenly(settings.count, bodies, ranks) : settings.ids;
}

std::vector<HistoryColumn> trajectory_columns(const State& state, const Plan& plan) {
    std::vector<HistoryColumn> columns = {{"time", "s", "simulated time", 1}};
    for (const std::uint64_t id : state.followed) {
        const std::string name = std::to_string(id) + ".";
        columns.push_back({name + "position", "m", "centre of mass in the world; NaN: the body is not there", 3});
        columns.push_back({name + "velocity", "m/s", "of the centre of mass", 3});
        if (plan.spin) columns.push_back({name + "spin", "rad/s", "angular velocity in the world", 3});
        if (plan.orientation)
            columns.push_back({name + "orientation", "1", "unit quaternion w, x, y, z from the body to the world", 4});
    }
    return columns;
}

std::vector<double> trajectory_row(const Scene& scene, const State& state, const Plan& plan,
                                   const Communicator& ranks) {
    const Bodies& bodies = state.bodies;
    const std::size_t width = 6 + (plan.spin ? 3 : 0) + (plan.orientation ? 4 : 0);
    // The owner of a body puts its numbers in as they are, bit by bit; the others add zeros. The last: is it there?
    std::vector<std::uint64_t> bits((width + 1) * state.followed.size());
    for (std::size_t k = 0; k < state.followed.size(); ++k) {
        const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), BodyId{state.followed[k]});
        const auto i = static_cast<std::size_t>(at - bodies.id.begin());
        if (at == bodies.id.end() || raw(*at) != state.followed[k] || bodies.is_ghost(i)) continue;
        std::uint64_t* to = bits.data() + k * (width + 1);
        const auto put = [&to](const auto& numbers) {
            for (int n = 0; n < numbers.size(); ++n) *to++ = std::bit_cast<std::uint64_t>(double{numbers[n]});
        };
        put(Vec3(bodies.position[i] + scene.origin));
        put(bodies.velocity[i]);
        if (plan.spin) put(bodies.spin[i]);
        if (plan.orientation) {
            const Quat& q = bodies.orientation[i];
            put(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
        }
        *to = 1;
    }
    ranks.sum(std::span<std::uint64_t>(bits));
    std::vector<double> row = {state.time};
    for (std::size_t k = 0; k < state.followed.size(); ++k) {
        const std::uint64_t* from = bits.data() + k * (width + 1);
        const bool there = from[width] != 0;
        for (std::size_t n = 0; n < width; ++n)
            row.push_back(there ? std::bit_cast<double>(from[n]) : std::numeric_limits<double>::quiet_NaN());
    }
    return row;
}

}  // namespace scree::solvers
