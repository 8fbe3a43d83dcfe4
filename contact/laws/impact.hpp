// Which contacts enter the step's problem, and with which bias c of the normal velocity:
//   0 <= u_N + c  ⟂  p_N >= 0,        u_N [m/s] relative normal velocity at the end of the step.
// With the gap g at the middle of the step, q_m, and the end gap g + (h/2) u_N (theta = 1/2):
//   impact   the contact closes within the step of free flight, g + (h/2) u_free <= 0:  c = e u_N^-
//            (Newton's law as Moreau (1988) puts it);
//   approach it would stay open, meets at no more than twice the speed that gravity gives in a step, or e = 0:  c = 2 g
//   / h,
//            it may close but not overlap by the end of the step (no force across a gap, no tunnelling).
// A perfectly elastic contact (e = 1) is never held back in approach: that would take energy away.
#pragma once

#include <algorithm>

namespace scree::contact {

struct ImpactInput {
    double gap;            // [m] at the middle of the step
    double approach;       // [m/s] u_N^-, negative when closing
    double free_approach;  // [m/s] u_N of the free velocities
    double restitution;    // e
    double touch;          // [m] gaps below this are contact to round-off
    double reach;          // [m] how far an open contact is looked after
};
// Constants of one step.
struct ImpactStep {
    double step;           // h [s]
    double resting_speed;  // [m/s] h |g|: what gravity gives a body at rest in one step
};

// Returns whether the contact takes part; `bias` is c.
inline bool impact_law(const ImpactInput& in, const ImpactStep& step, double& bias) {
    if (in.gap <= in.touch) {
        bias = in.restitution * in.approach;
        return true;
    }
    const bool closes = in.gap + 0.5 * step.step * in.free_approach <= 0.0;
    const bool rests = in.restitution == 0.0 || (in.restitution < 1.0 && -in.approach <= 2.0 * step.resting_speed);
    if (closes && !rests) {
        bias = in.restitution * in.approach;
        return true;
    }
    if (closes || (in.restitution < 1.0 && in.gap <= in.reach)) {
        bias = 2.0 * in.gap / step.step;
        return true;
    }
    return false;
}

}  // namespace scree::contact
