#include "core/parallel/halo.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace scree {
namespace {

constexpr double kStepsAhead = 10.0;   // a halo should last this many steps,
constexpr double kLeastRoom = 0.1;     // a resting body may move by this share of its radius,
constexpr double kMostRoom = 2.0;      // and a fast one by no more than this
constexpr double kMoreMargin = 1.5;    // margins may grow by this factor
constexpr double kLeastMargin = 0.01;  // and are at least this share of a block: pushes of the correction

}  // namespace

double room_to_move(double radius, double speed, double step, double margin) {
    return kMoreMargin * margin + std::clamp(kStepsAhead * step * speed, kLeastRoom * radius, kMostRoom * radius);
}
double margin_covered(double largest, double block_size) {
    return kMoreMargin * largest + kLeastMargin * block_size;
}
double reach(double radius, double room, double covered) {
    return radius + room + 0.5 * covered;
}

void Halo::rebuild(const Partition& partition, const Settings& settings, const std::vector<double>& margin,
                   State& state) {
    if (ranks_.alone()) return;
    ++rebuilds_;
    partition_ = &partition;
    settings_ = settings;
    outdated_ = false;
    Bodies& bodies = state.bodies;
    keep_holders(bodies);
    double most = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!bodies.is_ghost(i)) most = std::max(most, margin[i]);
    most_margin_ = margin_covered(ranks_.max(most), settings.block_size);
    std::vector<double> room(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        room[i] = room_to_move(bodies.radius[i], bodies.velocity[i].norm(), settings.step, margin[i]);
    // ranks without a body know by the others which arrays there are
    const Bodies::Arrays arrays = arrays_of_all(bodies, ranks_);
    std::vector<BodyMessage> now = decide(partition, settings, bodies, room);
    exchange(bodies, now, arrays);
    const std::vector<BodyId> before = bodies.id;
    lay_out(now, arrays, bodies);
    forward_impulses(state, partition, settings.block_size, now, before, rebuilds_ == 1);
    index_neighbours();
}

std::vector<Halo::WideBall> Halo::gather_wide(const Bodies& bodies, const Settings& settings,
                                              const std::vector<double>& room) const {
    Packer own;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double reach = scree::reach(bodies.radius[i], room[i], most_margin_);
        if (bodies.is_ghost(i) || 2.0 * reach < settings.block_size) continue;
        const Vec3& x = bodies.position[i];
        own.put(WideBall{x.x(), x.y(), x.z(), reach});
    }
    const std::vector<std::byte> all = ranks_.all_gather(own.bytes);
    std::vector<WideBall> wide;
    for (Unpacker unpacker(all); !unpacker.empty();) wide.push_back(unpacker.get<WideBall>());
    return wide;
}

// The owners say who holds their bodies from now on.
std::vector<BodyMessage> Halo::decide(const Partition& partition, const Settings& settings, const Bodies& bodies,
                                      const std::vector<double>& room) {
    const std::vector<WideBall> wide = gather_wide(bodies, settings, room);
    any_wide_ = !wide.empty();
    const auto near_wide = [&](const Vec3& x, double reach) {  // a wide body is near itself
        return std::any_of(wide.begin(), wide.end(), [&](const WideBall& w) {
            const double far = reach + w.radius;
            return (x - Vec3(w.x, w.y, w.z)).squaredNorm() <= far * far;
        });
    };
    std::vector<BodyMessage> now;
    now.reserve(bodies.size());
    std::vector<int>& holders = holders_;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const Vec3& x = bodies.position[i];
        BodyMessage body{raw(bodies.id[i]), ranks_.rank(), room[i], {}, true, body_data(bodies, i)};
        if (settings.migrate) body.owner = partition.owner(block_of(x, settings.block_size));
        const double reach = scree::reach(bodies.radius[i], room[i], most_margin_);
        const Vec3 corner = Vec3::Constant(reach);
        holders.clear();
        partition.owners(block_of(x - corner, settings.block_size), block_of(x + corner, settings.block_size), holders);
        holders.push_back(body.owner);
        if (near_wide(x, reach)) holders.push_back(kWideRank);
        std::sort(holders.begin(), holders.end());
        holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
        if (holders.size() > 1) body.holders = holders;
        if (body.owner != ranks_.rank()) ++migrated_;
        now.push_back(std::move(body));
    }
    return now;
}

// Those who held a body, and those who will, hear of it from its owner; the latter get it whole.
void Halo::exchange(const Bodies& bodies, std::vector<BodyMessage>& now, const Bodies::Arrays& arrays) {
    Outbox out;
    std::size_t own = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const BodyMessage& body = now[own++];
        if (body.holders.empty() && body.owner == ranks_.rank() && other_[i].empty()) continue;  // most
        const std::vector<int> alone{body.owner}, &holders = body.holders.empty() ? alone : body.holders;
        std::vector<int> to;
        std::set_union(holders.begin(), holders.end(), other_[i].begin(), other_[i].end(), std::back_inserter(to));
        for (const int rank : to) {
            if (rank == ranks_.rank()) continue;
            const bool held = std::binary_search(other_[i].begin(), other_[i].end(), rank);
            body.put(out[rank], body.held_by(rank) && !held, arrays);
        }
    }
    const std::vector<Communicator::Message> outgoing = out.take();
    for (const Communicator::Message& message : outgoing) {
        ++traffic_.messages;
        traffic_.bytes += message.bytes.size();
    }
    for (const auto& message : ranks_.exchange(outgoing))
        for (Unpacker unpacker(message.bytes); !unpacker.empty();) {
            BodyMessage body = BodyMessage::get(unpacker, arrays);
            if (!body.has_data) {
                const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), BodyId{body.id});
                body.data = body_data(bodies, static_cast<std::size_t>(at - bodies.id.begin()));
            }
            now.push_back(std::move(body));
        }
    const auto by_id = [](const BodyMessage& a, const BodyMessage& b) { return a.id < b.id; };
    const auto middle = now.begin() + static_cast<std::ptrdiff_t>(own);
    std::sort(middle, now.end(), by_id);
    std::inplace_merge(now.begin(), middle, now.end(), by_id);
}

void Halo::lay_out(std::vector<BodyMessage>& now, const Bodies::Arrays& arrays, Bodies& bodies) {
    Bodies laid;
    other_.clear();
    place_.clear();
    room_.clear();
    for (const BodyMessage& body : now) {
        if (!body.held_by(ranks_.rank())) continue;
        laid.id.push_back(BodyId{body.id});
        append_body(body.data, arrays, laid);
        laid.ghost.push_back(body.owner == ranks_.rank() ? 0 : 1);
        other_.push_back(body.holders);
        if (!body.holders.empty()) std::erase(other_.back(), ranks_.rank());
        place_.push_back(body.data.position);
        room_.push_back(body.room);
    }
    bodies = std::move(laid);
    id_ = bodies.id;
}

// Bodies came or went since the halo was made: who holds the others is known by their ids.
void Halo::keep_holders(const Bodies& bodies) {
    if (bodies.id == id_) return;
    std::vector<std::vector<int>> other(bodies.size());
    std::size_t k = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        while (k < id_.size() && id_[k] < bodies.id[i]) ++k;
        if (k < id_.size() && id_[k] == bodies.id[i]) other[i] = std::move(other_[k]);
    }
    other_ = std::move(other);
}

void Halo::follow(const Bodies& bodies) {
    if (ranks_.alone() || bodies.id == id_) return;
    if (!std::includes(id_.begin(), id_.end(), bodies.id.begin(), bodies.id.end())) {
        outdated_ = true;
        return;
    }
    keep_holders(bodies);
    std::size_t k = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i, ++k) {
        while (id_[k] != bodies.id[i]) ++k;
        place_[i] = place_[k];
        room_[i] = room_[k];
    }
    place_.resize(bodies.size());
    room_.resize(bodies.size());
    id_ = bodies.id;
    index_neighbours();
}

void Halo::index_neighbours() {
    std::map<int, std::vector<std::uint32_t>> shared;
    shared_.assign(other_.size(), 0);
    for (std::uint32_t i = 0; i < other_.size(); ++i)
        for (const int rank : other_[i]) {
            shared[rank].push_back(i);
            shared_[i] = 1;
        }
    neighbour_.clear();
    neighbour_rank_.clear();
    for (auto& [rank, list] : shared) {
        neighbour_.push_back({rank, std::move(list)});
        neighbour_rank_.push_back(rank);
    }
}

// New room for a body where it is now: as much of what it would like as its holders cover.
bool Halo::renew(std::size_t i, const Bodies& bodies, double margin) {
    if (any_wide_ && ranks_.rank() != kWideRank) return false;
    const Vec3& x = bodies.position[i];
    double room = room_to_move(bodies.radius[i], bodies.velocity[i].norm(), settings_.step, margin);
    // of wide bodies all ranks must hear
    if (2.0 * reach(bodies.radius[i], room, most_margin_) >= settings_.block_size) return false;
    for (;; room = std::max(0.5 * room, margin)) {
        const Vec3 corner = Vec3::Constant(reach(bodies.radius[i], room, most_margin_));
        holders_.clear();
        partition_->owners(block_of(x - corner, settings_.block_size), block_of(x + corner, settings_.block_size),
                           holders_);
        const bool covered = std::all_of(holders_.begin(), holders_.end(), [&](int rank) {
            return rank == ranks_.rank() || std::binary_search(other_[i].begin(), other_[i].end(), rank);
        });
        if (covered) break;
        if (room == margin) return false;
    }
    place_[i] = x;
    room_[i] = room;
    return true;
}

bool Halo::holds(const State& state, const std::vector<double>& margin) {
    if (ranks_.alone()) return true;
    const Bodies& bodies = state.bodies;
    if (outdated_) return false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        if (!(margin[i] <= most_margin_)) return false;
        const double left = room_[i] - margin[i];
        if ((left < 0.0 || (bodies.position[i] - place_[i]).squaredNorm() > left * left) &&
            !renew(i, bodies, margin[i]))
            return false;
    }
    return true;
}

void Halo::max_over_holders(std::vector<double>& value) {
    if (neighbour_.empty()) return;
    std::vector<std::vector<std::byte>> out(neighbour_.size());
    for (std::size_t k = 0; k < neighbour_.size(); ++k) {
        Packer packer;
        for (const std::uint32_t i : neighbour_[k].shared) packer.put(value[i]);
        out[k] = std::move(packer.bytes);
    }
    const auto in = swap(ranks_, neighbour_rank_, out, traffic_);
    for (std::size_t k = 0; k < neighbour_.size(); ++k) {
        Unpacker unpacker(in[k]);
        for (const std::uint32_t i : neighbour_[k].shared) value[i] = std::max(value[i], unpacker.get<double>());
    }
}

std::size_t Halo::bytes() const {
    std::size_t sum = other_.capacity() * sizeof(other_[0]) + shared_.capacity() + place_.capacity() * sizeof(Vec3) +
                      (room_.capacity() + id_.capacity()) * 8;
    for (const auto& list : other_) sum += list.capacity() * sizeof(int);
    for (const Neighbour& k : neighbour_) sum += k.shared.capacity() * 4;
    return sum;
}

}  // namespace scree
