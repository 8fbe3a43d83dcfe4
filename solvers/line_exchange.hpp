// Velocities of shared bodies travel between ranks after each colour of a sweep: those that this rank's blocks of the
// colour touched go to the ranks that touch them too. Which they are is settled once a step, by one message to each
// neighbour; after that each message is bare numbers.
//
// Phases 0 to 7 are the colours, 8 are the contacts of bodies wider than a block; the last phase brings the bodies to
// the ranks that hold them and touch them not.
#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel/halo.hpp"
#include "solvers/layout.hpp"

namespace scree::solvers {

class LineExchange {
  public:
    static constexpr std::size_t kLast = kPhases;  // the phase after all others

    // Collective among neighbours. `numbers` a body travel.
    void set_up(const Communicator& ranks, Halo& halo, const contact::ContactSet& contacts, const Layout& layout,
                std::size_t numbers);
    bool idle() const { return neighbours_ == 0; }

    // After this rank's blocks of the phase that touch shared bodies; and after all of them.
    template <class Line>
    void send(std::size_t phase, const Line* line);
    template <class Line>
    void receive(std::size_t phase, Line* line);
    template <class Line>
    void spread(Line* line) {
        send(kLast, line);
        receive(kLast, line);
    }
    Traffic& traffic() { return messages_.traffic(); }

  private:
    std::size_t neighbours_ = 0;
    // lines of each message, [phase][neighbour]
    std::vector<std::vector<std::vector<std::uint32_t>>> out_, in_;
    std::vector<std::uint16_t> touched_;  // one a body: a bit a phase
    PhasedExchange messages_;
};

}  // namespace scree::solvers
