// Impulses of the last step follow the contacts: each rank keeps those that it solved, and copies of those that it may
// have to solve next.
#include <algorithm>
#include <numeric>

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
    ImpulseMessage m{warm.key[k].a, warm.key[k].b, warm.key[k].feature, {0.0, 0.0, 0.0}};
    if (!warm.impulse_vector.empty())
        for (int d = 0; d < 3; ++d) m.p[d] = warm.impulse_vector[k][d];
    else
        m.p[0] = warm.impulse_normal[k];
    packer.put(m);
}

// Takes the impulses in order of key: `order` says where each comes from.
template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
    if (values.empty()) return;
    std::vector<T> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t k : order) sorted.push_back(values[k]);
    values = std::move(sorted);
}

}  // namespace

// `of_local_bodies`: drop those whose bodies are not both here.
void Halo::merge_impulses(State& state, std::vector<Communicator::Message>& incoming, bool of_local_bodies) {
    WarmStart& warm = state.warm_start;
    const std::vector<BodyId>& id = state.bodies.id;
    const auto here = [&](std::uint64_t body) { return std::binary_search(id.begin(), id.end(), BodyId{body}); };
    const std::size_t before = warm.key.size();
    for (const auto& message : incoming) {
        Unpacker unpacker(message.bytes);
        if (unpacker.empty()) continue;
        const bool vectors = unpacker.get<std::uint8_t>() != 0;
        warm.step = unpacker.get<double>();
        while (!unpacker.empty()) {
            const auto m = unpacker.get<ImpulseMessage>();
            const ContactKey key{m.a, m.b, static_cast<std::uint32_t>(m.feature)};
            if (of_local_bodies && !(here(key.a) && (key.is_wall() || here(key.b)))) continue;
            warm.key.push_back(key);
            if (vectors)
                warm.impulse_vector.push_back(Vec3(m.p[0], m.p[1], m.p[2]));
            else
                warm.impulse_normal.push_back(m.p[0]);
            own_impulse_.push_back(0);
        }
    }
    if (warm.key.size() == before) return;
    // the new ones in order, then merged with the old ones, which are
    std::vector<std::uint32_t> order(warm.key.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(before);
    const auto by_key = [&](std::uint32_t a, std::uint32_t b) { return warm.key[a] < warm.key[b]; };
    std::sort(middle, order.end(), by_key);
    std::inplace_merge(order.begin(), middle, order.end(), by_key);
    reorder(warm.key, order);
    reorder(warm.impulse_vector, order);
    reorder(warm.impulse_normal, order);
    reorder(own_impulse_, order);
}

// Impulses follow body a.
void Halo::forward_impulses(State& state, const std::vector<BodyMessage>& now) {
    WarmStart& warm = state.warm_start;
    own_impulse_.resize(warm.key.size(), 1);  // before the first step all of them are this rank's
    Outbox out;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < warm.key.size(); ++k) {
        if (own_impulse_[k] == 0) continue;  // its owner sends it again to who needs it
        const auto at = std::lower_bound(now.begin(), now.end(), warm.key[k].a,
                                         [](const BodyMessage& body, std::uint64_t id) { return body.id < id; });
        if (at != now.end() && at->id == warm.key[k].a) {
            const std::vector<int> alone{at->owner};
            for (const int rank : at->holders.empty() ? alone : at->holders) {
                if (rank == ranks_.rank()) continue;
                Packer& packer = out[rank];
                if (packer.bytes.empty()) {
                    packer.put(static_cast<std::uint8_t>(warm.impulse_vector.empty() ? 0 : 1));
                    packer.put(warm.step);
                }
                put_impulse(packer, warm, k);
            }
        }
        warm.key[kept] = warm.key[k];
        if (!warm.impulse_vector.empty()) warm.impulse_vector[kept] = warm.impulse_vector[k];
        if (!warm.impulse_normal.empty()) warm.impulse_normal[kept] = warm.impulse_normal[k];
        ++kept;
    }
    warm.key.resize(kept);
    if (!warm.impulse_vector.empty()) warm.impulse_vector.resize(kept);
    if (!warm.impulse_normal.empty()) warm.impulse_normal.resize(kept);
    own_impulse_.assign(kept, 1);
    auto incoming = ranks_.exchange(out.take());
    merge_impulses(state, incoming, true);
    const double step = ranks_.max(warm.step);  // of ranks without a contact too
    warm.step = step;
}

void Halo::share_impulses(State& state) {
    WarmStart& warm = state.warm_start;
    own_impulse_.assign(ranks_.alone() ? 0 : warm.key.size(), 1);
    if (neighbour_.empty()) return;
    // those between bodies that a neighbour holds too
    std::vector<std::vector<std::byte>> out(neighbour_.size());
    const std::vector<BodyId>& id = state.bodies.id;
    std::vector<Packer> packer(neighbour_.size());
    std::size_t body = 0;
    for (std::size_t k = 0; k < warm.key.size(); ++k) {
        const ContactKey& key = warm.key[k];
        while (raw(id[body]) < key.a) ++body;  // keys are in order of their first body
        if (shared_[body] == 0) continue;
        std::size_t other = body;
        if (!key.is_wall()) {
            const auto at = std::lower_bound(id.begin(), id.end(), BodyId{key.b});
            other = static_cast<std::size_t>(at - id.begin());
            if (shared_[other] == 0) continue;
        }
        for (const int rank : other_[body]) {
            if (std::find(other_[other].begin(), other_[other].end(), rank) == other_[other].end()) continue;
            const auto at = std::lower_bound(neighbour_rank_.begin(), neighbour_rank_.end(), rank);
            Packer& p = packer[static_cast<std::size_t>(at - neighbour_rank_.begin())];
            if (p.bytes.empty()) {
                p.put(static_cast<std::uint8_t>(warm.impulse_vector.empty() ? 0 : 1));
                p.put(warm.step);
            }
            put_impulse(p, warm, k);
        }
    }
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::move(packer[k].bytes);
    auto in = swap(ranks_, neighbour_rank_, out, traffic_);
    std::vector<Communicator::Message> incoming;
    for (std::size_t k = 0; k < in.size(); ++k) incoming.push_back({neighbour_rank_[k], std::move(in[k])});
    merge_impulses(state, incoming, false);
}

}  // namespace scree
