#include "core/wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/terrain.hpp"

namespace scree {
namespace {

double motion_time(const WallMotion& m, double time) {
    return std::clamp(time, m.start, m.end) - m.start;
}

double oscillation_angle(const WallMotion& m, double tau) {
    return 2.0 * std::numbers::pi * m.frequency * tau + m.phase;
}

// What is added to the rotated position at time tau after the motion's start.
Vec3 offset(const WallMotion& m, double tau) {
    return m.velocity * tau + m.amplitude * (std::sin(oscillation_angle(m, tau)) - std::sin(m.phase));
}

struct Translate {
    const Vec3& shift;

    void operator()(PlaneWall& w) const { w.point += shift; }
    void operator()(BoxWall& w) const {
        w.lower += shift;
        w.upper += shift;
    }
    void operator()(CylinderWall& w) const { w.base += shift; }
    void operator()(ConeWall& w) const { w.base += shift; }
    void operator()(DiscWall& w) const { w.centre += shift; }
    void operator()(OrificeFloor& w) const { w.centre += shift; }
    void operator()(SlotFloor& w) const { w.centre += shift; }
    void operator()(TerrainWall& w) const {
        w.terrain = std::make_shared<const Terrain>(translated(*w.terrain, shift));
    }
};

}  // namespace

WallPose pose_at(const WallMotion& motion, double time) {
    WallPose pose;
    if (!motion.moves()) return pose;
    const double tau = motion_time(motion, time);
    pose.translation = offset(motion, tau);
    if (motion.rate != 0.0) {
        pose.rotation = Eigen::AngleAxisd(motion.rate * tau, motion.axis).toRotationMatrix();
        pose.translation += motion.centre - pose.rotation * motion.centre;
    }
    return pose;
}

// The displacement over the step is written with differences of angles and times, not of positions, so that a slow
// wall far from the origin loses no digits:
//   sin b - sin a = 2 cos((a + b)/2) sin((b - a)/2),
//   (R(b) - R(a)) x = (cos b - cos a) x_perp + (sin b - sin a) k x x,   angles counted from the middle of the step.
Vec3 mean_velocity(const WallMotion& motion, const Vec3& world, double time, double step) {
    if (!motion.moves() || !(step > 0.0)) return Vec3::Zero();
    const double first = motion_time(motion, time);
    const double middle = motion_time(motion, time + 0.5 * step);
    const double last = motion_time(motion, time + step);

    const double a = oscillation_angle(motion, first), b = oscillation_angle(motion, last);
    Vec3 displacement = motion.velocity * (last - first);
    displacement += motion.amplitude * (2.0 * std::cos(0.5 * (a + b)) * std::sin(0.5 * (b - a)));
    if (motion.rate != 0.0) {
        const Vec3 arm = world - motion.centre - offset(motion, middle);
        const Vec3 across = arm - arm.dot(motion.axis) * motion.axis;
        const double back = motion.rate * (first - middle), ahead = motion.rate * (last - middle);
        displacement += (std::cos(ahead) - std::cos(back)) * across;
        displacement += (std::sin(ahead) - std::sin(back)) * motion.axis.cross(arm);
    }
    return displacement / step;
}

double speed_bound(const WallMotion& motion, const Vec3& world, double reach, double time, double duration) {
    const double along =
        motion.velocity.norm() + motion.amplitude.norm() * 2.0 * std::numbers::pi * std::abs(motion.frequency);
    if (motion.rate == 0.0) return along;
    const Vec3 centre = motion.centre + offset(motion, motion_time(motion, time));
    return along + std::abs(motion.rate) * ((world - centre).norm() + reach + along * duration);
}

Wall translated(const Wall& wall, const Vec3& shift) {
    Wall moved = wall;
    std::visit(Translate{shift}, moved.shape);
    moved.motion.centre += shift;
    return moved;
}

}  // namespace scree
