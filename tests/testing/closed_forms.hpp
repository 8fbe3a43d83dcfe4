// What single bodies do, in closed form: the numbers that the tests of the physics compare with.
#pragma once

#include <algorithm>
#include <cmath>

namespace scree::testing {

inline constexpr double kGravity = 9.81;  // [m/s2]

// Height [m] of the lowest point of a ball dropped from h0 [m] at time t [s], restitution e < 1:
// the flight after impact k starts upwards at e^k v1, v1 = sqrt(2 g h0).
inline double bouncing_height(double h0, double e, double t) {
    const double v1 = std::sqrt(2.0 * kGravity * h0), fall = v1 / kGravity;
    if (t < fall) return h0 - 0.5 * kGravity * t * t;
    double begin = fall, v = e * v1;
    while (v > 1e-12 * v1) {
        const double flight = 2.0 * v / kGravity;
        if (t < begin + flight) return (t - begin) * (v - 0.5 * kGravity * (t - begin));
        begin += flight;
        v *= e;
    }
    return 0.0;
}
// When the last of the infinitely many bounces is over [s].
inline double bouncing_end(double h0, double e) {
    return std::sqrt(2.0 * h0 / kGravity) * (1.0 + e) / (1.0 - e);
}

// A sphere that hits a plane (or its equal) with relative velocity (normal v_n > 0 closing, tangential v_t), without
// spin: Newton's e, Coulomb's mu, no tangential restitution.
struct ObliqueImpact {
    double normal;      // after, separating [m/s]
    double tangential;  // of the centre, after [m/s]
    double surface;     // R omega [m/s]
};
inline ObliqueImpact oblique_impact(double v_n, double v_t, double e, double mu) {
    const double change = std::min(mu * (1.0 + e) * v_n, 2.0 / 7.0 * v_t);
    return {e * v_n, v_t - change, 2.5 * change};
}

// Newton's cradle of n touching equal balls, `incoming` of them at speed 1: one Newton law per contact, solved
// together (V+ = (1 + e) V_plastic - e V-), plastic: all move on together.
inline double cradle_speed(int n, int incoming, double e, int ball) {
    return (1.0 + e) * incoming / n - (ball < incoming ? e : 0.0);
}

}  // namespace scree::testing
