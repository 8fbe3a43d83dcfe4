#include "solvers/line_exchange.hpp"

#include <cstring>

#include "solvers/lines.hpp"

namespace scree::solvers {
namespace {

// What travels of a line: all that an impulse changes, as doubles in either precision.
template <class Real>
void take(const SpinningLineOf<Real>& line, double* to) {
    for (int d = 0; d < 3; ++d) {
        to[d] = static_cast<double>(line.v[d]);
        to[3 + d] = static_cast<double>(line.w[d]);
    }
}
template <class Real>
void give(const double* from, SpinningLineOf<Real>& line) {
    for (int d = 0; d < 3; ++d) {
        line.v[d] = static_cast<Real>(from[d]);
        line.w[d] = static_cast<Real>(from[3 + d]);
    }
}
template <class Real>
void take(const SlidingLineOf<Real>& line, double* to) {
    for (int d = 0; d < 3; ++d) to[d] = static_cast<double>(line.v[d]);
}
template <class Real>
void give(const double* from, SlidingLineOf<Real>& line) {
    for (int d = 0; d < 3; ++d) line.v[d] = static_cast<Real>(from[d]);
}
template <class Line>
constexpr std::size_t kNumbers = 3;
template <class Real>
constexpr std::size_t kNumbers<SpinningLineOf<Real>> = 6;

}  // namespace

void LineExchange::set_up(const Communicator& ranks, Halo& halo, const contact::ContactSet& contacts,
                          const Layout& layout, std::size_t numbers) {
    const auto& neighbours = halo.neighbours();
    neighbours_ = neighbours.size();
    if (neighbours_ == 0) return;
    touched_.assign(halo.shared_flags().size(), 0);
    for (std::size_t phase = 0; phase < kPhases; ++phase) {
        const Layout::PhaseBlocks& range = layout.phase(phase);
        for (std::uint32_t k = range.begin; k < range.inner; ++k)
            for (std::uint32_t b = layout.blocks()[k].begin; b < layout.blocks()[k].end; ++b)
                for (const std::uint32_t c : layout.lanes()[b]) {
                    if (c == kNoContact) continue;
                    touched_[contacts[c].a] |= static_cast<std::uint16_t>(1U << phase);
                    if (!contacts[c].key.is_wall()) touched_[contacts[c].b] |= static_cast<std::uint16_t>(1U << phase);
                }
    }
    std::vector<std::vector<std::byte>> mine(neighbours_);
    for (std::size_t k = 0; k < neighbours_; ++k) {
        Packer packer;
        for (const std::uint32_t body : neighbours[k].shared) packer.put(touched_[body]);
        mine[k] = std::move(packer.bytes);
    }
    const auto theirs = swap(ranks, halo.neighbour_ranks(), mine, halo.traffic());

    std::vector<std::vector<std::size_t>> out_bytes(kPhases + 1), in_bytes(kPhases + 1);
    out_.resize(kPhases + 1);
    in_.resize(kPhases + 1);
    for (std::size_t phase = 0; phase <= kPhases; ++phase) {
        out_[phase].resize(neighbours_);
        in_[phase].resize(neighbours_);
        for (std::size_t k = 0; k < neighbours_; ++k) {
            out_[phase][k].clear();
            in_[phase][k].clear();
        }
    }
    for (std::size_t k = 0; k < neighbours_; ++k) {
        Unpacker unpacker(theirs[k]);
        for (const std::uint32_t body : neighbours[k].shared) {
            const unsigned here = touched_[body], there = unpacker.get<std::uint16_t>();
            const std::uint32_t line = layout.line(body);
            if (here != 0 && there == 0) out_[kLast][k].push_back(line);
            if (here == 0 && there != 0) in_[kLast][k].push_back(line);
            if (here == 0 || there == 0) continue;
            for (std::size_t phase = 0; phase < kPhases; ++phase) {
                if ((here >> phase & 1) != 0) out_[phase][k].push_back(line);
                if ((there >> phase & 1) != 0) in_[phase][k].push_back(line);
            }
        }
    }
    for (std::size_t phase = 0; phase <= kPhases; ++phase)
        for (std::size_t k = 0; k < neighbours_; ++k) {
            out_bytes[phase].push_back(out_[phase][k].size() * numbers * sizeof(double));
            in_bytes[phase].push_back(in_[phase][k].size() * numbers * sizeof(double));
        }
    messages_.set_up(ranks, halo.neighbour_ranks(), out_bytes, in_bytes);
}

template <class Line>
void LineExchange::send(std::size_t phase, const Line* line) {
    if (idle()) return;
    for (std::size_t k = 0; k < neighbours_; ++k) {
        const auto& lines = out_[phase][k];
        if (lines.empty()) continue;
        auto* to = reinterpret_cast<double*>(messages_.outgoing(phase, k).data());
        for (const std::uint32_t i : lines) {
            take(line[i], to);
            to += kNumbers<Line>;
        }
    }
    messages_.send(phase);
}

template <class Line>
void LineExchange::receive(std::size_t phase, Line* line) {
    if (idle()) return;
    messages_.receive(phase);
    for (std::size_t k = 0; k < neighbours_; ++k) {
        const auto& lines = in_[phase][k];
        if (lines.empty()) continue;
        const auto* from = reinterpret_cast<const double*>(messages_.incoming(phase, k).data());
        for (const std::uint32_t i : lines) {
            give(from, line[i]);
            from += kNumbers<Line>;
        }
    }
}

template void LineExchange::send(std::size_t, const SpinningLineOf<double>*);
template void LineExchange::receive(std::size_t, SpinningLineOf<double>*);
template void LineExchange::send(std::size_t, const SlidingLineOf<double>*);
template void LineExchange::receive(std::size_t, SlidingLineOf<double>*);
template void LineExchange::send(std::size_t, const SpinningLineOf<float>*);
template void LineExchange::receive(std::size_t, SpinningLineOf<float>*);
template void LineExchange::send(std::size_t, const SlidingLineOf<float>*);
template void LineExchange::receive(std::size_t, SlidingLineOf<float>*);

}  // namespace scree::solvers
