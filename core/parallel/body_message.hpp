// A body on its way to another rank: all of it, or only who holds it from now on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/bodies.hpp"
#include "core/parallel/communicator.hpp"

namespace scree {

struct BodyData {
    double radius = 0.0, mass = 0.0;  // [m], [kg]
    MaterialIndex material{};
    Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();
    std::array<double, 4> orientation{};  // coefficients as Eigen keeps them; a Quat would be over-aligned
    ShapeIndex shape = kSphere;
    Vec3 inertia = Vec3::Zero();
};
BodyData body_data(const Bodies& bodies, std::size_t i);
void append_body(const BodyData& data, const Bodies::Arrays& arrays, Bodies& bodies);  // without its id
// The arrays that the bodies of any rank have. Collective.
Bodies::Arrays arrays_of_all(const Bodies& bodies, const Communicator& ranks);

// What the owner of a body tells those who hold it or held it.
struct BodyMessage {
    std::uint64_t id = 0;
    std::int32_t owner = 0;
    double room = 0.0;         // [m] that the body may move before the halo is made anew
    std::vector<int> holders;  // increasing; empty if the owner alone holds it
    bool has_data = false;     // for those who have not held it
    BodyData data;

    bool held_by(int rank) const;
    void put(Packer& packer, bool with_data, const Bodies::Arrays& arrays) const;
    static BodyMessage get(Unpacker& unpacker, const Bodies::Arrays& arrays);
};

}  // namespace scree
