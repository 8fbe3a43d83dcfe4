#include "solvers/line_exchange.hpp"

#include <cstring>

#include "solvers/lines.hpp"

namespace scree::solvers {
namespace {

// What travels of a line: all that an impulse changes.
void take(const SpinningLine& line, double* to) {
    for (int d = 0; d < 3; ++d) {
        to[d] = line.v[d];
        to[3 + d] = line.w[d];
    }
}
void give(const double* from, SpinningLine& line) {
    for (int d = 0; d < 3; ++d) {
        line.v[d] = from[d];
        line.w[d] = from[3 + d];
    }
}
void take(const SlidingLine& line, double* to) {
    for (int d = 0; d < 3; ++d) to[d] = line.v[d];
}
void give(const double* from, SlidingLine& line) {
    for (int d = 0; d < 3; ++d) line.v[d] = from[d];
}
template <class Line>
constexpr std::size_t kNumbers = 3;
template <>
constexpr std::size_t kNumbers<SpinningLine> = 6;

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

template void LineExchange::send(std::size_t, const SpinningLine*);
template void LineExchange::send(std::size_t, const SlidingLine*);
template void LineExchange::receive(std::size_t, SpinningLine*);
template void LineExchange::receive(std::size_t, SlidingLine*);

}  // namespace scree::solvers
