// Regions and size distributions, from their sections. Faults give no value.
#pragma once

#include <optional>

#include "core/region.hpp"
#include "core/size_distribution.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// In the local frame.
std::optional<Region> build_region(const io::Node& node, const Context& context);
// The same where the region must have a volume (no half-space).
std::optional<Region> build_finite_region(const io::Node& node, const Context& context);
std::optional<SizeDistribution> build_size(const io::Node& node, const Context& context);

}  // namespace scree::scenarios
