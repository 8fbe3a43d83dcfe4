// The plan: what a scene needs, and what is left out, each with the reason. It selects arrays and kernels once.
#pragma once

#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree {

struct PlanLine {
    std::string feature;  // "friction"
    bool on;
    std::string reason;  // "no tangential impulse: every friction coefficient is 0"
};

struct Plan {
    bool friction = false;  // tangential impulses
    bool spin = false;      // friction, or bodies that are not spheres
    bool polyhedra = false;
    bool restitution = false;  // any e > 0 among pairs that can meet
    bool orientation = false;  // an output asks for it, or bodies are not spheres
    bool moving_walls = false;
    bool correction = false;
    bool warm_start = false;
    bool acceleration = false;
    bool inlets = false, outlets = false;
    bool changing_gravity = false;
    bool contact_records = false;  // an output or a measure reads contacts
    std::vector<PlanLine> lines;   // for `check` and the summary
    std::size_t bytes_per_body = 0;
    std::size_t bytes_per_contact = 0;
};

// Looks at the scene and at the materials that the bodies of all ranks have. A material that only an inlet makes counts
// too.
Plan make_plan(const Scene& scene, const Bodies& bodies, const Communicator& ranks = Communicator::self());

}  // namespace scree
