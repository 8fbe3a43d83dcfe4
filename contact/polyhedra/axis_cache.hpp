// The last direction of contact of each pair of polyhedra, a guess that saves work (polyhedron_polyhedron.hpp). Pairs
// that fall on one place push each other out: nothing but time depends on what is found here.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/random.hpp"
#include "core/vec.hpp"

namespace scree::contact {

class AxisCache {
  public:
    // Room for so many pairs; grows only.
    void reserve(std::size_t pairs) {
        const std::size_t places = std::bit_ceil(2 * pairs + 1);
        if (places > place_.size()) place_.assign(places, {});
    }
    // Zero for a pair that is not there. After reserve().
    Vec3& axis(BodyId a, BodyId b) {
        Place& place = place_[mix64(mix64(raw(a)) ^ raw(b)) & (place_.size() - 1)];
        if (place.a != raw(a) || place.b != raw(b)) place = {raw(a), raw(b), Vec3::Zero()};
        return place.axis;
    }
    std::size_t bytes() const { return place_.capacity() * sizeof(Place); }

  private:
    struct Place {
        std::uint64_t a = 0, b = 0;  // a < b, so that none is (0, 0)
        Vec3 axis = Vec3::Zero();
    };
    std::vector<Place> place_;
};

}  // namespace scree::contact
