// Where a contact is solved: in the block that holds its contact point, by the rank that owns the block; if a body of
// it is wider than a block, after all blocks and by one rank. Every rank that finds the contact finds it from the same
// bits, so all come to the same answer.
#pragma once

#include "contact/contact_set.hpp"
#include "core/bodies.hpp"
#include "core/parallel/blocks.hpp"
#include "core/parallel/domain.hpp"

namespace scree::contact {

struct ContactHome {
    BlockIndex block;
    bool wide;
};

// `given` [m]: the contact point.
inline ContactHome home_of(const Contact& contact, const Vec3& given, const Bodies& bodies, double block_size) {
    const double ra = bodies.radius[contact.a], rb = contact.key.is_wall() ? ra : bodies.radius[contact.b];
    Vec3 point = given;
    // where one body lies deep within the other, the middle between their surfaces can lie outside of the smaller one
    if (contact.gap < -2.0 * std::min(ra, rb)) point = bodies.position[ra <= rb ? contact.a : contact.b];
    return {block_of(point, block_size), 2.0 * std::max(ra, rb) + std::max(contact.gap, 0.0) >= block_size};
}

// Of spheres.
inline ContactHome home_of(const Contact& contact, const Bodies& bodies, double block_size) {
    return home_of(contact, contact.point(bodies.position[contact.a], bodies.radius[contact.a]), bodies, block_size);
}

// A contact of a body that only this rank holds is this rank's without a look at blocks. `point()` gives the contact
// point.
template <class Point>
bool solved_here(const Contact& contact, const State& state, const Domain& domain, const Point& point) {
    const Halo& halo = domain.halo();
    if (domain.alone() || !halo.shared(contact.a) || (!contact.key.is_wall() && !halo.shared(contact.b))) return true;
    const ContactHome home = home_of(contact, point(), state.bodies, state.block_size);
    return (home.wide ? kWideRank : domain.partition().owner(home.block)) == domain.ranks().rank();
}
inline bool solved_here(const Contact& contact, const State& state, const Domain& domain) {
    return solved_here(contact, state, domain,
                       [&] { return contact.point(state.bodies.position[contact.a], state.bodies.radius[contact.a]); });
}

}  // namespace scree::contact
