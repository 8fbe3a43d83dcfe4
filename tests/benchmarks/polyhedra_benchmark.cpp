// Time of a pair of convex polyhedra: touching (overlap up to 1e-3 of the size), within the margin (1e-2), far
// (bounding balls overlap, gap of several margins), and far with the axis of the step before as a guess. Random
// orientations.
#include <benchmark/benchmark.h>

#include <memory>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "contact/polyhedra/sphere_polyhedron.hpp"
#include "tests/testing/slow_polyhedra.hpp"

namespace {

using namespace scree;
using testing::Body;

constexpr std::size_t kPairs = 256;

ConvexShape shape_of(std::int64_t vertices) {
    Random random(41, 1, 0);
    return vertices == 8 ? testing::box_shape({1.0, 0.8, 0.6})
                         : testing::rock_shape(static_cast<int>(vertices), {0.6, 0.5, 0.4}, random);
}

std::vector<std::pair<std::unique_ptr<Body>, std::unique_ptr<Body>>> pairs(const ConvexShape& shape, double low,
                                                                           double high) {
    std::vector<std::pair<std::unique_ptr<Body>, std::unique_ptr<Body>>> made;
    for (std::uint64_t i = 0; i < kPairs; ++i) {
        Random random(41, 2, i);
        const double size = 2.0 * shape.radius, gap = random.uniform(low, high) * size;
        auto a =
            std::make_unique<Body>(shape, 1.2 * size * testing::random_direction(random), testing::random_turn(random));
        auto b = std::make_unique<Body>(shape, Vec3::Zero(), testing::random_turn(random));
        const testing::SlowGap slow = testing::slow_gap(*a, *b);
        a->placed.position += (gap - slow.gap) * slow.normal;
        made.emplace_back(std::move(a), std::move(b));
    }
    return made;
}

void run(benchmark::State& state, double low, double high, bool guess) {
    const ConvexShape shape = shape_of(state.range(0));
    const auto all = pairs(shape, low, high);
    const double margin = 1e-2 * 2.0 * shape.radius;
    contact::PolyhedraScratch scratch;
    contact::Manifold found;
    std::vector<Vec3> axis(kPairs, Vec3::Zero());
    double points = 0.0;
    std::size_t i = 0;
    for (auto _ : state) {
        if (!guess) axis[i].setZero();
        contact::polyhedron_polyhedron(*all[i].first, *all[i].second, margin, axis[i], scratch, found);
        points += found.count;
        i = (i + 1) % kPairs;
    }
    state.counters["points"] = points / static_cast<double>(state.iterations());
}

void touching(benchmark::State& state) {
    run(state, -1e-3, 0.0, false);
}
void within_margin(benchmark::State& state) {
    run(state, 1e-4, 1e-2, false);
}
void far(benchmark::State& state) {
    run(state, 2e-2, 1e-1, false);
}
void far_with_guess(benchmark::State& state) {
    run(state, 2e-2, 1e-1, true);
}
BENCHMARK(touching)->Arg(8)->Arg(12)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(within_margin)->Arg(8)->Arg(12)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(far)->Arg(8)->Arg(12)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(far_with_guess)->Arg(8)->Arg(12)->Arg(30)->Unit(benchmark::kMicrosecond);

void placing(benchmark::State& state) {
    const ConvexShape shape = shape_of(state.range(0));
    std::vector<Vec3> room(contact::placed_size(shape));
    const Quat turn(0.5, 0.5, 0.5, 0.5);
    for (auto _ : state) {
        benchmark::DoNotOptimize(contact::place(shape, Vec3::Zero(), turn, room));
        benchmark::ClobberMemory();
    }
}
BENCHMARK(placing)->Arg(8)->Arg(12)->Arg(30)->Unit(benchmark::kMicrosecond);

}  // namespace
