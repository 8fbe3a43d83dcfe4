// Contact updates a second of the sweep kernels on settled beds, with the bytes that a sweep must move beside it; and
// the residual against the number of sweeps.   scree_benchmarks [--benchmark_filter=...] | scree_benchmarks
// --convergence
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <map>
#include <type_traits>

#include "settled_bed.hpp"
#include "solvers/gauss_seidel.hpp"

namespace scree::benchmarks {
namespace {

using solvers::Frictional, solvers::Frictionless;

template <class Law>
struct Problem {
    Bed bed;
    contact::ContactSet contacts;
    solvers::Layout layout;
    solvers::ContactProblem<Law> problem;

    explicit Problem(int tiles) : bed(settled_bed(tiles, Law::kImpulse == 3 ? 0.5 : 0.0)) {
        contacts = next_contacts(bed);
        layout.arrange(contacts, bed.state.bodies, solvers::choose_block_size(bed.state.bodies));
        assemble();
    }
    void assemble() {
        const double h = bed.scene.time.step;
        problem.assemble(contacts, layout, bed.state, Vec3(0.0, 0.0, -9.81 * h), {});
        problem.scale(9.81 * h);
    }
};

template <class Law>
Problem<Law>& problem(int tiles) {
    static std::map<int, Problem<Law>> made;
    auto it = made.find(tiles);
    if (it == made.end()) it = made.try_emplace(tiles, tiles).first;
    return it->second;
}

template <class Law, class Real, bool kAccelerated>
void sweep(benchmark::State& state) {
    auto& p = problem<Law>(static_cast<int>(state.range(0)));
    p.assemble();
    if (std::is_same_v<Real, float> && !p.problem.begin_single(SolverSettings{}))
        return state.SkipWithError("not solved in single precision");
    if (kAccelerated) p.problem.reset_momentum();
    for (int k = 0; k < 20; ++k) p.problem.sweep(0.3, kAccelerated);
    for (auto _ : state) benchmark::DoNotOptimize(p.problem.sweep(0.3, kAccelerated));
    const double contacts = static_cast<double>(p.contacts.size());
    const double lanes = static_cast<double>(p.problem.batches_in_sweep()) * PackOf<Real>::kLanes;
    const double impulse = Law::kImpulse * sizeof(Real), impulses = (kAccelerated ? 2.0 : 1.0) * impulse;
    const double batch = sizeof(typename Law::template BatchOf<Real>);
    state.counters["contacts"] = contacts;
    state.counters["updates/s"] = benchmark::Counter(contacts, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["lanes used"] = contacts / lanes;
    // what a sweep streams: each batch once, its impulses back; the lines stay in the cache of their block
    state.counters["bytes/contact"] = (batch / PackOf<Real>::kLanes + 2.0 * impulses - impulse) * lanes / contacts;
}

template <class Law>
void convergence(const char* name, bool accelerated, bool warm) {
    auto& p = problem<Law>(1);
    p.assemble();
    SolverSettings settings;
    settings.method = accelerated ? SolverMethod::conjugate_gauss_seidel : SolverMethod::gauss_seidel;
    settings.tolerance = 0.0;
    std::vector<Vec3> impulse;
    std::vector<double> normal;
    if (warm) {  // the impulses of a well solved step, as the step before would leave them
        settings.max_sweeps = 2000;
        solvers::gauss_seidel(p.problem, settings);
        p.problem.impulses(impulse, normal);
    }
    for (const int sweeps : {3, 10, 30, 100, 300, 1000}) {
        p.assemble();
        if (warm) p.problem.warm_start(impulse, normal);
        settings.max_sweeps = sweeps;
        const auto report = solvers::gauss_seidel(p.problem, settings);
        std::printf("%-14s %-12s %-5s %6d sweeps   residual rms %.2e  max %.2e\n", name,
                    accelerated ? "accelerated" : "plain", warm ? "warm" : "cold", sweeps, report.residual.rms,
                    report.residual.max);
    }
}

}  // namespace

#define SCREE_SWEEP(law, real, accelerated, name) \
    BENCHMARK(sweep<law, real, accelerated>)->Arg(1)->Arg(4)->Name(name)->Unit(benchmark::kMillisecond)
SCREE_SWEEP(Frictional, double, false, "friction/plain/double/tiles");
SCREE_SWEEP(Frictional, float, false, "friction/plain/float/tiles");
SCREE_SWEEP(Frictional, double, true, "friction/accelerated/double/tiles");
SCREE_SWEEP(Frictional, float, true, "friction/accelerated/float/tiles");
SCREE_SWEEP(Frictionless, double, false, "frictionless/plain/double/tiles");
SCREE_SWEEP(Frictionless, float, false, "frictionless/plain/float/tiles");
SCREE_SWEEP(Frictionless, double, true, "frictionless/accelerated/double/tiles");
SCREE_SWEEP(Frictionless, float, true, "frictionless/accelerated/float/tiles");
#undef SCREE_SWEEP

}  // namespace scree::benchmarks

int main(int argc, char** argv) {
    using namespace scree;
    if (argc > 1 && std::strcmp(argv[1], "--convergence") == 0) {
        for (const bool accelerated : {false, true})
            for (const bool warm : {false, true})
                benchmarks::convergence<solvers::Frictional>("friction", accelerated, warm);
        for (const bool accelerated : {false, true})
            benchmarks::convergence<solvers::Frictionless>("frictionless", accelerated, false);
        return 0;
    }
    benchmark::AddCustomContext("simd", simd_name());
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
