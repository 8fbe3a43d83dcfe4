// What each rank would get of a scene at its start, for `check --ranks N`: no ranks are needed to tell.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::app {

struct RankShare {
    std::uint64_t bodies = 0;
    std::uint64_t border = 0;  // bodies of other ranks that it holds a copy of
};

// As Domain::start shares space out, by numbers of bodies; the border as far as bodies reach in the first steps.
std::vector<RankShare> share_out(const Scene& scene, const State& state, int ranks);

std::string shares_text(const std::vector<RankShare>& shares, const Plan& plan);

}  // namespace scree::app
