#include "core/state_hash.hpp"

#include <array>
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

std::uint64_t body_word(const Bodies& bodies, std::size_t i) {
    Hash hash;
    hash.add(raw(bodies.id[i]));
    hash.add(bodies.position[i]);
    if (bodies.has_orientation()) hash.add(bodies.orientation[i]);
    hash.add(bodies.velocity[i]);
    if (bodies.has_spin()) hash.add(bodies.spin[i]);
    if (bodies.has_shapes()) hash.add(std::uint64_t{raw(bodies.shape[i])});
    return hash.value();
}

}  // namespace

std::uint64_t state_hash(const Bodies& bodies, const Communicator& ranks) {
    // A rank without bodies does not know whether there are spins and orientations: counts of those who have them.
    enum { words, count, spins, orientations };
    std::array<std::uint64_t, 4> sums{};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        sums[words] += body_word(bodies, i);
        ++sums[count];
    }
    sums[spins] = bodies.has_spin() ? 1 : 0;
    sums[orientations] = bodies.has_orientation() ? 1 : 0;
    ranks.sum(std::span(sums));
    Hash hash;
    hash.add(sums[words]);
    hash.add(sums[count]);
    hash.add(std::uint64_t{sums[orientations] > 0} << 1 | std::uint64_t{sums[spins] > 0});
    return hash.value();
}

}  // namespace scree
