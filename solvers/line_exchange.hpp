// Velocities of shared bodies travel between ranks during a sweep, and only where the order of the sweep needs them.
//
// A body's line is changed in the phases in which a block touches it, and the same blocks touch it in every sweep: so
// it is known which rank changes it, in which phase, and who reads it next. The line goes from the one to the other,
// once: after the phase in which it was changed last, before the phase in which it is read. What was changed last in a
// sweep goes, at its end, to all ranks that touch the body; those that hold it and touch it not get it once, after all
// sweeps (spread). The masks of phases that tell all this are exchanged among neighbours once a step; after that each
// message is bare numbers.
//
// Phases 0 to 7 are the colours, 8 are the contacts of bodies wider than a block.
#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel/halo.hpp"
#include "solvers/layout.hpp"

namespace scree::solvers {

class LineExchange {
  public:
    static constexpr std::size_t kEnd = kPhases;         // the end of a sweep, as a phase
    static constexpr std::size_t kSpread = kPhases + 1;  // after all sweeps

    // Collective among neighbours. At most `numbers` a body travel.
    void set_up(const Communicator& ranks, Halo& halo, const contact::ContactSet& contacts, const Layout& layout,
                std::size_t numbers);
    bool idle() const { return neighbours_ == 0; }

    // What this rank's blocks of the phase read; or, with kEnd, what the next sweep does.
    template <class Line>
    void receive(std::size_t phase, Line* line);
    // After this rank's blocks of the phase that touch shared bodies.
    template <class Line>
    void send(std::size_t phase, const Line* line);
    // After the last sweep: to the ranks that do not touch a body.
    template <class Line>
    void spread(Line* line) {
        send(kSpread, line);
        receive(kSpread, line);
    }
    Traffic& traffic() { return messages_.traffic(); }

  private:
    using PhaseMask = std::uint16_t;
    // Lines that go to, or come from, a neighbour after phase `after` and before phase `before`.
    struct Transfer {
        std::size_t neighbour = 0, after = 0, before = 0;
        std::vector<std::uint32_t> lines;
    };
    void find_touched(const contact::ContactSet& contacts, const Layout& layout);
    void swap_masks(const Communicator& ranks, Halo& halo);
    // For each phase in which `writer` changes a body, its line to whoever reads it next, if that is `reader`.
    void list(PhaseMask writer, PhaseMask reader, PhaseMask all, std::uint32_t line, Transfer* by_phase) const;

    std::size_t neighbours_ = 0;
    std::vector<PhaseMask> touched_, touched_by_all_;  // one a body: a bit a phase
    std::vector<std::vector<PhaseMask>> theirs_;       // of each neighbour, one a shared body
    std::vector<Transfer> out_, in_;                   // [neighbour][after], many of them empty
    RepeatedMessages messages_;
};

}  // namespace scree::solvers
