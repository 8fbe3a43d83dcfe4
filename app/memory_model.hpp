// How many bytes a body and a contact take under a plan, measured and not tabulated: the stepper makes one step with a
// thousand spheres (cubes, if the plan has polyhedra) apart and one with them touching, and tells what it holds. Takes
// milliseconds.
#pragma once

#include "core/plan.hpp"
#include "core/scene.hpp"

namespace scree::app {

// Sets plan.bytes_per_body and plan.bytes_per_contact.
void measure_memory(const Scene& scene, Plan& plan);

}  // namespace scree::app
