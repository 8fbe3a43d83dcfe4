#include "core/region.hpp"

#include <cmath>
#include <numbers>

namespace scree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Contains {
    const Vec3& x;

    bool operator()(const BoxRegion& r) const {
        return (x.array() >= r.lower.array()).all() && (x.array() <= r.upper.array()).all();
    }
    bool operator()(const CylinderRegion& r) const {
        const Vec3 d = x - r.base;
        const double along = d.dot(r.axis);
        return along >= 0.0 && along <= r.length && (d - along * r.axis).squaredNorm() <= r.radius * r.radius;
    }
    bool operator()(const SphereRegion& r) const { return (x - r.centre).squaredNorm() <= r.radius * r.radius; }
    bool operator()(const HalfSpaceRegion& r) const { return (x - r.point).dot(r.normal) <= 0.0; }
};

struct Volume {
    double operator()(const BoxRegion& r) const { return (r.upper - r.lower).prod(); }
    double operator()(const CylinderRegion& r) const { return std::numbers::pi * r.radius * r.radius * r.length; }
    double operator()(const SphereRegion& r) const {
        return 4.0 / 3.0 * std::numbers::pi * r.radius * r.radius * r.radius;
    }
    double operator()(const HalfSpaceRegion&) const { return kInfinity; }
};

struct Bounds {
    BoxRegion operator()(const BoxRegion& r) const { return r; }
    BoxRegion operator()(const CylinderRegion& r) const {
        // A disc with unit normal a reaches R sqrt(1 - a_i^2) along axis i.
        const Vec3 reach = r.radius * (Vec3::Ones() - r.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
        const Vec3 end = r.base + r.length * r.axis;
        return {r.base.cwiseMin(end) - reach, r.base.cwiseMax(end) + reach};
    }
    BoxRegion operator()(const SphereRegion& r) const {
        return {r.centre - Vec3::Constant(r.radius), r.centre + Vec3::Constant(r.radius)};
    }
    BoxRegion operator()(const HalfSpaceRegion&) const {
        return {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
    }
};

struct Translate {
    const Vec3& shift;

    Region operator()(const BoxRegion& r) const { return BoxRegion{r.lower + shift, r.upper + shift}; }
    Region operator()(CylinderRegion r) const {
        r.base += shift;
        return r;
    }
    Region operator()(SphereRegion r) const {
        r.centre += shift;
        return r;
    }
    Region operator()(HalfSpaceRegion r) const {
        r.point += shift;
        return r;
    }
};

}  // namespace

bool contains(const Region& region, const Vec3& x) {
    return std::visit(Contains{x}, region);
}
double volume(const Region& region) {
    return std::visit(Volume{}, region);
}
BoxRegion bounds(const Region& region) {
    return std::visit(Bounds{}, region);
}
Region translated(const Region& region, const Vec3& shift) {
    return std::visit(Translate{shift}, region);
}

}  // namespace scree
