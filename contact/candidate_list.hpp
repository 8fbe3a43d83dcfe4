// The list of bodies and walls that may touch, kept over several steps (Verlet 1967).
//
// Body i may touch what comes within its margin m_i (what it can move in half a step). The list holds every pair closer
// than r_i + r_j + s_i + s_j at the time it was made, and is made anew as soon as one body has moved by more than
// s_i - m_i. A fast body has a wide s_i, a resting one a narrow one: one falling grain does not spoil the list of all.
// The list only bounds the search; which contacts exist is decided by exact gaps, so it leaves no trace in results.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/cell_grid.hpp"
#include "contact/walls/wall_contact.hpp"
#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::contact {

// A wall as it stands at the time of the last update.
struct WallFrame {
    bool present, moves;
    WallPose pose;
    WallBounds bounds;
};

class CandidateList {
  public:
    // Makes sure that the list holds all that is within the margins [m], one a body, of the positions in state.bodies:
    // those of the middle of the step from state.time on, or those of its end. Walls stand where they are then.
    // Returns true if the list was made anew.
    // Collective: all ranks make it anew together, or each would wait for the others in turn.
    bool update(const Scene& scene, const State& state, double step, const std::vector<double>& margin,
                const Communicator& ranks = Communicator::self()) {
        return bring(scene, state, step, state.time + 0.5 * step, margin, ranks);
    }
    bool update_at_end(const Scene& scene, const State& state, double step, const std::vector<double>& margin,
                       const Communicator& ranks = Communicator::self()) {
        return bring(scene, state, step, state.time + step, margin, ranks);
    }
    // Bodies went, or changed places in the arrays in order of id: the list goes on with those that are left. If there
    // are new ones it is forgotten.
    void follow(const std::vector<BodyId>& id);

    // Partners j > i of body i, increasing; walls near body i, increasing.
    std::span<const std::uint32_t> partners(std::size_t i) const {
        return {partner_.data() + partner_begin_[i], partner_.data() + partner_begin_[i + 1]};
    }
    std::span<const std::uint32_t> walls(std::size_t i) const {
        return {wall_.data() + wall_begin_[i], wall_.data() + wall_begin_[i + 1]};
    }
    double margin(std::size_t i) const { return margin_[i]; }             // [m] of the last update
    const std::vector<WallFrame>& wall_frames() const { return frame_; }  // one a wall of the scene
    std::uint64_t rebuilds() const { return rebuilds_; }
    std::size_t bytes() const;

  private:
    bool bring(const Scene& scene, const State& state, double step, double time, const std::vector<double>& margin,
               const Communicator& ranks);
    void place_walls(const Scene& scene, double time, double present_at);
    bool still_holds(const State& state, double time, const std::vector<double>& margin) const;
    void rebuild_pairs(std::size_t n);
    void rebuild_walls(const Scene& scene, const State& state, double step, double time);

    bool valid_ = false;
    double valid_until_ = 0.0;  // [s] the last time that the reach of moving walls covers
    std::vector<WallFrame> frame_;
    std::vector<double> margin_;
    std::uint64_t rebuilds_ = 0;
    CellGrid grid_;
    std::vector<BodyId> id_;     // n
    std::vector<Ball> ball_;     // n, where the list was made; radius r + s
    std::vector<double> slack_;  // [m] s, n
    std::vector<BodyPair> pair_;
    std::vector<std::uint32_t> partner_begin_, wall_begin_;  // n + 1
    std::vector<std::uint32_t> partner_, wall_;
};

}  // namespace scree::contact
