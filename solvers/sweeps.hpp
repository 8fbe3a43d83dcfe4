// What a sweep reads and writes, and the sweep itself, in either precision: lines, batches and the order of the
// batches' blocks. All sums are one a block in the order of its batches, then exact sums over the blocks, so that no
// order of blocks and no split over ranks changes a bit.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/aligned_vector.hpp"
#include "core/exact_sum.hpp"
#include "solvers/kernels.hpp"
#include "solvers/layout.hpp"
#include "solvers/line_exchange.hpp"
#include "solvers/rigid_kernels.hpp"

namespace scree::solvers {

inline constexpr std::size_t kFetchAhead = 4;  // batches

// At the end of a run of batches: adds the sums of the blocks that end there, and starts new ones.
inline void close_blocks(ExactSum& total, Pack& sum, const Block&) {
    total.add(sum_lanes(sum));
    sum = Pack::all(0.0);
}
// In single precision two blocks lie side by side; `ends` tells which of them the run ends.
template <class Run>
void close_blocks(ExactSum& total, PackF& sum, const Run& run) {
    alignas(64) float x[kLanesSingle];
    sum.store(x);
    for (std::size_t half = 0; half < 2; ++half) {
        if (!run.ends[half]) continue;
        float* const first = x + half * kLanes;
        total.add(sum_of_eight(first));
        std::fill(first, first + kLanes, 0.0F);
    }
    sum = PackF::load(x);
}

template <class Law, class Real>
struct Sweeps {
    using Line = typename Law::template LineOf<Real>;
    using Batch = typename Law::template BatchOf<Real>;
    using Numbers = PackOf<Real>;
    struct Impulse {
        alignas(64) Real p[Law::kImpulse][Numbers::kLanes];
    };
    // What a sweep changes of a line: its first numbers, or all; masses do not change, but lie among them.
    static constexpr std::size_t kLineNumbers = sizeof(Line) / sizeof(Real);
    static constexpr std::size_t kChanged = Law::kRigid ? 8 : kLineNumbers;
    struct alignas(kChanged * sizeof(Real)) Changed {
        Real x[kChanged];
    };

    LineVector<Line> line;  // ground, bodies, moving-wall contacts
    LineVector<Batch> batch;
    LineVector<Impulse> previous;       // momentum: impulses before the last sweep; empty without acceleration
    LineVector<Changed> line_previous;  // and the lines that belong to them

    // Calls work(from, to) for runs of blocks, phase by phase. Blocks at a border come first in each phase: their
    // results travel while the others are worked on. `order` is a Layout or made from one.
    template <class Order, class Work>
    void by_phase(const Order& order, LineExchange* exchange, const Work& work) {
        for (std::size_t phase = 0; phase < kPhases; ++phase) {
            const Layout::PhaseBlocks& range = order.phase(phase);
            if (exchange != nullptr) exchange->receive(phase, line.data());
            work(range.begin, range.inner);
            if (exchange != nullptr) exchange->send(phase, line.data());
            work(range.inner, range.end);
        }
    }
    // After a pass in which lines travelled, before anything reads them: what was changed last by other ranks. A sum
    // over ranks in between hides the wait.
    void complete(LineExchange* exchange) {
        if (exchange != nullptr) exchange->receive(LineExchange::kEnd, line.data());
    }
    // Calls `per_batch` for each batch. Lines of shared bodies travel if there is an exchange.
    template <class Order, class PerBatch>
    void over_blocks(const Order& order, LineExchange* exchange, const PerBatch& per_batch) {
        by_phase(order, exchange, [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t k = from; k < to; ++k)
                for (std::uint32_t b = order.blocks()[k].begin; b < order.blocks()[k].end; ++b) per_batch(b);
        });
    }
    // The same, and adds what it returns to `total`.
    template <class Order, class PerBatch>
    void sum_over_blocks(const Order& order, LineExchange* exchange, ExactSum& total, const PerBatch& per_batch) {
        Numbers sum = Numbers::all(0);  // a block may go on from the border's run to the next one
        by_phase(order, exchange, [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t k = from; k < to; ++k) {
                const auto& block = order.blocks()[k];
                for (std::uint32_t b = block.begin; b < block.end; ++b) sum = sum + per_batch(b);
                close_blocks(total, sum, block);
            }
        });
    }

    void reset_momentum() {
        previous.resize(batch.size());
        for (std::size_t k = 0; k < batch.size(); ++k)
            for (int d = 0; d < Law::kImpulse; ++d) Numbers::load(batch[k].p[d]).store(previous[k].p[d]);
        line_previous.resize(line.size());
        for (std::size_t k = 0; k < line.size(); ++k) std::copy_n(line[k].v, kChanged, line_previous[k].x);
    }

    // One sweep, to be completed; `moving` lines, from line 1 on, are those of bodies with contacts. Adds |W_N r|^2 of
    // all contacts.
    template <class Order>
    void sweep(const Order& order, LineExchange* exchange, std::size_t moving, double beta, bool momentum,
               ExactSum& squares) {
        const Numbers b = Numbers::all(static_cast<Real>(beta));
        if (momentum) {
            extrapolate(moving, static_cast<Real>(beta));
            sum_over_blocks(order, exchange, squares, [&](std::uint32_t k) {
                fetch(k + kFetchAhead);
                return update<true>(batch[k], line.data(), previous[k].p, b);
            });
        } else {
            sum_over_blocks(order, exchange, squares, [&](std::uint32_t k) {
                fetch(k + kFetchAhead);
                return update<false>(batch[k], line.data(), nullptr, b);
            });
        }
    }

    // Adds |F|^2 of all contacts, F the natural map; returns the largest.
    template <class Order>
    double residual(const Order& order, ExactSum& squares) {
        Numbers largest = Numbers::all(0);
        sum_over_blocks(order, nullptr, squares, [&](std::uint32_t k) {
            const Numbers f = natural_map(batch[k], line.data());
            largest = max(largest, f);
            return f;
        });
        return max_lanes(largest);
    }

    std::size_t bytes() const {
        return line.capacity() * sizeof(Line) + line_previous.capacity() * sizeof(Changed) +
               batch.capacity() * sizeof(Batch) + previous.capacity() * sizeof(Impulse);
    }

  private:
    // The lines of a later batch on their way while this one is solved.
    void fetch(std::size_t k) const {
        if (k >= batch.size()) return;
        for (int i = 0; i < Numbers::kLanes; ++i)
            for (const Line* of : {line.data() + batch[k].a[i], line.data() + batch[k].b[i]}) {
                __builtin_prefetch(of, 1);
                if constexpr (sizeof(Line) > 64) __builtin_prefetch(of->j);
            }
    }
    // now + beta (now - previous), and previous = now, over lines as flat numbers: masses do not change, so their
    // difference is zero and they stay as they are.
    void extrapolate(std::size_t lines, Real beta) {
        if constexpr (kChanged == kLineNumbers)
            extrapolate(line[1].v, line_previous[1].x, lines * kLineNumbers, beta);
        else
            for (std::size_t k = 1; k <= lines; ++k) extrapolate(line[k].v, line_previous[k].x, kChanged, beta);
    }
    static void extrapolate(Real* now, Real* before, std::size_t numbers, Real beta) {
        for (std::size_t i = 0; i < numbers; ++i) {
            const Real x = now[i];
            now[i] = x + beta * (x - before[i]);
            before[i] = x;
        }
    }
};

}  // namespace scree::solvers
