// Bodies as arrays, in order of id. An array that the plan leaves out is empty.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/ids.hpp"
#include "core/vec.hpp"

namespace scree {

struct Bodies {
    std::vector<BodyId> id;               // n, increasing
    std::vector<double> radius;           // [m], n
    std::vector<double> mass;             // [kg], n
    std::vector<MaterialIndex> material;  // n
    std::vector<Vec3> position;           // [m], n, centre, relative to the scene's origin
    std::vector<Vec3> velocity;           // [m/s], n
    std::vector<Vec3> spin;               // [rad/s], n, world frame; empty when every friction coefficient is 0
    std::vector<Quat> orientation;        // n; empty unless an output asks for it
    // n: 1 where the body belongs to another rank, which counts and writes it; empty when all bodies are this rank's.
    std::vector<std::uint8_t> ghost;

    std::size_t size() const { return id.size(); }  // own and ghosts
    bool is_ghost(std::size_t i) const { return !ghost.empty() && ghost[i] != 0; }
    std::size_t owned() const {
        return size() - static_cast<std::size_t>(std::count(ghost.begin(), ghost.end(), std::uint8_t{1}));
    }
    bool has_spin() const { return !spin.empty(); }
    bool has_orientation() const { return !orientation.empty(); }

    static double sphere_mass(double radius, double density) {
        return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
    }
    // Moment of inertia of a solid sphere over m R^2.
    static constexpr double kSphereInertia = 0.4;
};

}  // namespace scree
