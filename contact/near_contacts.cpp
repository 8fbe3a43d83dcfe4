#include "contact/near_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "contact/contact_home.hpp"
#include "contact/sphere_sphere.hpp"

namespace scree::contact {
namespace {

constexpr double kNegligible = 1e-12;  // of the diameter: shallower overlaps are round-off and push nobody;
constexpr double kShallow = 2e-4;      // those below this push
constexpr std::uint64_t kRarely = 8;  // in every eighth scenario step: they are most of the overlaps, and do least harm
constexpr double kPassedOn = 3e-3;    // of the diameter: a push this wide goes on to the next neighbours,
constexpr int kMostRings = 6;         // as many times as this
constexpr double kSpare = 1.5;        // near pairs are listed as far as this times the last deepest push needs
constexpr double kMostPush = 0.5;     // of the radius: deeper overlaps take several steps

// A push is half as wide at each further neighbour.
int rings_of(double widest) {
    int rings = 1;
    for (double passed = 0.5 * widest; passed > kPassedOn && rings < kMostRings; passed *= 0.5) ++rings;
    return rings;
}

}  // namespace

double NearContacts::least_push(std::uint64_t step) {
    return step % kRarely == 0 ? kNegligible : kShallow;
}

double NearContacts::diameter(const Contact& contact, const Bodies& bodies) {
    const double radius = bodies.radius[contact.a];
    return contact.key.is_wall() ? 2.0 * radius : radius + bodies.radius[contact.b];
}

// Lists the near pairs in the same walk, as wide as the last step needed, which mostly does in this one.
void NearContacts::measure_gaps(const Scene& scene, const State& state, const CandidateList& candidates) {
    const Bodies& bodies = state.bodies;
    const double negligible = least_push(state.step);
    const auto deepen = [&](std::size_t i, double gap, double diameter) {
        if (-gap <= negligible * diameter) return;
        push_[i] = std::max(push_[i], std::min(-gap, kMostPush * bodies.radius[i]));
    };
    list_near(bodies, candidates);
    for (const NearPair& pair : near_) {
        if (pair.gap >= 0.0) continue;
        const double radii = bodies.radius[pair.a] + bodies.radius[pair.b];
        deepen(pair.a, pair.gap, radii);
        deepen(pair.b, pair.gap, radii);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (const std::uint32_t w : candidates.walls(i)) {
            const WallFrame& frame = candidates.wall_frames()[w];
            if (!frame.present) continue;
            const Vec3& x = bodies.position[i];
            WallContacts found;
            find_contacts(scene.walls[w].shape, frame.moves ? frame.pose.to_local(x) : x, bodies.radius[i], 0.0, found);
            for (int k = 0; k < found.count; ++k)
                deepen(i, found.item[static_cast<std::size_t>(k)].gap, 2.0 * bodies.radius[i]);
        }
}

void NearContacts::list_near(const Bodies& bodies, const CandidateList& candidates) {
    const Vec3* const position = bodies.position.data();
    const double* const radius = bodies.radius.data();
    near_.resize(candidates.pairs());
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        for (const std::uint32_t j : candidates.partners(i)) {
            const double gap = (position[i] - position[j]).norm() - (radius[i] + radius[j]);
            near_[kept] = {i, j, gap};
            kept += gap < listed_ || gap < 0.0 ? 1 : 0;  // without a branch that nobody can foretell
        }
    near_.resize(kept);
}

// No push is wider than the deepest.
void NearContacts::list_wide_enough(const Bodies& bodies, const CandidateList& candidates) {
    if (push_.empty()) return;
    deepest_ = *std::max_element(push_.begin(), push_.end());
    if (2.0 * deepest_ <= listed_) return;
    listed_ = kSpare * 2.0 * deepest_;
    list_near(bodies, candidates);
}

// Over the diameter of the body.
double NearContacts::widest_push(const Bodies& bodies) const {
    double widest = 0.0;
    for (std::size_t i = 0; i < push_.size(); ++i)
        if (push_[i] > 0.0) widest = std::max(widest, 0.5 * push_[i] / bodies.radius[i]);
    return widest;
}

const ContactSet& NearContacts::find(const Scene& scene, State& state, double step, CandidateList& candidates,
                                     Domain& domain) {
    contacts_.clear();
    shallow_ = OverlapSums(state.block_size > 0.0 ? state.block_size : 1.0);
    const auto look = [&] {
        // every overlap is in the list as long as the list holds what touches
        push_.assign(state.bodies.size(), 0.0);
        candidates.update_at_end(scene, state, step, push_);
        listed_ = kSpare * 2.0 * deepest_;
        measure_gaps(scene, state, candidates);
        domain.halo().max_over_holders(push_);
        const double widest = domain.ranks().max(widest_push(state.bodies));
        none_ = widest == 0.0;
        if (none_) return;
        const int rings = rings_of(widest);
        for (int ring = 0; ring <= rings; ++ring) {
            // a wider push needs a wider list; what is measured again is the same
            if (candidates.update_at_end(scene, state, step, push_)) measure_gaps(scene, state, candidates);
            list_wide_enough(state.bodies, candidates);
            if (ring == rings) break;
            widen(state.bodies);
            domain.halo().max_over_holders(push_);
        }
    };
    look();
    // pushes beyond what the halo covers: bodies are exchanged, and all is looked for again
    while (!domain.alone() && domain.ranks().any(!domain.covers(state, push_))) {
        domain.extend(state, push_, step);
        candidates.invalidate();
        look();
    }
    collect(scene, state, candidates, domain);
    return contacts_;
}

// Whom a pushed body reaches is pushed in turn, by half of what is left of the push: two share it.
void NearContacts::widen(const Bodies& bodies) {
    wider_ = push_;
    for (const NearPair& pair : near_) {
        const double push = std::max(push_[pair.a], push_[pair.b]), open = std::max(pair.gap, 0.0);
        if (open >= push) continue;
        const double passed_on = 0.5 * (push - open);
        wider_[pair.a] = std::max(wider_[pair.a], std::min(passed_on, kMostPush * bodies.radius[pair.a]));
        wider_[pair.b] = std::max(wider_[pair.b], std::min(passed_on, kMostPush * bodies.radius[pair.b]));
    }
    push_.swap(wider_);
}

void NearContacts::collect(const Scene& scene, const State& state, const CandidateList& candidates,
                           const Domain& domain) {
    const Bodies& bodies = state.bodies;
    const Halo& halo = domain.halo();
    const auto add = [&](const Contact& contact, bool shallow, double diameter) {
        if (!solved_here(contact, state, domain)) return;
        if (shallow)
            shallow_.add(-contact.gap, diameter);
        else
            contacts_.push_back(contact);
    };
    auto pair = near_.begin();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3& x = bodies.position[i];
        const double radius = bodies.radius[i];
        for (; pair != near_.end() && pair->a == i; ++pair) {
            const std::uint32_t j = pair->b;
            const double reach = push_[i] + push_[j];
            if (pair->gap >= reach) continue;
            const double radii = radius + bodies.radius[j];
            if (reach == 0.0 && !(halo.shared(i) && halo.shared(j))) {  // this rank's, and no contact
                shallow_.add(-pair->gap, radii);
                continue;
            }
            const SphereGap g = sphere_sphere(x, bodies.position[j], radii, bodies.velocity[j] - bodies.velocity[i]);
            add({ContactKey::bodies(bodies.id[i], bodies.id[j]), static_cast<std::uint32_t>(i), j, g.normal, g.gap, 0.0,
                 0.0},
                reach == 0.0, radii);
        }
        for (const std::uint32_t w : candidates.walls(i)) {
            const WallFrame& frame = candidates.wall_frames()[w];
            if (!frame.present) continue;
            WallContacts found;
            find_contacts(scene.walls[w].shape, frame.moves ? frame.pose.to_local(x) : x, radius, push_[i], found);
            for (int k = 0; k < found.count; ++k) {
                const WallContact& c = found.item[static_cast<std::size_t>(k)];
                const Vec3 normal = frame.moves ? Vec3(frame.pose.rotation * c.normal) : c.normal;
                add({ContactKey::wall(bodies.id[i], WallIndex{w}, c.feature), static_cast<std::uint32_t>(i), w, normal,
                     c.gap, 0.0, 0.0},
                    push_[i] == 0.0, 2.0 * radius);
            }
        }
    }
}

std::size_t NearContacts::bytes() const {
    return (push_.capacity() + wider_.capacity()) * sizeof(double) + near_.capacity() * sizeof(NearPair) +
           contacts_.capacity() * sizeof(Contact);
}

}  // namespace scree::contact
