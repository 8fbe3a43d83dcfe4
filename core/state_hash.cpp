#include "core/state_hash.hpp"

#include <bit>

#include "core/random.hpp"

namespace scree {
namespace {

// Each word is mixed into the running value, so that order and position count.
class Hash {
  public:
    void add(std::uint64_t word) { value_ = mix64(value_ ^ word); }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Vec3& v) {
        add(v.x());
        add(v.y());
        add(v.z());
    }
    void add(const Quat& q) {
        add(q.w());
        add(q.x());
        add(q.y());
        add(q.z());
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0x5c2ee0a3d1b84f67ULL;
};

}  // namespace

std::uint64_t state_hash(const Bodies& bodies) {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(bodies.size()));
    hash.add(std::uint64_t{bodies.has_orientation()} << 1 | std::uint64_t{bodies.has_spin()});
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        hash.add(raw(bodies.id[i]));
        hash.add(bodies.position[i]);
        if (bodies.has_orientation()) hash.add(bodies.orientation[i]);
        hash.add(bodies.velocity[i]);
        if (bodies.has_spin()) hash.add(bodies.spin[i]);
    }
    return hash.value();
}

}  // namespace scree
