#include "contact/polyhedra/polyhedron_wall.hpp"

#include <algorithm>
#include <cmath>

#include "contact/polyhedra/corners.hpp"
#include "contact/polyhedra/patch.hpp"
#include "contact/walls/axial_frame.hpp"

namespace scree::contact {
namespace {

using detail::AxialFrame;
using detail::Corners;

struct SurfacePoint {
    double gap;   // [m] of the point from the surface
    Vec3 normal;  // unit, towards the side of the body
    double u, v;  // [m] where on the surface, unrolled
    bool beside;  // the surface has a foot for the point
};

// The vertices within the margin, at most as many as a manifold holds.
template <class Surface>
void touch(const Surface& surface, std::uint32_t place, const Placed& body, double margin, WallPlaces& out) {
    Corners corners(kSameCorner * body.shape->radius, margin);
    for (std::uint32_t i = 0; i < body.vertex.size(); ++i) {
        const SurfacePoint s = surface(Vec3(body.position + body.vertex[i]));
        if (!s.beside || s.gap > margin) continue;
        corners.add({s.u, s.v, 0.0, s.gap, feature_key(Meeting::vertex_of_a, i, place)});
    }
    if (corners.size() == 0 || out.count == WallPlaces::kCapacity) return;
    corners.reduce(Manifold::kCapacity);
    Manifold& found = out.item[static_cast<std::size_t>(out.count++)];
    found.count = 0, found.area = corners.hull_area();
    for (int i = 0; i < corners.size(); ++i) {
        const FeatureKey key = corners[i].key;
        const Vec3 x = body.position + body.vertex[key >> 15U & (kMostFeatures - 1)];
        const SurfacePoint s = surface(x);
        found.add({x - 0.5 * s.gap * s.normal, s.normal, s.gap, key});
    }
}

class FlatSide {
  public:
    FlatSide(const Vec3& point, const Vec3& normal, double radius = kForever)
        : point_(point), normal_(normal), radius_(radius), u_(AxialFrame::any_perpendicular(normal)) {
        v_ = normal.cross(u_);
    }
    SurfacePoint operator()(const Vec3& x) const {
        const Vec3 relative = x - point_;
        const double u = u_.dot(relative), v = v_.dot(relative);
        return {normal_.dot(relative), normal_, u, v, u * u + v * v <= radius_ * radius_};
    }

  private:
    Vec3 point_, normal_;
    double radius_;
    Vec3 u_, v_;
};

// The inside of a cone or cylinder, as in walls/cone.cpp. `about` is a point that lies in the half-plane u = 0.
class Shell {
  public:
    Shell(const Vec3& base, const Vec3& axis, double radius_base, double widening, double length, const Vec3& about)
        : base_(base), axis_(axis), radius_(radius_base), length_(length) {
        const double slant = std::isinf(length) ? 1.0 : std::hypot(widening, length);
        t_radial_ = widening / slant, t_axial_ = std::isinf(length) ? 1.0 : length / slant;
        size_ = std::isinf(length) ? kForever : slant;
        start_ = AxialFrame(about, base, axis).outward(axis);
    }
    SurfacePoint operator()(const Vec3& x) const {
        const AxialFrame at(x, base_, axis_);
        const double from_base = at.distance - radius_;
        const double foot = from_base * t_radial_ + at.height * t_axial_;
        const Vec3 outward = at.outward(axis_);
        const double angle = std::atan2(axis_.cross(start_).dot(outward), start_.dot(outward));
        return {at.height * t_radial_ - from_base * t_axial_, t_radial_ * axis_ - t_axial_ * outward,
                at.distance * angle, foot, std::isinf(length_) || (foot >= 0.0 && foot <= size_)};
    }
    bool holds(const Vec3& x) const {
        const SurfacePoint s = (*this)(x);
        return std::isinf(length_) || (s.beside && s.gap >= 0.0);
    }

  private:
    Vec3 base_, axis_;
    double radius_, length_, size_, t_radial_, t_axial_;
    Vec3 start_;
};

void box(const BoxWall& wall, const Placed& body, double margin, WallPlaces& out) {
    const bool closed = !wall.open_top && !wall.open_bottom;
    const Vec3& centre = body.position;
    if (!closed && ((centre - wall.lower).minCoeff() < 0.0 || (wall.upper - centre).minCoeff() < 0.0)) return;
    for (int i = 0; i < 3; ++i) {
        for (const bool upper : {false, true}) {
            if (i == 2 && (upper ? wall.open_top : wall.open_bottom)) continue;
            const FlatSide side(upper ? wall.upper : wall.lower, upper ? Vec3(-Vec3::Unit(i)) : Vec3(Vec3::Unit(i)));
            const auto surface = [&](const Vec3& x) {
                SurfacePoint s = side(x);
                s.beside =
                    (!wall.open_top || x.z() <= wall.upper.z()) && (!wall.open_bottom || x.z() >= wall.lower.z());
                return s;
            };
            touch(surface, static_cast<std::uint32_t>(2 * i) + (upper ? 1U : 0U), body, margin, out);
        }
    }
}

struct Touch {
    const Placed& body;
    double margin;
    WallPlaces& out;

    void operator()(const PlaneWall& w) const { touch(FlatSide(w.point, w.normal), 0, body, margin, out); }
    void operator()(const BoxWall& w) const {
        if (w.inside) box(w, body, margin, out);
    }
    void operator()(const CylinderWall& w) const {
        const Shell shell(w.base, w.axis, w.radius, 0.0, w.length, body.position);
        if (w.inside && shell.holds(body.position)) touch(shell, 0, body, margin, out);
    }
    void operator()(const ConeWall& w) const {
        const Shell shell(w.base, w.axis, w.radius_base, w.radius_end - w.radius_base, w.length, body.position);
        if (w.inside && shell.holds(body.position)) touch(shell, 0, body, margin, out);
    }
    void operator()(const DiscWall& w) const {
        const bool before = w.normal.dot(body.position - w.centre) >= 0.0;
        touch(FlatSide(w.centre, before ? w.normal : Vec3(-w.normal), w.radius), 0, body, margin, out);
    }
    void operator()(const OrificeFloor&) const {}
    void operator()(const SlotFloor&) const {}
    void operator()(const TerrainWall&) const {}
};

struct Cover {
    WallCover operator()(const PlaneWall&) const { return WallCover::exact; }
    WallCover operator()(const BoxWall& w) const {
        if (!w.inside) return WallCover::exact;
        return w.open_top || w.open_bottom ? WallCover::inside : WallCover::exact;
    }
    WallCover operator()(const CylinderWall& w) const {
        if (!w.inside) return WallCover::none;
        return std::isinf(w.length) ? WallCover::exact : WallCover::inside;
    }
    WallCover operator()(const ConeWall& w) const { return w.inside ? WallCover::inside : WallCover::none; }
    WallCover operator()(const DiscWall&) const { return WallCover::inside; }
    WallCover operator()(const OrificeFloor&) const { return WallCover::none; }
    WallCover operator()(const SlotFloor&) const { return WallCover::none; }
    WallCover operator()(const TerrainWall&) const { return WallCover::exact; }
};

}  // namespace

WallCover polyhedron_wall_cover(const WallShape& shape) {
    return std::visit(Cover{}, shape);
}

void polyhedron_wall(const WallShape& shape, const Placed& body, double margin, WallPlaces& out) {
    out.count = 0;
    std::visit(Touch{body, margin, out}, shape);
}

}  // namespace scree::contact
