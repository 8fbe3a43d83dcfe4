// From a read scenario to a scene and its first state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/scenario/diagnostics.hpp"
#include "io/scenario/scenario_node.hpp"

namespace scree::scenarios {

struct Built {
    Scene scene;
    State state;                          // this rank's bodies at time 0, ordered by id; ledger and plan not yet made
    std::vector<std::string> shape_name;  // of each of state.shapes: what it was made from
};

// The scene alone: what a resumed run needs (its bodies come from the checkpoint). `origin`: the local origin that the
// checkpoint's positions are relative to. Without it, an automatic origin has to look into files of bodies again; with
// it, or with the key `origin`, they are not opened.
// `folder`: the folder of the scenario file; relative paths start there. Faults go to `diagnostics`, the same on all
// ranks.
Scene build_scene(const io::Node& scenario, const std::string& folder, io::Diagnostics& diagnostics,
                  const std::optional<Vec3>& origin = std::nullopt, const Communicator& ranks = Communicator::self());

// Scene and bodies. Ids count up from 0 in the order in which the scenario lists the bodies. Each rank makes a part of
// them: together they are those of one rank, to the bit.
Built build(const io::Node& scenario, const std::string& folder, io::Diagnostics& diagnostics,
            const Communicator& ranks = Communicator::self());

}  // namespace scree::scenarios
