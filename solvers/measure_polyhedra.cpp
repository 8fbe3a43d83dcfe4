#include "solvers/measure_polyhedra.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/errors.hpp"
#include "solvers/measure_overlap.hpp"

namespace scree::solvers::detail {
namespace {

// { x : normal . x <= offset }, counted from the body's centre of mass.
struct Side {
    Vec3 normal;
    double offset;  // [m]
};

const ConvexShape& shape_of(const State& state, std::size_t body) {
    return state.shapes[raw(state.bodies.shape[body])];
}

// Sutherland and Hodgman (1974): the part of a convex loop on one side of a plane.
void clip(const std::vector<Vec3>& loop, const Side& side, std::vector<Vec3>& kept) {
    kept.clear();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 &a = loop[i], &b = loop[i + 1 == loop.size() ? 0 : i + 1];
        const double da = side.normal.dot(a) - side.offset, db = side.normal.dot(b) - side.offset;
        if (da <= 0.0) kept.push_back(a);
        if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + da / (da - db) * (b - a));
    }
}

double area(const std::vector<Vec3>& loop, const Vec3& normal) {
    Vec3 twice = Vec3::Zero();
    for (std::size_t i = 2; i < loop.size(); ++i) twice += (loop[i - 1] - loop[0]).cross(loop[i] - loop[0]);
    return 0.5 * normal.dot(twice);
}

// A polyhedron in world axes about its centre of mass.
class Turned {
  public:
    Turned(const State& state, std::size_t body)
        : shape_(shape_of(state, body)), turn_(state.bodies.orientation[body].toRotationMatrix()) {
        for (const Vec3& v : shape_.vertex) vertex_.push_back(turn_ * v);
    }

    // Sides at right angles to one another.
    double volume_within(std::span<const Side> sides) const {
        std::array<Side, 3> cutting{};
        std::size_t count = 0;
        Vec3 meet = Vec3::Zero();
        for (const Side& side : sides) {
            const Reach reach = along(side.normal);
            if (side.offset <= reach.low) return 0.0;
            if (side.offset >= reach.high) continue;
            cutting[count++] = side;
            meet += side.offset * side.normal;
        }
        if (count == 0) return shape_.volume;
        double sum = 0.0;
        std::vector<Vec3> loop, kept;
        for (std::size_t f = 0; f < shape_.face.size(); ++f) {
            loop.clear();
            for (const std::uint32_t v : shape_.corners(f)) loop.push_back(vertex_[v]);
            for (std::size_t k = 0; k < count; ++k) {
                clip(loop, cutting[k], kept);
                loop.swap(kept);
            }
            const Vec3 normal = turn_ * shape_.face[f].normal;
            sum += (shape_.face[f].offset - normal.dot(meet)) * area(loop, normal);
        }
        return std::max(0.0, sum / 3.0);
    }

    double volume_between(const Vec3& axis, double low, double high) const {
        const Side below_high{axis, high}, below_low{axis, low};
        return std::max(0.0, volume_within({&below_high, 1}) - volume_within({&below_low, 1}));
    }

    double volume_in(const BoxRegion& box) const {
        double sum = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            std::array<Side, 3> sides;
            double sign = 1.0;
            for (int axis = 0; axis < 3; ++axis) {
                const bool low = (corner >> axis & 1) != 0;
                sides[static_cast<std::size_t>(axis)] = {Vec3::Unit(axis), low ? box.lower[axis] : box.upper[axis]};
                if (low) sign = -sign;
            }
            sum += sign * volume_within(sides);
        }
        return std::max(0.0, sum);
    }

  private:
    Reach along(const Vec3& axis) const {
        Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
        for (const Vec3& v : vertex_) {
            const double x = axis.dot(v);
            reach = {std::min(reach.low, x), std::max(reach.high, x)};
        }
        return reach;
    }

    const ConvexShape& shape_;
    Mat3 turn_;
    std::vector<Vec3> vertex_;  // [m]
};

}  // namespace

Reach reach_of(const State& state, std::size_t body, const Vec3& axis) {
    const Bodies& b = state.bodies;
    const double centre = b.position[body].dot(axis);
    if (b.is_sphere(body)) return {centre - b.radius[body], centre + b.radius[body]};
    const Vec3 turned = b.orientation[body].conjugate() * axis;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& v : shape_of(state, body).vertex) {
        const double x = turned.dot(v);
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return {centre + low, centre + high};
}

double volume_of(const State& state, std::size_t body) {
    return state.bodies.is_sphere(body) ? Bodies::sphere_mass(state.bodies.radius[body], 1.0)
                                        : shape_of(state, body).volume;
}

double part_in(const Region& region, const State& state, std::size_t body) {
    const Vec3& x = state.bodies.position[body];
    if (state.bodies.is_sphere(body)) return overlap_volume(region, x, state.bodies.radius[body]);
    if (const auto* box = std::get_if<BoxRegion>(&region))
        return Turned(state, body).volume_in({box->lower - x, box->upper - x});
    const auto* half = std::get_if<HalfSpaceRegion>(&region);
    SCREE_CHECK(half != nullptr);  // scenarios have said so
    const Side side{half->normal, half->normal.dot(half->point - x)};
    return Turned(state, body).volume_within({&side, 1});
}

double part_between(const State& state, std::size_t body, const Vec3& axis, double low, double high) {
    const double centre = state.bodies.position[body].dot(axis);
    if (state.bodies.is_sphere(body)) return slab_volume(state.bodies.radius[body], low - centre, high - centre);
    return Turned(state, body).volume_between(axis, low - centre, high - centre);
}

}  // namespace scree::solvers::detail
