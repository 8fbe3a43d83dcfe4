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
    std::vector<double> radius;           // [m], n; of a polyhedron: of the ball about its centre of mass that holds it
    std::vector<double> mass;             // [kg], n
    std::vector<MaterialIndex> material;  // n
    std::vector<Vec3> position;           // [m], n, centre of mass, relative to the scene's origin
    std::vector<Vec3> velocity;           // [m/s], n
    std::vector<Vec3> spin;               // [rad/s], n, world frame; empty for spheres without friction
    std::vector<Quat> orientation;        // n; empty unless there are polyhedra or an output asks for it
    std::vector<ShapeIndex> shape;        // n, kSphere or an index of State::shapes; empty when all are spheres
    std::vector<Vec3> inertia;            // [kg m2], n, about the principal axes, which are those of the body frame;
                                          // empty when all are spheres
    // n: 1 where the body belongs to another rank, which counts and writes it; empty when all bodies are this rank's.
    std::vector<std::uint8_t> ghost;

    std::size_t size() const { return id.size(); }  // own and ghosts
    bool is_ghost(std::size_t i) const { return !ghost.empty() && ghost[i] != 0; }
    std::size_t owned() const {
        return size() - static_cast<std::size_t>(std::count(ghost.begin(), ghost.end(), std::uint8_t{1}));
    }
    bool has_spin() const { return !spin.empty(); }
    bool has_orientation() const { return !orientation.empty(); }
    bool has_shapes() const { return !shape.empty(); }
    bool is_sphere(std::size_t i) const { return shape.empty() || shape[i] == kSphere; }

    // Which of the arrays that can be empty are not: a rank without bodies cannot tell from them.
    struct Arrays {
        bool spin = false, orientation = false, shape = false;
    };
    Arrays arrays() const { return {has_spin(), has_orientation(), has_shapes()}; }

    static double sphere_mass(double radius, double density) {
        return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
    }
    // Moment of inertia of a solid sphere over m R^2.
    static constexpr double kSphereInertia = 0.4;
};

}  // namespace scree
