// Impulses of the last step follow the contacts. Each is kept by one rank, the one that solved it, as long as that rank
// holds both bodies; when another rank solves the contact in the next step, the impulse is passed on then.
#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>

#include "core/parallel/halo.hpp"

namespace scree {
namespace {

// One impulse in a message; without friction its first number alone counts.
struct ImpulseMessage {
    std::uint64_t a, b;
    std::uint64_t feature;
    double p[3];
};

void put_impulse(Packer& packer, const WarmStart& warm, std::size_t k) {
    if (packer.bytes.empty()) packer.put(static_cast<std::uint64_t>(warm.impulse_vector.empty() ? 0 : 1));
    ImpulseMessage m{warm.key[k].a, warm.key[k].b, warm.key[k].feature, {0.0, 0.0, 0.0}};
    if (!warm.impulse_vector.empty())
        for (int d = 0; d < 3; ++d) m.p[d] = warm.impulse_vector[k][d];
    else
        m.p[0] = warm.impulse_normal[k];
    packer.put(m);
}

void add_impulses(std::span<const std::byte> bytes, WarmStart& warm) {
    Unpacker unpacker(bytes);
    if (unpacker.empty()) return;
    const bool vectors = unpacker.get<std::uint64_t>() != 0;
    while (!unpacker.empty()) {
        const auto m = unpacker.get<ImpulseMessage>();
        warm.key.push_back({m.a, m.b, static_cast<std::uint32_t>(m.feature)});
        if (vectors)
            warm.impulse_vector.emplace_back(m.p[0], m.p[1], m.p[2]);
        else
            warm.impulse_normal.push_back(m.p[0]);
    }
}

template <class T>
void take_in_order(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
    if (values.empty()) return;
    std::vector<T> taken;
    taken.reserve(order.size());
    for (const std::uint32_t k : order) taken.push_back(values[k]);
    values = std::move(taken);
}

// Those for which `keep` says so, in order of key.
template <class Keep>
void keep_sorted(WarmStart& warm, const Keep& keep) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t k = 0; k < warm.key.size(); ++k)
        if (keep(k)) order.push_back(k);
    const auto by_key = [&](std::uint32_t x, std::uint32_t y) { return warm.key[x] < warm.key[y]; };
    if (!std::is_sorted(order.begin(), order.end(), by_key)) std::sort(order.begin(), order.end(), by_key);
    take_in_order(warm.impulse_vector, order);
    take_in_order(warm.impulse_normal, order);
    take_in_order(warm.key, order);
}

std::optional<std::size_t> index_of(const std::vector<BodyId>& ids, std::uint64_t id) {
    const auto at = std::lower_bound(ids.begin(), ids.end(), BodyId{id});
    if (at == ids.end() || raw(*at) != id) return std::nullopt;
    return static_cast<std::size_t>(at - ids.begin());
}
bool holds_both(const std::vector<BodyId>& ids, const ContactKey& key) {
    return index_of(ids, key.a) && (key.is_wall() || index_of(ids, key.b));
}

}  // namespace

// Of several ranks that hold both bodies one takes the impulse: the owner of the block between them.
bool Halo::takes_impulse(const ContactKey& key, const Bodies& bodies, const Partition& partition,
                         double block_size) const {
    const auto a = index_of(bodies.id, key.a);
    if (!a) return false;
    if (key.is_wall()) return !bodies.is_ghost(*a);
    const auto b = index_of(bodies.id, key.b);
    if (!b) return false;
    const double share = bodies.radius[*a] / (bodies.radius[*a] + bodies.radius[*b]);
    const Vec3 point = bodies.position[*a] + share * (bodies.position[*b] - bodies.position[*a]);
    return partition.owner(block_of(point, block_size)) == ranks_.rank();
}

// `now`: the bodies of which this rank knows who holds them; `before`: those that it held. At first an impulse lies
// with body a, wherever body b is.
void Halo::forward_impulses(State& state, const Partition& partition, double block_size,
                            const std::vector<BodyMessage>& now, const std::vector<BodyId>& before, bool first) {
    WarmStart& warm = state.warm_start;
    const std::vector<BodyId>& here = state.bodies.id;
    std::vector<BodyId> left;  // bodies that this rank no longer holds
    std::set_difference(before.begin(), before.end(), here.begin(), here.end(), std::back_inserter(left));
    Outbox out;
    std::vector<std::uint8_t> goes(warm.key.size(), 0);
    for (std::size_t k = 0; k < warm.key.size(); ++k) {
        const ContactKey& key = warm.key[k];
        if (first ? holds_both(here, key) : !index_of(left, key.a) && (key.is_wall() || !index_of(left, key.b)))
            continue;
        const auto at = std::lower_bound(now.begin(), now.end(), key.a,
                                         [](const BodyMessage& body, std::uint64_t id) { return body.id < id; });
        if (at == now.end() || at->id != key.a) continue;
        goes[k] = 1;
        const std::vector<int> alone{at->owner};
        for (const int rank : at->holders.empty() ? alone : at->holders)
            if (rank != ranks_.rank()) put_impulse(out[rank], warm, k);
    }
    WarmStart came;
    for (const Communicator::Message& message : ranks_.exchange(out.take())) add_impulses(message.bytes, came);
    if (came.key.empty() && std::find(goes.begin(), goes.end(), 1) == goes.end()) return;
    const std::size_t own = warm.key.size();
    warm.key.insert(warm.key.end(), came.key.begin(), came.key.end());
    warm.impulse_vector.insert(warm.impulse_vector.end(), came.impulse_vector.begin(), came.impulse_vector.end());
    warm.impulse_normal.insert(warm.impulse_normal.end(), came.impulse_normal.begin(), came.impulse_normal.end());
    keep_sorted(warm, [&](std::uint32_t k) {
        return k < own ? goes[k] == 0 : takes_impulse(warm.key[k], state.bodies, partition, block_size);
    });
}

WarmStart Halo::pass_on(const WarmStart& warm, std::span<const std::uint32_t> which, const Bodies& bodies) {
    WarmStart came;
    came.step = warm.step;
    if (neighbour_.empty()) return came;
    std::vector<Packer> packer(neighbour_.size());
    for (const std::uint32_t k : which) {
        const auto a = index_of(bodies.id, warm.key[k].a);
        if (!a || !shared(*a)) continue;
        const auto b = warm.key[k].is_wall() ? a : index_of(bodies.id, warm.key[k].b);
        if (!b || !shared(*b)) continue;
        for (const int rank : other_[*a]) {
            if (!std::binary_search(other_[*b].begin(), other_[*b].end(), rank)) continue;
            const auto at = std::lower_bound(neighbour_rank_.begin(), neighbour_rank_.end(), rank);
            put_impulse(packer[static_cast<std::size_t>(at - neighbour_rank_.begin())], warm, k);
        }
    }
    std::vector<std::vector<std::byte>> out;
    for (Packer& p : packer) out.push_back(std::move(p.bytes));
    for (const std::vector<std::byte>& bytes : swap(ranks_, neighbour_rank_, out, traffic_)) add_impulses(bytes, came);
    keep_sorted(came, [](std::uint32_t) { return true; });
    return came;
}

}  // namespace scree
