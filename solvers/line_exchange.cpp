#include "solvers/line_exchange.hpp"

#include <algorithm>
#include <bit>
#include <type_traits>

#include "solvers/lines.hpp"
#include "solvers/rigid_lines.hpp"

namespace scree::solvers {
namespace {

// What travels of a line: all that an impulse changes.
template <class Real>
void take(const SpinningLineOf<Real>& line, Real* to) {
    for (int d = 0; d < 3; ++d) {
        to[d] = line.v[d];
        to[3 + d] = line.w[d];
    }
}
template <class Real>
void give(const Real* from, SpinningLineOf<Real>& line) {
    for (int d = 0; d < 3; ++d) {
        line.v[d] = from[d];
        line.w[d] = from[3 + d];
    }
}
template <class Real>
void take(const SlidingLineOf<Real>& line, Real* to) {
    for (int d = 0; d < 3; ++d) to[d] = line.v[d];
}
template <class Real>
void give(const Real* from, SlidingLineOf<Real>& line) {
    for (int d = 0; d < 3; ++d) line.v[d] = from[d];
}
template <class Real>
void take(const RigidLineOf<Real>& line, Real* to) {
    for (int d = 0; d < 3; ++d) {
        to[d] = line.v[d];
        to[3 + d] = line.w[d];
    }
}
template <class Real>
void give(const Real* from, RigidLineOf<Real>& line) {
    for (int d = 0; d < 3; ++d) {
        line.v[d] = from[d];
        line.w[d] = from[3 + d];
    }
}
template <class Line>
using RealOf = std::remove_extent_t<decltype(Line::v)>;
template <class Line>
constexpr std::size_t kNumbers = 3;
template <class Real>
constexpr std::size_t kNumbers<SpinningLineOf<Real>> = 6;
template <class Real>
constexpr std::size_t kNumbers<RigidLineOf<Real>> = 6;

constexpr std::size_t kTransfers = LineExchange::kSpread + 1;  // to one neighbour, at most
constexpr std::size_t kAhead = 2;                              // phases after it was sent, a message is taken

}  // namespace

void LineExchange::find_touched(const contact::ContactSet& contacts, const Layout& layout) {
    for (std::size_t phase = 0; phase < kPhases; ++phase) {
        const auto bit = static_cast<PhaseMask>(1U << phase);
        const Layout::PhaseBlocks& range = layout.phase(phase);
        for (std::uint32_t k = range.begin; k < range.inner; ++k)
            for (std::uint32_t b = layout.blocks()[k].begin; b < layout.blocks()[k].end; ++b)
                for (const std::uint32_t c : layout.lanes()[b]) {
                    if (c == kNoContact) continue;
                    touched_[contacts[c].a] |= bit;
                    if (!contacts[c].key.is_wall()) touched_[contacts[c].b] |= bit;
                }
    }
}

void LineExchange::swap_masks(const Communicator& ranks, Halo& halo) {
    std::vector<std::vector<std::byte>> mine(neighbours_);
    for (std::size_t k = 0; k < neighbours_; ++k) {
        Packer packer;
        for (const std::uint32_t body : halo.neighbours()[k].shared) packer.put(touched_[body]);
        mine[k] = std::move(packer.bytes);
    }
    const auto incoming = swap(ranks, halo.neighbour_ranks(), mine, halo.traffic());
    touched_by_all_ = touched_;
    theirs_.resize(neighbours_);
    for (std::size_t k = 0; k < neighbours_; ++k) {
        theirs_[k].clear();
        Unpacker unpacker(incoming[k]);
        for (const std::uint32_t body : halo.neighbours()[k].shared) {
            theirs_[k].push_back(unpacker.get<PhaseMask>());
            touched_by_all_[body] |= theirs_[k].back();
        }
    }
}

void LineExchange::list(PhaseMask writer, PhaseMask reader, PhaseMask all, std::uint32_t line,
                        Transfer* by_phase) const {
    for (unsigned left = writer; left != 0; left &= left - 1) {
        const auto phase = static_cast<std::size_t>(std::countr_zero(left));
        const unsigned later = static_cast<unsigned>(all) >> (phase + 1);
        std::size_t next = kEnd;
        if (later != 0) {
            next = phase + 1 + static_cast<std::size_t>(std::countr_zero(later));
            if ((reader >> next & 1) == 0) continue;
        } else if (reader == 0) {
            by_phase[kSpread].lines.push_back(line);
            continue;
        }
        // phases go in pairs, where the reader has time: half the messages, and all but the last are there before they
        // are needed
        Transfer& transfer = by_phase[(phase | 1) < next ? phase | 1 : phase];
        transfer.before = std::min({transfer.before, next, transfer.after + kAhead});
        transfer.lines.push_back(line);
    }
}

void LineExchange::set_up(const Communicator& ranks, Halo& halo, const contact::ContactSet& contacts,
                          const Layout& layout, std::size_t numbers) {
    neighbours_ = halo.neighbours().size();
    if (neighbours_ == 0) return;
    touched_.assign(halo.shared_flags().size(), 0);
    find_touched(contacts, layout);
    swap_masks(ranks, halo);
    for (std::vector<Transfer>* transfers : {&out_, &in_}) {
        transfers->resize(neighbours_ * kTransfers);
        for (std::size_t i = 0; i < transfers->size(); ++i) {
            Transfer& t = (*transfers)[i];
            t.neighbour = i / kTransfers;
            t.after = i % kTransfers;
            t.before = t.after == kSpread ? kSpread : kEnd;
            t.lines.clear();
        }
    }
    for (std::size_t k = 0; k < neighbours_; ++k) {
        const std::vector<std::uint32_t>& shared = halo.neighbours()[k].shared;
        for (std::size_t i = 0; i < shared.size(); ++i) {
            const PhaseMask here = touched_[shared[i]], there = theirs_[k][i], all = touched_by_all_[shared[i]];
            const std::uint32_t line = layout.line(shared[i]);
            list(here, there, all, line, out_.data() + k * kTransfers);
            list(there, here, all, line, in_.data() + k * kTransfers);
        }
    }
    const auto messages_of = [&](std::vector<Transfer>& transfers) {
        std::vector<RepeatedMessages::Message> messages;
        for (const Transfer& t : transfers)
            messages.push_back({halo.neighbour_ranks()[t.neighbour], static_cast<int>(t.after),
                                t.lines.size() * numbers * sizeof(double)});
        return messages;
    };
    const auto outgoing = messages_of(out_), incoming = messages_of(in_);
    messages_.set_up(ranks, outgoing, incoming);
}

template <class Line>
void LineExchange::send(std::size_t phase, const Line* line) {
    using Real = RealOf<Line>;
    if (idle()) return;
    for (std::size_t k = 0; k < out_.size(); ++k) {
        if (out_[k].after != phase || out_[k].lines.empty()) continue;
        auto* to = reinterpret_cast<Real*>(messages_.outgoing(k));
        for (const std::uint32_t i : out_[k].lines) {
            take(line[i], to);
            to += kNumbers<Line>;
        }
        messages_.send(k, out_[k].lines.size() * kNumbers<Line> * sizeof(Real));
    }
}

template <class Line>
void LineExchange::receive(std::size_t phase, Line* line) {
    using Real = RealOf<Line>;
    if (idle()) return;
    for (std::size_t k = 0; k < in_.size(); ++k) {
        if (in_[k].before != phase || in_[k].lines.empty()) continue;
        const std::size_t bytes = in_[k].lines.size() * kNumbers<Line> * sizeof(Real);
        const auto* from = reinterpret_cast<const Real*>(messages_.receive(k, bytes));
        for (const std::uint32_t i : in_[k].lines) {
            give(from, line[i]);
            from += kNumbers<Line>;
        }
    }
}

template void LineExchange::send(std::size_t, const SpinningLineOf<double>*);
template void LineExchange::receive(std::size_t, SpinningLineOf<double>*);
template void LineExchange::send(std::size_t, const SlidingLineOf<double>*);
template void LineExchange::receive(std::size_t, SlidingLineOf<double>*);
template void LineExchange::send(std::size_t, const RigidLineOf<double>*);
template void LineExchange::receive(std::size_t, RigidLineOf<double>*);
template void LineExchange::send(std::size_t, const RigidLineOf<float>*);
template void LineExchange::receive(std::size_t, RigidLineOf<float>*);
template void LineExchange::send(std::size_t, const SpinningLineOf<float>*);
template void LineExchange::receive(std::size_t, SpinningLineOf<float>*);
template void LineExchange::send(std::size_t, const SlidingLineOf<float>*);
template void LineExchange::receive(std::size_t, SlidingLineOf<float>*);

}  // namespace scree::solvers
