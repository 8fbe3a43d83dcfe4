// Who holds which body. A body belongs to one rank: the owner of the block that holds its centre when bodies change
// ranks. It is also held, as a ghost, by every rank that owns a block into which it may reach: then each contact has
// both its bodies on the rank that owns the block of the contact point, and that rank solves it. All ranks that hold a
// body move it alike, with the same bits; what one rank alone computes (impulses' effect, pushes) they tell each other.
//
// A body may reach a block within  r_i + s_i + e / 2  of its centre: s_i is room to move, and a contact point lies off
// the body by half the gap, at most (m_i + m_j) / 2, m_i the margin within which contacts are looked for. The halo
// holds as long as |x_i - x_i(then)| + m_i <= s_i and m_i <= e for every body. A body that leaves its room, but comes
// no nearer to ranks that do not hold it, gets new room where it is: most do.
//
// Bodies too wide for a block have their contacts with rank 0, which holds them and all that is near them: they are
// meant to be few.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/body_message.hpp"
#include "core/parallel/communicator.hpp"
#include "core/parallel/neighbour_messages.hpp"
#include "core/parallel/partition.hpp"
#include "core/state.hpp"

namespace scree {

inline constexpr int kWideRank = 0;  // solves the contacts of bodies wider than a block

// s_i [m] of a body: room for its margin and for its motion in the next steps, so that the halo lasts.
double room_to_move(double radius, double speed, double step, double margin = 0.0);
// e [m]: margins up to it are covered, `largest` being the largest of now.
double margin_covered(double largest, double block_size);
// [m] from the centre to the farthest block that the body may have to do with.
double reach(double radius, double room, double covered);

class Halo {
  public:
    explicit Halo(const Communicator& ranks) : ranks_(ranks) {}

    // Collective: makes the halo anew from where the bodies are; with `migrate` each body goes to the owner of its
    // block first. `margin`: of each body in state.bodies [m]. `step`: h [s], to judge how far bodies will move.
    // Impulses of the last step follow their bodies. Ids stay in order; indices change.
    struct Settings {
        double block_size;  // [m]
        double step;        // [s]
        bool migrate;
    };
    void rebuild(const Partition& partition, const Settings& settings, const std::vector<double>& margin, State& state);
    // Bodies went: those that are left keep their holders. If there are new ones the halo no longer holds. Not
    // collective.
    void follow(const Bodies& bodies);
    // Whether the ranks that hold a body of this rank are still enough. Not collective.
    bool holds(const State& state, const std::vector<double>& margin);

    // Another rank that holds bodies of this one, and which: indices into state.bodies, in order of id, the same list
    // on both sides.
    struct Neighbour {
        int rank;
        std::vector<std::uint32_t> shared;
    };
    const std::vector<Neighbour>& neighbours() const { return neighbour_; }
    std::span<const int> neighbour_ranks() const { return neighbour_rank_; }
    // Held by other ranks too.
    bool shared(std::size_t body) const { return !shared_.empty() && shared_[body] != 0; }
    const std::vector<std::uint8_t>& shared_flags() const { return shared_; }

    // The largest of the values [one a body] that any holder of a body has; messages to neighbours.
    void max_over_holders(std::vector<double>& value);
    // `which` of the impulses go to the neighbours that hold both bodies: this rank has no contact for them any more,
    // and a neighbour may have. Returns those that came, in order of key. Messages to neighbours.
    WarmStart pass_on(const WarmStart& impulses, std::span<const std::uint32_t> which, const Bodies& bodies);

    std::uint64_t rebuilds() const { return rebuilds_; }
    std::uint64_t migrated() const { return migrated_; }  // bodies that this rank gave away
    Traffic& traffic() { return traffic_; }
    std::size_t bytes() const;

  private:
    // A body wider than a block, with its room; all ranks know them all.
    struct WideBall {
        double x, y, z, radius;
    };
    void keep_holders(const Bodies& bodies);
    bool renew(std::size_t i, const Bodies& bodies, double margin);
    std::vector<WideBall> gather_wide(const Bodies& bodies, const Settings& settings,
                                      const std::vector<double>& room) const;
    std::vector<BodyMessage> decide(const Partition& partition, const Settings& settings, const Bodies& bodies,
                                    const std::vector<double>& room);
    void exchange(const Bodies& bodies, std::vector<BodyMessage>& bodies_now, const Bodies::Arrays& arrays);
    void lay_out(std::vector<BodyMessage>& bodies_now, const Bodies::Arrays& arrays, Bodies& bodies);
    void index_neighbours();
    bool takes_impulse(const ContactKey& key, const Bodies& bodies, const Partition& partition,
                       double block_size) const;
    void forward_impulses(State& state, const Partition& partition, double block_size,
                          const std::vector<BodyMessage>& bodies_now, const std::vector<BodyId>& before, bool first);

    const Communicator& ranks_;
    const Partition* partition_ = nullptr;  // by which the halo was made
    Settings settings_{};
    bool any_wide_ = false;                // bodies wider than a block
    bool outdated_ = true;                 // never made, or there are new bodies
    std::vector<BodyId> id_;               // of the bodies when the halo was made
    std::vector<std::vector<int>> other_;  // other holders of each body, n; empty for most
    std::vector<std::uint8_t> shared_;     // n, or empty with one rank
    std::vector<Neighbour> neighbour_;
    std::vector<int> neighbour_rank_;
    std::vector<Vec3> place_;   // [m] n: where the bodies were when the halo was made
    std::vector<double> room_;  // [m] s, n
    double most_margin_ = 0.0;  // [m] e
    std::vector<int> holders_;  // scratch
    std::uint64_t rebuilds_ = 0, migrated_ = 0;
    Traffic traffic_;
};

}  // namespace scree
