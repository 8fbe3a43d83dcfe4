#include "app/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/human_text.hpp"
#include "app/overlaps.hpp"

namespace scree::app {
namespace {

constexpr double kOverlapShown = 0.01;  // of the smaller radius
constexpr double kTravelShown = 0.1;    // diameters in a step
constexpr double kFallShown = 0.1;      // of sqrt(d / g), the time in which a body falls half its diameter, / sqrt 2

std::string side_name(const Scene& scene, const ContactKey& key) {
    if (!key.is_wall()) return fmt::format("body {}", key.b);
    return fmt::format("wall '{}'", scene.walls[raw(key.wall_index())].name);
}

// Largest speed that the prescribed motion gives a wall at the places where bodies are now [m/s].
double wall_speed(const WallMotion& motion, const Bodies& bodies, const Communicator& ranks) {
    double lever = 0.0;
    if (motion.rate != 0.0) {
        for (const Vec3& x : bodies.position) lever = std::max(lever, (x - motion.centre).cross(motion.axis).norm());
        lever = ranks.max(lever);
    }
    return motion.velocity.norm() + 2.0 * std::numbers::pi * std::abs(motion.frequency) * motion.amplitude.norm() +
           std::abs(motion.rate) * lever;
}

// The fastest body of all ranks, of equally fast ones that with the smallest id.
struct Fastest {
    double speed = 0.0;  // [m/s]
    std::uint64_t id = 0;
};
Fastest fastest_body(const Bodies& bodies, const Communicator& ranks) {
    Fastest own;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double speed = bodies.velocity[i].norm();
        if (speed > own.speed) own = {speed, raw(bodies.id[i])};
    }
    const double most = ranks.max(own.speed);
    // The smallest id is the largest complement.
    return {most, ~ranks.max(own.speed == most ? ~own.id : std::uint64_t{0})};
}

}  // namespace

std::vector<std::string> overlap_warnings(const Scene& scene, const State& state, const Communicator& ranks) {
    const Overlaps found = count_overlaps(scene, state, kOverlapShown, ranks);
    if (!found.deepest) return {};
    const solvers::Overlap& worst = *found.deepest;
    return {fmt::format(
        "at the start {} deeper than 1 % of the smaller radius; the worst: body {} and {}, {} at {}. The correction "
        "moves them apart, but a packing that starts without overlaps is better.",
        found.count == 1 ? "1 pair overlaps" : count_text(found.count) + " pairs overlap", worst.key.a,
        side_name(scene, worst.key), length_text(worst.depth), point_text(scene.origin + worst.point))};
}

std::vector<std::string> step_warnings(const Scene& scene, const State& state, const Communicator& ranks) {
    std::vector<std::string> warnings;
    const Bodies& bodies = state.bodies;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        smallest = std::min(
            smallest, 2.0 * (bodies.is_sphere(i) ? bodies.radius[i] : state.shapes[raw(bodies.shape[i])].inner_radius));
    smallest = ranks.min(smallest);
    for (const Inlet& inlet : scene.inlets) smallest = std::min(smallest, smallest_diameter(inlet.size));
    if (!std::isfinite(smallest)) return warnings;

    const double step = scene.time.step;
    const double g = scene.gravity.max_norm();
    if (g > 0.0 && step > kFallShown * std::sqrt(smallest / g)) {
        warnings.push_back(fmt::format(
            "the time step of {:.3g} s is long for the smallest bodies (d = {}): sqrt(d/g) is {:.3g} s, and a step "
            "should be well below a tenth of it",
            step, length_text(smallest), std::sqrt(smallest / g)));
    }
    double speed = 0.0;
    std::string whose;
    const auto note = [&](double v, const std::string& name) {
        if (v > speed) {
            speed = v;
            whose = name;
        }
    };
    const Fastest body = fastest_body(bodies, ranks);
    note(body.speed, fmt::format("body {}", body.id));
    for (const Inlet& inlet : scene.inlets) note(inlet.velocity.norm(), fmt::format("inlet '{}'", inlet.name));
    for (const Wall& wall : scene.walls)
        note(wall_speed(wall.motion, bodies, ranks), fmt::format("wall '{}'", wall.name));
    if (speed * step > kTravelShown * smallest) {
        warnings.push_back(
            fmt::format("in one step of {:.3g} s {} moves {} at {:.3g} m/s: {:.2g} diameters of the smallest body. "
                        "Errors of the time "
                        "stepping grow with this number; below {} is good.",
                        step, whose, length_text(speed * step), speed, speed * step / smallest, kTravelShown));
    }
    return warnings;
}

std::vector<std::string> scene_warnings(const Scene& scene, const State& state, const Communicator& ranks) {
    std::vector<std::string> warnings = overlap_warnings(scene, state, ranks);
    const std::vector<std::string> steps = step_warnings(scene, state, ranks);
    warnings.insert(warnings.end(), steps.begin(), steps.end());
    return warnings;
}

}  // namespace scree::app
