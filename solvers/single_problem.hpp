// The contact problem in single precision: half the bytes a contact, and two blocks side by side in one call of a
// kernel. Blocks of a colour share no moving body, so the sixteen lanes of a batch hold a batch of one block and a
// batch of another, and the result is the one that the blocks would give one after the other.
//
// Units: velocities in the power of two at v_ref, inverse masses in a power of two in the middle of the scene's, levers
// in that of the longest, impulses accordingly: numbers of order 1 whatever the lengths and densities of a scene, and
// scaled without round-off.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/settings.hpp"
#include "solvers/sweeps.hpp"
#include "solvers/to_single.hpp"

namespace scree::solvers {

// The largest numbers of a contact problem, over all ranks.
struct Extremes {
    double fastest = 0.0;   // [m/s] of v and w, of bodies with contacts
    double lightest = 0.0;  // [1/kg] largest inverse mass, or inverse inertia times lever squared
    double heaviest = 0.0;  // [kg] largest mass
    double friction = 0.0;
    double lever = 0.0;  // [m] of bodies that are not spheres: longest, from a centre of mass to a contact
};

// Single precision cannot be what limits the solution: its round-off in velocities lies far below what the tolerance
// lets stand. What is left of it (deep beds, whose impulses are large beside their changes) shows in the residual in
// double precision, with which every solution ends.
bool single_is_enough(const SolverSettings& settings, const Extremes& extremes, double v_ref);

template <class Law>
class SingleProblem {
  public:
    Sweeps<Law, float> sweeps;

    void load(const Sweeps<Law, double>& full, const Layout& layout, const Extremes& extremes, double v_ref);
    // The impulses, in their cones.
    void give_impulses(Sweeps<Law, double>& full) const;

    double velocity_unit() const { return unit_.velocity; }  // [m/s]
    // The order of work, as a Layout gives it for doubles: runs of batches, at whose ends the sum of one of the two
    // blocks, or of both, is complete.
    struct Run {
        std::uint32_t begin, end;
        std::array<bool, 2> ends;
    };
    const std::vector<Run>& blocks() const { return runs_; }
    const Layout::PhaseBlocks& phase(std::size_t k) const { return phase_[k]; }
    std::size_t bytes() const;

  private:
    struct Place {  // of a block: its batches `from` to `to` of the layout are in `half` of the batches from `at` on
        std::uint32_t from, to, at;
        int half;
    };
    void arrange(const Layout& layout);
    // Gives the layout's blocks their places; `next`: the first free batch of each half.
    void deal(const Layout& layout, std::uint32_t from, std::uint32_t to, std::array<std::uint32_t, 2>& next);
    void join_runs(std::size_t first, std::uint32_t at);

    SingleUnits unit_;
    std::vector<Place> places_;
    std::vector<Run> runs_;
    std::array<Layout::PhaseBlocks, kPhases> phase_;
    std::vector<Block> sorted_;
};

extern template class SingleProblem<Frictional>;
extern template class SingleProblem<Frictionless>;
extern template class SingleProblem<RigidFrictional>;
extern template class SingleProblem<RigidFrictionless>;

}  // namespace scree::solvers
