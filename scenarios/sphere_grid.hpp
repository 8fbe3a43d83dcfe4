// Spheres in a grid, for one question: is there room for another? Spheres of like size (within a factor of 2) share a
// level with cells of that size, so that a question costs about the same among any mixture of sizes as long as the
// large ones are put in first.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/vec.hpp"

namespace scree::scenarios {

class SphereGrid {
  public:
    void add(const Vec3& centre, double radius);
    // A sphere here would have at least `gap` between its surface and every other one.
    bool is_free(const Vec3& centre, double radius, double gap) const;

  private:
    static constexpr std::uint32_t kNone = 0xffffffff;
    struct Sphere {
        Vec3 centre;
        double radius;
        std::uint32_t next;  // in the same cell; kNone: the last
    };
    struct Level {
        double cell = 0.0;                                       // [m] edge; at least the largest diameter of the level
        std::vector<std::uint32_t> all;                          // indices of its spheres
        std::unordered_map<std::uint64_t, std::uint32_t> first;  // sphere by cell; looked up, never walked through
    };
    static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k);
    bool is_free_in(const Level& level, const Vec3& centre, double radius, double gap) const;
    bool is_clear(std::uint32_t other, const Vec3& centre, double reach) const;

    std::map<int, Level> levels_;  // by exponent of 2 of the cell's edge
    std::vector<Sphere> spheres_;
};

}  // namespace scree::scenarios
