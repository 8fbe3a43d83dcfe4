// A contact as the rest of the program sees it after a step: for files, measures and messages.
#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/vec.hpp"

namespace scree {

enum class ContactStatus : std::uint8_t { open, sticking, sliding };

struct ContactRecord {
    ContactKey key;
    Vec3 point;    // [m], relative to the scene's origin, middle of the step
    Vec3 normal;   // unit, from b to a
    double gap;    // [m], at the end of the step
    Vec3 impulse;  // [N s], acts on a
    double step;   // [s], length of the step: impulse / step is the mean force
    ContactStatus status;
};

}  // namespace scree
