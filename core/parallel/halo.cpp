#include "core/parallel/halo.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace scree {
namespace {

constexpr double kStepsAhead = 10.0;   // a halo should last this many steps,
constexpr double kLeastRoom = 0.1;     // a resting body may move by this share of its radius,
constexpr double kMostRoom = 2.0;      // and a fast one by no more than this
constexpr double kMoreMargin = 1.5;    // margins may grow by this factor
constexpr double kLeastMargin = 0.01;  // and are at least this share of a block: pushes of the correction

struct WideBall {
    std::uint64_t id;
    double x, y, z, radius;  // with its room
};

// All of a body that changes ranks.
void put_body(Packer& packer, const Bodies& bodies, std::size_t i) {
    packer.put(bodies.radius[i]);
    packer.put(bodies.mass[i]);
    packer.put(bodies.material[i]);
    for (int d = 0; d < 3; ++d) packer.put(bodies.position[i][d]);
    for (int d = 0; d < 3; ++d) packer.put(bodies.velocity[i][d]);
    if (bodies.has_spin())
        for (int d = 0; d < 3; ++d) packer.put(bodies.spin[i][d]);
    if (bodies.has_orientation())
        for (int d = 0; d < 4; ++d) packer.put(bodies.orientation[i].coeffs()[d]);
}

struct BodyData {
    double radius = 0.0, mass = 0.0;
    MaterialIndex material{};
    Vec3 position, velocity, spin;
    Quat orientation;
};

Vec3 get_vector(Unpacker& unpacker) {
    Vec3 v;
    for (int d = 0; d < 3; ++d) v[d] = unpacker.get<double>();
    return v;
}

BodyData get_body(Unpacker& unpacker, bool spin, bool orientation) {
    BodyData b;
    b.radius = unpacker.get<double>();
    b.mass = unpacker.get<double>();
    b.material = unpacker.get<MaterialIndex>();
    b.position = get_vector(unpacker);
    b.velocity = get_vector(unpacker);
    if (spin) b.spin = get_vector(unpacker);
    if (orientation)
        for (int d = 0; d < 4; ++d) b.orientation.coeffs()[d] = unpacker.get<double>();
    return b;
}

BodyData body_data(const Bodies& bodies, std::size_t i) {
    BodyData b;
    b.radius = bodies.radius[i];
    b.mass = bodies.mass[i];
    b.material = bodies.material[i];
    b.position = bodies.position[i];
    b.velocity = bodies.velocity[i];
    if (bodies.has_spin()) b.spin = bodies.spin[i];
    if (bodies.has_orientation()) b.orientation = bodies.orientation[i];
    return b;
}

std::vector<Communicator::Message> to_messages(std::map<int, Packer>& packers) {
    std::vector<Communicator::Message> messages;
    for (auto& [rank, packer] : packers) messages.push_back({rank, std::move(packer.bytes)});
    return messages;
}

bool contains(const std::vector<int>& sorted, int rank) {
    return std::binary_search(sorted.begin(), sorted.end(), rank);
}

}  // namespace

// What the owner tells of a body: its new owner and all who hold it; the body itself to those who have not had it.
struct Halo::Record {
    std::uint64_t id;
    int owner;
    std::vector<int> holders;  // increasing
    bool has_data;
    BodyData data;
    double room;
};

void Halo::rebuild(const Partition& partition, const Settings& settings, const std::vector<double>& margin,
                   State& state) {
    if (ranks_.alone()) return;
    ++rebuilds_;
    Bodies& bodies = state.bodies;
    const std::size_t n = bodies.size();
    const int me = ranks_.rank();
    const bool spin = ranks_.any(bodies.has_spin()), orientation = ranks_.any(bodies.has_orientation());
    follow(bodies);

    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        if (!bodies.is_ghost(i)) most = std::max(most, margin[i]);
    most_margin_ = kMoreMargin * ranks_.max(most) + kLeastMargin * settings.block_size;
    const auto room = [&](std::size_t i) {
        const double travel = kStepsAhead * settings.step * bodies.velocity[i].norm(), r = bodies.radius[i];
        return kMoreMargin * margin[i] + std::clamp(travel, kLeastRoom * r, kMostRoom * r);
    };

    // all ranks know the few that are wider than a block
    Packer wide_own;
    std::vector<std::uint8_t> is_wide(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        if (bodies.is_ghost(i)) continue;
        const double reach = bodies.radius[i] + room(i) + most_margin_;
        if (2.0 * reach < settings.block_size) continue;
        is_wide[i] = 1;
        const Vec3& x = bodies.position[i];
        wide_own.put(WideBall{raw(bodies.id[i]), x.x(), x.y(), x.z(), reach});
    }
    std::vector<WideBall> wide;
    const std::vector<std::byte> all_wide = ranks_.all_gather(wide_own.bytes);
    for (Unpacker unpacker(all_wide); !unpacker.empty();) wide.push_back(unpacker.get<WideBall>());
    const auto near_wide = [&](const Vec3& x, double reach) {
        return std::any_of(wide.begin(), wide.end(), [&](const WideBall& w) {
            const double far = reach + w.radius;
            return (x - Vec3(w.x, w.y, w.z)).squaredNorm() <= far * far;
        });
    };

    // owners decide, and tell all who held the body or will
    std::vector<Record> records;
    std::map<int, Packer> out;
    for (std::size_t i = 0; i < n; ++i) {
        if (bodies.is_ghost(i)) continue;
        const Vec3& x = bodies.position[i];
        Record record{raw(bodies.id[i]), me, {}, true, body_data(bodies, i), room(i)};
        if (settings.migrate) record.owner = partition.owner(block_of(x, settings.block_size));
        const double reach = bodies.radius[i] + record.room + most_margin_;
        const Vec3 corner = Vec3::Constant(reach);
        partition.owners(block_of(x - corner, settings.block_size), block_of(x + corner, settings.block_size),
                         record.holders);
        record.holders.push_back(record.owner);
        if (is_wide[i] != 0 || (!wide.empty() && near_wide(x, reach))) record.holders.push_back(kWideRank);
        std::sort(record.holders.begin(), record.holders.end());
        record.holders.erase(std::unique(record.holders.begin(), record.holders.end()), record.holders.end());
        if (record.owner != me) ++migrated_;
        std::vector<int> to = record.holders;
        to.insert(to.end(), other_[i].begin(), other_[i].end());
        std::sort(to.begin(), to.end());
        to.erase(std::unique(to.begin(), to.end()), to.end());
        for (const int rank : to) {
            if (rank == me) continue;
            Packer& packer = out[rank];
            const bool data = contains(record.holders, rank) && !contains(other_[i], rank);
            packer.put(record.id);
            packer.put(static_cast<std::int32_t>(record.owner));
            packer.put(static_cast<std::uint32_t>(record.holders.size()));
            packer.put_all(std::span<const int>(record.holders));
            packer.put(record.room);
            packer.put(static_cast<std::uint8_t>(data ? 1 : 0));
            if (data) put_body(packer, bodies, i);
        }
        records.push_back(std::move(record));
    }
    const auto outgoing = to_messages(out);
    for (const auto& m : outgoing) {
        ++traffic_.messages;
        traffic_.bytes += m.bytes.size();
    }
    const auto body_of = [&](std::uint64_t id) {
        const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), BodyId{id});
        return static_cast<std::size_t>(at - bodies.id.begin());
    };
    for (const auto& message : ranks_.exchange(outgoing)) {
        for (Unpacker unpacker(message.bytes); !unpacker.empty();) {
            Record record{};
            record.id = unpacker.get<std::uint64_t>();
            record.owner = unpacker.get<std::int32_t>();
            record.holders.resize(unpacker.get<std::uint32_t>());
            for (int& rank : record.holders) rank = unpacker.get<int>();
            record.room = unpacker.get<double>();
            record.has_data = unpacker.get<std::uint8_t>() != 0;
            record.data =
                record.has_data ? get_body(unpacker, spin, orientation) : body_data(bodies, body_of(record.id));
            records.push_back(std::move(record));
        }
    }
    std::sort(records.begin(), records.end(), [](const Record& a, const Record& b) { return a.id < b.id; });

    // impulses follow body a; then the bodies are laid out anew
    std::vector<std::uint64_t> id;
    std::vector<std::vector<int>> holders;
    for (const Record& record : records) {
        id.push_back(record.id);
        holders.push_back(record.holders);
    }
    Bodies now;
    other_.clear();
    place_.clear();
    room_.clear();
    for (Record& record : records) {
        if (!contains(record.holders, me)) continue;
        now.id.push_back(BodyId{record.id});
        now.radius.push_back(record.data.radius);
        now.mass.push_back(record.data.mass);
        now.material.push_back(record.data.material);
        now.position.push_back(record.data.position);
        now.velocity.push_back(record.data.velocity);
        if (spin) now.spin.push_back(record.data.spin);
        if (orientation) now.orientation.push_back(record.data.orientation);
        now.ghost.push_back(record.owner == me ? 0 : 1);
        std::erase(record.holders, me);
        other_.push_back(std::move(record.holders));
        place_.push_back(record.data.position);
        room_.push_back(record.room);
    }
    bodies = std::move(now);
    id_ = bodies.id;
    forward_impulses(state, id, holders);
    index_neighbours();
}

// Bodies came or went since the halo was made: who holds the others is known by their ids.
void Halo::follow(const Bodies& bodies) {
    if (bodies.id == id_) return;
    std::vector<std::vector<int>> other(bodies.size());
    std::size_t k = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        while (k < id_.size() && id_[k] < bodies.id[i]) ++k;
        if (k < id_.size() && id_[k] == bodies.id[i]) other[i] = std::move(other_[k]);
    }
    other_ = std::move(other);
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

bool Halo::holds(const State& state, const std::vector<double>& margin, double step_ahead) const {
    if (ranks_.alone()) return true;
    const Bodies& bodies = state.bodies;
    if (bodies.size() != place_.size()) return false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const double left = room_[i] - margin[i] - step_ahead * bodies.velocity[i].norm();
        if (margin[i] > most_margin_ || left < 0.0 || (bodies.position[i] - place_[i]).squaredNorm() > left * left)
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
                      (room_.capacity() + id_.capacity()) * 8 + own_impulse_.capacity();
    for (const auto& list : other_) sum += list.capacity() * sizeof(int);
    for (const Neighbour& k : neighbour_) sum += k.shared.capacity() * 4;
    return sum;
}

}  // namespace scree
