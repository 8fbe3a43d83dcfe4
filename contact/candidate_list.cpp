#include "contact/candidate_list.hpp"

#include <algorithm>

namespace scree::contact {
namespace {

constexpr double kStepsAhead = 10.0;  // a body is looked at again after this many steps,
constexpr double kLeastSlack = 0.03;  // a resting one when it has moved by this share of its radius,
constexpr double kMostSlack = 0.4;    // and a fast one by no more than this: wide lists cost more than new looks
constexpr double kAhead = 0.5;        // the ball lies ahead of the body by this share of the slack
// The list is made anew when a body in this many moved since the last update, or in this many since it was last made
// anew, or when so many pairs were added. To look at one body alone costs ten times its share of a new list.
constexpr std::size_t kMovedAtOnce = 32, kLoose = 16, kAdded = 16;

}  // namespace

bool CandidateList::bring(const Scene& scene, const State& state, double step, double time,
                          const std::vector<double>& margin, const Communicator& ranks) {
    place_walls(scene, time, state.time + 0.5 * step);
    margin_ = margin;
    const std::size_t n = state.bodies.size();
    const bool matched = indices_hold_ && id_.size() == n ? true : match_bodies(state.bodies.id);
    if (matched) find_moved(state);
    if (ranks.any(!matched || moved_.size() * kMovedAtOnce > n || loose_.size() * kLoose > n ||
                  partners_.size() > pairs_at_rebuild_ + n / kAdded)) {
        rebuild_pairs(state, step);
        bring_walls(scene, state, step, time, true);
        return true;
    }
    const bool more_pairs = add_pairs_of_moved(state, step);
    const bool more_walls = bring_walls(scene, state, step, time, time < walls_from_ || time > walls_until_);
    return more_pairs || more_walls;
}

// Bodies are where their ids are now: the list follows. False if too many came or went.
bool CandidateList::match_bodies(const std::vector<BodyId>& id) {
    indices_hold_ = true;
    const std::size_t n = id.size(), old = id_.size();
    std::vector<std::uint32_t> place(old, SortedRows::kGone);
    std::size_t known = 0;
    for (std::size_t i = 0, k = 0; i < n && k < old;) {
        if (id[i] == id_[k]) place[k] = static_cast<std::uint32_t>(i), ++known;
        const bool next = id[i] <= id_[k], next_old = id_[k] <= id[i];
        i += next ? 1 : 0;
        k += next_old ? 1 : 0;
    }
    id_ = id;
    if ((n + old - 2 * known) * kMovedAtOnce > n) return false;
    if (known == n && known == old) return true;
    std::vector<Ball> ball(n);
    std::vector<double> slack(n, -1.0);
    for (std::size_t k = 0; k < old; ++k) {
        if (place[k] == SortedRows::kGone) continue;
        ball[place[k]] = ball_[k];
        slack[place[k]] = slack_[k];
    }
    ball_.swap(ball);
    slack_.swap(slack);
    grid_.rename(place, n);
    for (std::uint32_t& i : loose_) i = place[i];
    std::erase(loose_, SortedRows::kGone);
    partners_.move_rows(place, n, true);
    walls_.move_rows(place, n, false);
    return true;
}

void CandidateList::find_moved(const State& state) {
    const std::vector<Vec3>& position = state.bodies.position;
    moved_.clear();
    for (std::size_t i = 0; i < position.size(); ++i) {
        const double room = slack_[i] - margin_[i];
        const double dx = position[i].x() - ball_[i].x, dy = position[i].y() - ball_[i].y,
                     dz = position[i].z() - ball_[i].z;
        if (room < 0.0 || dx * dx + dy * dy + dz * dz > room * room) moved_.push_back(static_cast<std::uint32_t>(i));
    }
}

void CandidateList::look_at(const State& state, double step, std::size_t i) {
    const Bodies& bodies = state.bodies;
    const Vec3& v = bodies.velocity[i];
    const double most = kMostSlack * bodies.radius[i], travel = kStepsAhead * step * v.norm();
    slack_[i] = 1.5 * margin_[i] + std::clamp(travel, kLeastSlack * bodies.radius[i], most);
    const double share = kAhead * (travel > most ? most / travel : 1.0);
    const Vec3 x = bodies.position[i] + share * kStepsAhead * step * v;
    ball_[i] = {x.x(), x.y(), x.z(), bodies.radius[i] + slack_[i]};
}

void CandidateList::rebuild_pairs(const State& state, double step) {
    const std::size_t n = state.bodies.size();
    ball_.resize(n);
    slack_.resize(n);
    for (std::size_t i = 0; i < n; ++i) look_at(state, step, i);
    moved_.clear();
    loose_.clear();
    pair_.clear();
    grid_.find_pairs(ball_, pair_);
    partners_.assign(n, pair_);
    pairs_at_rebuild_ = pair_.size();
    ++rebuilds_;
}

// Returns true if there are new pairs.
bool CandidateList::add_pairs_of_moved(const State& state, double step) {
    if (moved_.empty()) return false;
    for (const std::uint32_t i : moved_) {
        if (grid_.holds(i))
            grid_.take_out(i), loose_.push_back(i);
        else if (slack_[i] < 0.0)
            loose_.push_back(i);
        look_at(state, step, i);
    }
    pair_.clear();
    for (const std::uint32_t i : moved_) {
        const Ball& ball = ball_[i];
        grid_.find_partners(i, ball, pair_);
        for (const std::uint32_t k : loose_)
            if (k != i && overlap(ball, ball_[k])) pair_.emplace_back(std::min(i, k), std::max(i, k));
    }
    return partners_.insert(pair_);
}

void CandidateList::place_walls(const Scene& scene, double time, double present_at) {
    frame_.resize(scene.walls.size());
    for (std::size_t w = 0; w < frame_.size(); ++w) {
        const Wall& wall = scene.walls[w];
        frame_[w] = {wall.present(present_at), wall.motion.moves(), pose_at(wall.motion, time), bounds(wall.shape),
                     has_zones(wall.shape)};
    }
}

bool CandidateList::near_wall(const Scene& scene, const State& state, double step, double time, std::size_t i,
                              std::uint32_t w) const {
    const Wall& wall = scene.walls[w];
    const Vec3 x(ball_[i].x, ball_[i].y, ball_[i].z);
    const double radius = state.bodies.radius[i];
    double reach = slack_[i];
    if (frame_[w].moves)
        reach += kStepsAhead * step * speed_bound(wall.motion, x, ball_[i].radius, time, kStepsAhead * step);
    const Vec3 local = frame_[w].moves ? frame_[w].pose.to_local(x) : x;
    const double width = radius + reach;
    if ((local - frame_[w].bounds.lower).minCoeff() < -width || (frame_[w].bounds.upper - local).minCoeff() < -width)
        return false;
    return may_touch(wall.shape, local, radius, reach);
}

void CandidateList::list_walls_near(const Scene& scene, const State& state, double step, double time, std::uint32_t i) {
    for (std::uint32_t w = 0; w < frame_.size(); ++w)
        if (near_wall(scene, state, step, time, i, w)) near_wall_.emplace_back(i, w);
}

// Of all bodies, or of those that moved. Returns true if there may be new ones.
bool CandidateList::bring_walls(const Scene& scene, const State& state, double step, double time, bool all) {
    near_wall_.clear();
    if (!all) {
        for (const std::uint32_t i : moved_) list_walls_near(scene, state, step, time, i);
        return walls_.insert(near_wall_);
    }
    const auto n = static_cast<std::uint32_t>(state.bodies.size());
    for (std::uint32_t i = 0; i < n; ++i) list_walls_near(scene, state, step, time, i);
    walls_.assign(n, near_wall_);
    walls_from_ = -kForever;
    walls_until_ = kForever;
    for (const WallFrame& frame : frame_)
        if (frame.moves) walls_from_ = time, walls_until_ = time + kStepsAhead * step;
    return true;
}

std::size_t CandidateList::bytes() const {
    return grid_.bytes() + ball_.capacity() * sizeof(Ball) +
           (id_.capacity() + slack_.capacity() + margin_.capacity()) * 8 + (loose_.capacity() + moved_.capacity()) * 4 +
           partners_.bytes() + walls_.bytes() + (pair_.capacity() + near_wall_.capacity()) * sizeof(BodyPair);
}

}  // namespace scree::contact
