#include "contact/candidate_list.hpp"

#include <algorithm>

namespace scree::contact {
namespace {

constexpr double kStepsAhead = 10.0;  // a list should last this many steps,
constexpr double kLeastSlack = 0.03;  // a resting body may move by this share of its radius,
constexpr double kMostSlack = 0.4;    // and a fast one by no more than this: wide lists cost more than new ones

}  // namespace

bool CandidateList::still_holds(const State& state, double time, const std::vector<double>& margin) const {
    const Bodies& bodies = state.bodies;
    if (!valid_ || bodies.id != id_ || time > valid_until_) return false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double room = slack_[i] - margin[i];
        const double dx = bodies.position[i].x() - ball_[i].x, dy = bodies.position[i].y() - ball_[i].y,
                     dz = bodies.position[i].z() - ball_[i].z;
        if (room < 0.0 || dx * dx + dy * dy + dz * dz > room * room) return false;
    }
    return true;
}

bool CandidateList::bring(const Scene& scene, const State& state, double step, double time,
                          const std::vector<double>& margin, const Communicator& ranks) {
    place_walls(scene, time, state.time + 0.5 * step);
    margin_ = margin;
    if (!ranks.any(!still_holds(state, time, margin))) return false;
    const Bodies& bodies = state.bodies;
    const std::size_t n = bodies.size();
    ball_.resize(n);
    slack_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double travel = kStepsAhead * step * bodies.velocity[i].norm();
        slack_[i] = 1.5 * margin[i] + std::clamp(travel, kLeastSlack * bodies.radius[i], kMostSlack * bodies.radius[i]);
        const Vec3& x = bodies.position[i];
        ball_[i] = {x.x(), x.y(), x.z(), bodies.radius[i] + slack_[i]};
    }
    id_ = bodies.id;
    rebuild_pairs(n);
    rebuild_walls(scene, state, step, time);
    valid_ = true;
    ++rebuilds_;
    return true;
}

void CandidateList::follow(const std::vector<BodyId>& id) {
    if (!valid_ || id == id_) return;
    if (!std::includes(id_.begin(), id_.end(), id.begin(), id.end())) {
        valid_ = false;
        return;
    }
    constexpr std::uint32_t kGone = 0xffffffffU;
    std::vector<std::uint32_t> now(id_.size(), kGone);  // index of each body of the list
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < id_.size() && next < id.size(); ++i)
        if (id_[i] == id[next]) now[i] = next++;
    // what is kept moves down in the arrays, never up
    std::uint32_t pairs = 0, walls = 0, begin = 0, wall_begin = 0;
    for (std::size_t i = 0; i < id_.size(); ++i) {
        const std::uint32_t end = partner_begin_[i + 1], wall_end = wall_begin_[i + 1];
        if (now[i] != kGone) {
            for (std::uint32_t k = begin; k < end; ++k)
                if (now[partner_[k]] != kGone) partner_[pairs++] = now[partner_[k]];
            for (std::uint32_t k = wall_begin; k < wall_end; ++k) wall_[walls++] = wall_[k];
            ball_[now[i]] = ball_[i];
            slack_[now[i]] = slack_[i];
            partner_begin_[now[i] + 1] = pairs;
            wall_begin_[now[i] + 1] = walls;
        }
        begin = end;
        wall_begin = wall_end;
    }
    ball_.resize(id.size());
    slack_.resize(id.size());
    partner_begin_.resize(id.size() + 1);
    wall_begin_.resize(id.size() + 1);
    partner_.resize(pairs);
    wall_.resize(walls);
    id_ = id;
}

// A body has few partners: they are dealt out by body, then sorted body by body.
void CandidateList::rebuild_pairs(std::size_t n) {
    pair_.clear();
    grid_.find_pairs(ball_, pair_);
    partner_begin_.assign(n + 1, 0);
    partner_.resize(pair_.size());
    for (const BodyPair& p : pair_) ++partner_begin_[p.first];
    std::uint32_t end = 0;
    for (std::uint32_t& at : partner_begin_) at = end += at;
    for (const BodyPair& p : pair_) partner_[--partner_begin_[p.first]] = p.second;
    for (std::size_t i = 0; i < n; ++i)
        std::sort(partner_.begin() + partner_begin_[i], partner_.begin() + partner_begin_[i + 1]);
}

void CandidateList::place_walls(const Scene& scene, double time, double present_at) {
    frame_.resize(scene.walls.size());
    for (std::size_t w = 0; w < frame_.size(); ++w) {
        const Wall& wall = scene.walls[w];
        frame_[w] = {wall.present(present_at), wall.motion.moves(), pose_at(wall.motion, time), bounds(wall.shape)};
    }
}

void CandidateList::rebuild_walls(const Scene& scene, const State& state, double step, double time) {
    const std::size_t n = state.bodies.size();
    const double life = kStepsAhead * step;
    valid_until_ = kForever;
    for (const WallFrame& frame : frame_)
        if (frame.moves) valid_until_ = time + life;
    wall_begin_.assign(n + 1, 0);
    wall_.clear();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 x(ball_[i].x, ball_[i].y, ball_[i].z);
        for (std::uint32_t w = 0; w < frame_.size(); ++w) {
            const Wall& wall = scene.walls[w];
            double reach = slack_[i];
            if (frame_[w].moves) reach += life * speed_bound(wall.motion, x, ball_[i].radius, time, life);
            const Vec3 local = frame_[w].pose.to_local(x);
            const double width = state.bodies.radius[i] + reach;
            if ((local - frame_[w].bounds.lower).minCoeff() < -width ||
                (frame_[w].bounds.upper - local).minCoeff() < -width)
                continue;
            WallContacts found;
            find_contacts(wall.shape, local, state.bodies.radius[i], reach, found);
            if (found.count > 0) wall_.push_back(w);
        }
        wall_begin_[i + 1] = static_cast<std::uint32_t>(wall_.size());
    }
}

std::size_t CandidateList::bytes() const {
    return grid_.bytes() + ball_.capacity() * sizeof(Ball) + (slack_.capacity() + margin_.capacity()) * 8 +
           pair_.capacity() * sizeof(BodyPair) +
           (partner_begin_.capacity() + wall_begin_.capacity() + partner_.capacity() + wall_.capacity()) * 4;
}

}  // namespace scree::contact
