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
#include "contact/sorted_rows.hpp"
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
    bool zones;  // of other materials than the wall's
};

class CandidateList {
  public:
    // Makes sure that the list holds all that is within the margins [m], one a body, of the positions in state.bodies:
    // those of the middle of the step from state.time on, or those of its end. Walls stand where they are then.
    // Returns true if the list may hold pairs or walls that it did not hold before.
    // `ranks`: those who make their lists anew together, lest each waits for the others in turn; update() is
    // collective.
    bool update(const Scene& scene, const State& state, double step, const std::vector<double>& margin,
                const Communicator& ranks = Communicator::self()) {
        return bring(scene, state, step, state.time + 0.5 * step, margin, ranks);
    }
    bool update_at_end(const Scene& scene, const State& state, double step, const std::vector<double>& margin) {
        return bring(scene, state, step, state.time + step, margin, Communicator::self());
    }
    // Bodies came, went or changed places in the arrays; they are known by their ids.
    void invalidate() { indices_hold_ = false; }

    // Partners j > i of body i, increasing; walls near body i, increasing.
    std::span<const std::uint32_t> partners(std::size_t i) const { return partners_[i]; }
    std::span<const std::uint32_t> walls(std::size_t i) const { return walls_[i]; }
    std::size_t pairs() const { return partners_.size(); }
    double margin(std::size_t i) const { return margin_[i]; }             // [m] of the last update
    const std::vector<WallFrame>& wall_frames() const { return frame_; }  // one a wall of the scene
    std::uint64_t rebuilds() const { return rebuilds_; }                  // lists made anew, all bodies at once
    std::size_t bytes() const;

  private:
    bool bring(const Scene& scene, const State& state, double step, double time, const std::vector<double>& margin,
               const Communicator& ranks);
    void place_walls(const Scene& scene, double time, double present_at);
    bool match_bodies(const std::vector<BodyId>& id);
    void find_moved(const State& state);
    void look_at(const State& state, double step, std::size_t i);
    void rebuild_pairs(const State& state, double step);
    bool add_pairs_of_moved(const State& state, double step);
    bool near_wall(const Scene& scene, const State& state, double step, double time, std::size_t i,
                   std::uint32_t w) const;
    void list_walls_near(const Scene& scene, const State& state, double step, double time, std::uint32_t i);
    bool bring_walls(const Scene& scene, const State& state, double step, double time, bool all);

    bool indices_hold_ = false;
    double walls_from_ = 0.0, walls_until_ = 0.0;  // [s] times that the reach of moving walls covers
    std::vector<WallFrame> frame_;
    std::vector<double> margin_;
    std::uint64_t rebuilds_ = 0;
    std::vector<BodyId> id_;            // n, as of the last update
    std::vector<Ball> ball_;            // n, where the body is until it is looked at again; radius r + s
    std::vector<double> slack_;         // [m] s, n; negative: never looked at
    CellGrid grid_;                     // balls of the last list made anew, but for
    std::vector<std::uint32_t> loose_;  // those looked at since, which are in no grid; in no order
    std::vector<std::uint32_t> moved_;  // to be looked at, increasing
    SortedRows partners_, walls_;
    std::size_t pairs_at_rebuild_ = 0;
    std::vector<BodyPair> pair_;
    std::vector<SortedRows::Entry> near_wall_;
};

}  // namespace scree::contact
