// Impulses of the last step for the contacts of this one, matched by key.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_set.hpp"
#include "core/state.hpp"

namespace scree::solvers {

// Both lists are in order of key. A vector impulse is kept as far as it pushes along the new normal; impulses scale
// with the length of the step. Sets `impulse` (frictional) or `normal` (frictionless), one a contact, where there was
// one; the others stay. `unmatched`: takes the indices of those in `last` that have no contact.
void match_warm_start(const contact::ContactSet& contacts, const WarmStart& last, double step, bool frictional,
                      std::vector<Vec3>& impulse, std::vector<double>& normal,
                      std::vector<std::uint32_t>* unmatched = nullptr);

// Keeps the non-zero impulses of this step for the next one.
void keep_for_warm_start(const contact::ContactSet& contacts, const std::vector<Vec3>& impulse,
                         const std::vector<double>& normal, double step, WarmStart& kept);

}  // namespace scree::solvers
