// Bodies with shapes: every third a sphere, the others a box, a tetrahedron or a rock, turned anyhow.
#pragma once

#include "tests/io/io_fixtures.hpp"
#include "tests/testing/hull_shape.hpp"

namespace scree::io::testing {

inline State polyhedra_state(std::size_t bodies) {
    using namespace scree::testing;
    State s = sample_state(bodies);
    Random random(5, 0, 0);
    s.shapes = {box_shape({1.0, 0.8, 0.6}), tetrahedron_shape(1.0), rock_shape(12, {0.6, 0.5, 0.4}, random)};
    for (std::size_t i = 0; i < bodies; ++i) {
        const ShapeIndex shape = i % 3 == 2 ? kSphere : ShapeIndex{static_cast<std::uint32_t>(i * i % s.shapes.size())};
        s.bodies.shape.push_back(shape);
        s.bodies.inertia.emplace_back(1.0, 2.0, 3.0);
        s.bodies.orientation[i] = random_turn(random);
        if (shape != kSphere) s.bodies.radius[i] = s.shapes[raw(shape)].radius;
    }
    return s;
}

}  // namespace scree::io::testing
