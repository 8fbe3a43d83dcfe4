#include "contact/near_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sphere_sphere.hpp"

namespace scree::contact {
namespace {

constexpr double kMostPush = 0.5;  // of the radius: deeper overlaps take several steps

}  // namespace

double NearContacts::diameter(const Contact& contact, const Bodies& bodies) {
    const double radius = bodies.radius[contact.a];
    return contact.key.is_wall() ? 2.0 * radius : radius + bodies.radius[contact.b];
}

void NearContacts::measure_gaps(const Scene& scene, const State& state, const CandidateList& candidates) {
    const Bodies& bodies = state.bodies;
    std::fill(push_.begin(), push_.end(), 0.0);
    const auto deepen = [&](std::size_t i, double gap) {
        push_[i] = std::max(push_[i], std::min(-gap, kMostPush * bodies.radius[i]));
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (const std::uint32_t j : candidates.partners(i)) {
            const double radii = bodies.radius[i] + bodies.radius[j];
            const double square = (bodies.position[i] - bodies.position[j]).squaredNorm();
            if (square >= radii * radii) continue;
            const double gap = std::sqrt(square) - radii;
            deepen(i, gap);
            deepen(j, gap);
        }
        for (const std::uint32_t w : candidates.walls(i)) {
            const WallFrame& frame = candidates.wall_frames()[w];
            if (!frame.present) continue;
            const Vec3& x = bodies.position[i];
            WallContacts found;
            find_contacts(scene.walls[w].shape, frame.moves ? frame.pose.to_local(x) : x, bodies.radius[i], 0.0, found);
            for (int k = 0; k < found.count; ++k) deepen(i, found.item[static_cast<std::size_t>(k)].gap);
        }
    }
}

const ContactSet& NearContacts::find(const Scene& scene, const State& state, double step, CandidateList& candidates) {
    const std::size_t n = state.bodies.size();
    contacts_.clear();
    // every overlap is in the list as long as the list holds what touches
    push_.assign(n, 0.0);
    candidates.update_at_end(scene, state, step, push_);
    measure_gaps(scene, state, candidates);
    if (std::all_of(push_.begin(), push_.end(), [](double d) { return d == 0.0; })) return contacts_;
    wider_ = push_;
    const Bodies& bodies = state.bodies;
    for (std::size_t i = 0; i < n; ++i)
        for (const std::uint32_t j : candidates.partners(i)) {
            const double push = std::max(push_[i], push_[j]), reach = bodies.radius[i] + bodies.radius[j] + push;
            if (push == 0.0 || (bodies.position[i] - bodies.position[j]).squaredNorm() >= reach * reach) continue;
            wider_[j] = std::max(wider_[j], std::min(push, kMostPush * bodies.radius[j]));
            wider_[i] = std::max(wider_[i], std::min(push, kMostPush * bodies.radius[i]));
        }
    push_.swap(wider_);
    candidates.update_at_end(scene, state, step, push_);
    collect(scene, state, candidates);
    return contacts_;
}

void NearContacts::collect(const Scene& scene, const State& state, const CandidateList& candidates) {
    const Bodies& bodies = state.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3& x = bodies.position[i];
        const double radius = bodies.radius[i];
        for (const std::uint32_t j : candidates.partners(i)) {
            const double reach = push_[i] + push_[j], radii = radius + bodies.radius[j];
            if (reach == 0.0 || (x - bodies.position[j]).squaredNorm() >= (radii + reach) * (radii + reach)) continue;
            const SphereGap pair = sphere_sphere(x, bodies.position[j], radii, bodies.velocity[j] - bodies.velocity[i]);
            contacts_.push_back({ContactKey::bodies(bodies.id[i], bodies.id[j]), static_cast<std::uint32_t>(i), j,
                                 pair.normal, pair.gap, 0.0, 0.0});
        }
        if (push_[i] == 0.0) continue;
        for (const std::uint32_t w : candidates.walls(i)) {
            const WallFrame& frame = candidates.wall_frames()[w];
            if (!frame.present) continue;
            WallContacts found;
            find_contacts(scene.walls[w].shape, frame.moves ? frame.pose.to_local(x) : x, radius, push_[i], found);
            for (int k = 0; k < found.count; ++k) {
                const WallContact& c = found.item[static_cast<std::size_t>(k)];
                const Vec3 normal = frame.moves ? Vec3(frame.pose.rotation * c.normal) : c.normal;
                contacts_.push_back({ContactKey::wall(bodies.id[i], WallIndex{w}, c.feature),
                                     static_cast<std::uint32_t>(i), w, normal, c.gap, 0.0, 0.0});
            }
        }
    }
}

std::size_t NearContacts::bytes() const {
    return (push_.capacity() + wider_.capacity()) * sizeof(double) + contacts_.capacity() * sizeof(Contact);
}

}  // namespace scree::contact
