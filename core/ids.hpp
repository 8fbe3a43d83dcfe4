// Identities. A BodyId is 64 bits, stable over restarts (and ranks), never reused. A LocalBody is an index into the
// arrays of `Bodies`, valid within one step only. A ContactKey names a contact for warm start and for the order of
// work.
#pragma once

#include <compare>
#include <cstdint>

namespace scree {

enum class BodyId : std::uint64_t {};
enum class LocalBody : std::uint32_t {};
enum class MaterialIndex : std::uint16_t {};
enum class WallIndex : std::uint32_t {};
enum class ShapeIndex : std::uint32_t {};  // of State::shapes

constexpr std::uint64_t raw(BodyId id) {
    return static_cast<std::uint64_t>(id);
}
constexpr std::uint32_t raw(LocalBody i) {
    return static_cast<std::uint32_t>(i);
}
constexpr std::uint16_t raw(MaterialIndex i) {
    return static_cast<std::uint16_t>(i);
}
constexpr std::uint32_t raw(WallIndex i) {
    return static_cast<std::uint32_t>(i);
}
constexpr std::uint32_t raw(ShapeIndex i) {
    return static_cast<std::uint32_t>(i);
}
inline constexpr ShapeIndex kSphere{0xffffffffU};  // the shape of a body that is one

// Contact (a, b): the normal points from b to a. Two bodies: b has the larger id. A body and a wall: b is the wall.
struct ContactKey {
    static constexpr std::uint64_t kWallBit = std::uint64_t{1} << 63;

    std::uint64_t a = 0;  // body id
    std::uint64_t b = 0;  // body id, or kWallBit | wall index << 32 | part of the wall (a triangle of terrain)
    // Which of a wall's surfaces or edges, or which features of polyhedra meet; 0 between spheres.
    std::uint32_t feature = 0;

    static ContactKey bodies(BodyId a, BodyId b, std::uint32_t feature = 0) { return {raw(a), raw(b), feature}; }
    static ContactKey wall(BodyId a, WallIndex w, std::uint32_t feature, std::uint32_t part = 0) {
        return {raw(a), kWallBit | std::uint64_t{raw(w)} << 32U | part, feature};
    }
    bool is_wall() const { return (b & kWallBit) != 0; }
    WallIndex wall_index() const { return WallIndex{static_cast<std::uint32_t>((b & ~kWallBit) >> 32U)}; }

    auto operator<=>(const ContactKey&) const = default;
};

}  // namespace scree
