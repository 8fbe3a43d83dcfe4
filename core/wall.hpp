// Walls: exact surfaces with a prescribed motion and a life time. Plain data; distances are in contact/walls/.
//
// A wall is described in its own frame, which coincides with the world at the start. `inside` means that bodies are
// kept inside the surface (a silo); otherwise outside it (a pillar). Surfaces without `inside` are one-sided where the
// comment says so, else thin and two-sided.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <variant>

#include "core/ids.hpp"
#include "core/vec.hpp"

namespace scree {

struct Terrain;

inline constexpr double kForever = std::numeric_limits<double>::infinity();

struct PlaneWall {  // bodies stay on the side that the normal points to
    Vec3 point;     // [m]
    Vec3 normal;    // unit
};
struct BoxWall {
    Vec3 lower, upper;  // [m]
    bool inside;
    bool open_top;     // inside only: no face at upper z
    bool open_bottom;  // inside only: no face at lower z
};
struct CylinderWall {
    Vec3 base;      // centre of one end [m]
    Vec3 axis;      // unit, towards the other end
    double radius;  // [m]
    double length;  // [m], may be infinite
    bool inside;    // no end caps: add discs. Outside: a solid pillar with flat ends
};
struct ConeWall {        // frustum without caps (a hopper, a funnel), bodies inside or outside
    Vec3 base;           // centre of the end with radius_base [m]
    Vec3 axis;           // unit, towards the other end
    double radius_base;  // [m]
    double radius_end;   // [m]
    double length;       // [m], finite
    bool inside;
};
struct DiscWall {  // thin, two-sided
    Vec3 centre, normal;
    double radius;
};
struct OrificeFloor {  // an infinite thin plane with a circular hole; two-sided
    Vec3 centre, normal;
    double hole_radius;
};
struct SlotFloor {  // an infinite thin plane with a rectangular hole; two-sided
    Vec3 centre, normal;
    Vec3 along;            // unit, in the plane: direction of the slot's length
    double width, length;  // [m]; length may be infinite
};
struct TerrainWall {  // a surface of triangles (terrain.hpp); one-sided; it does not move
    std::shared_ptr<const Terrain> terrain;
};
using WallShape =
    std::variant<PlaneWall, BoxWall, CylinderWall, ConeWall, DiscWall, OrificeFloor, SlotFloor, TerrainWall>;

// Prescribed motion, a closed function of time, so that a restart needs no state:
//   x(t) = c + R(t) (x0 - c) + velocity tau + amplitude sin(2 pi frequency tau + phase) - amplitude sin(phase),
//   R(t) = rotation by rate tau about `axis` through c = `centre`;  tau = clamp(t, start, end) - start.
struct WallMotion {
    Vec3 velocity = Vec3::Zero();        // [m/s]
    Vec3 amplitude = Vec3::Zero();       // [m]
    double frequency = 0.0;              // [Hz]
    double phase = 0.0;                  // [rad]
    Vec3 centre = Vec3::Zero();          // [m]
    Vec3 axis = Vec3::UnitZ();           // unit
    double rate = 0.0;                   // [rad/s]
    double start = 0.0, end = kForever;  // [s]

    bool moves() const { return rate != 0.0 || !velocity.isZero(0.0) || !amplitude.isZero(0.0); }
};

struct Wall {
    std::string name;
    MaterialIndex material{};
    WallShape shape;
    WallMotion motion;
    double appears = 0.0;    // [s]
    double goes = kForever;  // [s]

    // The wall acts in the step from t to t + h if it is there at the step's middle.
    bool present(double mid_time) const { return mid_time >= appears && mid_time < goes; }
};

// Where a wall's frame is at a time: world = rotation * local + translation.
struct WallPose {
    Mat3 rotation = Mat3::Identity();
    Vec3 translation = Vec3::Zero();

    Vec3 to_world(const Vec3& local) const { return rotation * local + translation; }
    Vec3 to_local(const Vec3& world) const { return rotation.transpose() * (world - translation); }
};
WallPose pose_at(const WallMotion& motion, double time);
// Mean velocity over [t, t + h] of the wall's material point that is at `world` at t + h/2.
Vec3 mean_velocity(const WallMotion& motion, const Vec3& world, double time, double step);
// A bound on the speed [m/s] of the wall's material points within `reach` of `world`, from `time` on for `duration`.
double speed_bound(const WallMotion& motion, const Vec3& world, double reach, double time, double duration);
// Moves the description (shape and motion) by `shift`.
Wall translated(const Wall& wall, const Vec3& shift);

}  // namespace scree
