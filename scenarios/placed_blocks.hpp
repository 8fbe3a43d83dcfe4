// Blocks that stand where they were made, as bodies.
#pragma once

#include <vector>

#include "scenarios/generators.hpp"

namespace scree::scenarios {

// What generated shapes are called: the generator's name, or its place in the list.
std::string name_of_generator(const io::Node& node);

// Material, velocity and spin that all bodies of a generator have.
struct CommonState {
    MaterialIndex material;
    Vec3 velocity, spin;

    CommonState(const io::Node& node, const Context& context);
};

// One body a block, in their order; `blocks` are the same on all ranks, in the local frame. Those that are needles or
// plates are warned of, in one sentence.
void add_blocks(const io::Node& node, const Context& context, const Communicator& ranks,
                std::vector<PlacedShape> blocks, BodyList& bodies);

// The block without what is nearer to its faces than `depth` [m]; without faces if nothing is left.
Polyhedron eroded(const PlacedShape& block, double depth);

}  // namespace scree::scenarios
