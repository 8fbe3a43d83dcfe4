// Generators: from an item of `bodies` to bodies. The random numbers of body k of generator i are those of
// Random(seed, i, k), so that no body's size depends on any other body.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/bodies.hpp"
#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// Bodies as they come, without ids. Positions in the local frame.
struct BodyList {
    std::vector<double> radius;  // [m]
    std::vector<MaterialIndex> material;
    std::vector<Vec3> position, velocity, spin;  // [m], [m/s], [rad/s]

    std::size_t size() const { return radius.size(); }
    void add(double r, MaterialIndex m, const Vec3& x, const Vec3& v, const Vec3& w) {
        radius.push_back(r);
        material.push_back(m);
        position.push_back(x);
        velocity.push_back(v);
        spin.push_back(w);
    }
};

// More bodies than a LocalBody can count are refused.
inline constexpr double kMostBodies = 4294967295.0;

void generate_sphere(const io::Node& node, const Context& context, BodyList& bodies);
void generate_lattice(const io::Node& node, std::uint64_t stream, const Context& context, BodyList& bodies);
// Keeps clear of the bodies already in the list and of the walls that are there at time 0.
void generate_random(const io::Node& node, std::uint64_t stream, const Context& context, const Scene& scene,
                     BodyList& bodies);

}  // namespace scree::scenarios
