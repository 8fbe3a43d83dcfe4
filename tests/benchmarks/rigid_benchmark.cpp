// Contact updates a second of the kernels for bodies of any shape, on the settled bed of spheres of
// sweep_benchmark.cpp: the same contacts, bodies and order, with the inertia of ellipsoids and contacts beside the line
// of centres (or, to compare, those of the spheres).
#include <benchmark/benchmark.h>

#include <map>
#include <type_traits>

#include "settled_bed.hpp"
#include "solvers/single_problem.hpp"
#include "tests/testing/rigid_bed.hpp"

namespace scree::benchmarks {
namespace {

using solvers::RigidFrictional, solvers::RigidFrictionless;
using testing::BedShape;

template <class Law>
struct RigidBed {
    Bed bed;
    contact::ContactSet contacts;
    solvers::Layout layout;
    solvers::Sweeps<Law, double> full;

    RigidBed(int tiles, BedShape shape) : bed(settled_bed(tiles, Law::kImpulse == 3 ? 0.5 : 0.0)) {
        contacts = next_contacts(bed);
        layout.arrange(contacts, bed.state.bodies, solvers::choose_block_size(bed.state.bodies));
        const Vec3 dv(0.0, 0.0, -9.81 * bed.scene.time.step);
        full = testing::rigid_bed<Law>(bed.state.bodies, contacts, layout, dv, shape);
    }
};

template <class Law, BedShape kShape>
RigidBed<Law>& rigid_bed(int tiles) {
    static std::map<int, RigidBed<Law>> made;
    auto it = made.find(tiles);
    if (it == made.end()) it = made.try_emplace(tiles, tiles, kShape).first;
    return it->second;
}

template <class Sweeps, class Order>
void sweep(benchmark::State& state, Sweeps& sweeps, const Order& order, std::uint32_t lines, double contacts) {
    const auto one = [&] {
        ExactSum squares;
        sweeps.sweep(order, nullptr, lines, 0.3, true, squares);
        benchmark::DoNotOptimize(squares);
    };
    sweeps.reset_momentum();
    for (int k = 0; k < 20; ++k) one();
    for (auto _ : state) one();
    const double batches = static_cast<double>(sweeps.batch.size());
    state.counters["contacts"] = contacts;
    state.counters["updates/s"] = benchmark::Counter(contacts, benchmark::Counter::kIsIterationInvariantRate);
    // each batch once, its impulses and their momentum back
    state.counters["bytes/contact"] = (sizeof(sweeps.batch[0]) + 3.0 * sizeof(sweeps.previous[0])) * batches / contacts;
}

template <class Law, BedShape kShape, class Real>
void rigid(benchmark::State& state) {
    auto& p = rigid_bed<Law, kShape>(static_cast<int>(state.range(0)));
    const double contacts = static_cast<double>(p.contacts.size());
    if constexpr (std::is_same_v<Real, float>) {
        solvers::SingleProblem<Law> single;
        single.load(p.full, p.layout, {1.0, 4e3, 3e-4, 0.5, 3e-3}, 9.81 * p.bed.scene.time.step);
        sweep(state, single.sweeps, single, p.layout.touched_lines(), contacts);
    } else {
        auto full = p.full;
        sweep(state, full, p.layout, p.layout.touched_lines(), contacts);
    }
}

template <class Law, BedShape kShape>
void assemble(benchmark::State& state) {
    auto& p = rigid_bed<Law, kShape>(static_cast<int>(state.range(0)));
    auto batch = p.full.batch;
    for (auto _ : state)
        for (std::size_t k = 0; k < batch.size(); ++k)
            for (int i = 0; i < kLanes; ++i) {
                const auto& from = p.full.batch[k];
                const auto at = [i](const double(&x)[3][kLanes]) { return Vec3(x[0][i], x[1][i], x[2][i]); };
                if (from.a[i] == solvers::kGround) continue;
                set_lane(batch[k], i, {at(from.n), at(from.ra), at(from.rb), from.friction[i], from.bias[i]},
                         p.full.line[from.a[i]], p.full.line[from.b[i]]);
            }
    state.counters["lanes/s"] =
        benchmark::Counter(static_cast<double>(p.contacts.size()), benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

#define SCREE_RIGID(name, ...) \
    BENCHMARK(__VA_ARGS__)->Arg(1)->Arg(4)->Name(name "/tiles")->Unit(benchmark::kMillisecond)
SCREE_RIGID("rigid spheres/friction/accelerated/double", rigid<RigidFrictional, BedShape::spheres, double>);
SCREE_RIGID("rigid grains/friction/accelerated/double", rigid<RigidFrictional, BedShape::grains, double>);
SCREE_RIGID("rigid grains/friction/accelerated/float", rigid<RigidFrictional, BedShape::grains, float>);
SCREE_RIGID("rigid grains/frictionless/accelerated/double", rigid<RigidFrictionless, BedShape::grains, double>);
SCREE_RIGID("rigid grains/frictionless/accelerated/float", rigid<RigidFrictionless, BedShape::grains, float>);
SCREE_RIGID("rigid grains/friction/assembly", assemble<RigidFrictional, BedShape::grains>);
#undef SCREE_RIGID

}  // namespace scree::benchmarks
