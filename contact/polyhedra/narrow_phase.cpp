#include "contact/polyhedra/narrow_phase.hpp"

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "contact/polyhedra/polyhedron_triangle.hpp"
#include "contact/polyhedra/sphere_polyhedron.hpp"
#include "contact/sphere_sphere.hpp"
#include "core/make_shape.hpp"
#include "core/terrain.hpp"

namespace scree::contact {

void NarrowPhase::place(const State& state, std::size_t pairs) {
    state_ = &state;
    axes_.reserve(pairs);
    const Bodies& bodies = state.bodies;
    std::size_t size = 0, largest = 0;
    for (const ShapeIndex s : bodies.shape) {
        if (s == kSphere) continue;
        const std::size_t here = placed_size(state.shapes[raw(s)]);
        size += here;
        largest = std::max(largest, here);
    }
    room_.resize(size);
    wall_room_.resize(std::max(wall_room_.size(), largest));
    placed_.resize(bodies.size());
    std::span<Vec3> left(room_);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_sphere(i)) {
            placed_[i] = {nullptr, bodies.position[i], {}, {}};
            continue;
        }
        const ConvexShape& shape = state.shapes[raw(bodies.shape[i])];
        placed_[i] = contact::place(shape, bodies.position[i], bodies.orientation[i], left);
        left = left.subspan(placed_size(shape));
    }
}

std::span<const ManifoldPoint> NarrowPhase::pair(std::size_t i, std::size_t j, double margin, const Vec3& coming) {
    const Bodies& bodies = state_->bodies;
    const Placed &a = placed_[i], &b = placed_[j];
    manifold_.count = 0;
    const auto add = [&](const Vec3& normal, double gap, const Vec3& sphere, double radius, double side,
                         FeatureKey key) {
        // half-way between the surfaces, from the sphere's centre towards the other body
        if (gap <= margin) manifold_.add({sphere - side * (radius + 0.5 * gap) * normal, normal, gap, key});
    };
    if (is_sphere(i) && is_sphere(j)) {
        const SphereGap g = sphere_sphere(a.position, b.position, bodies.radius[i] + bodies.radius[j], coming);
        add(g.normal, g.gap, a.position, bodies.radius[i], 1.0, 0);
    } else if (is_sphere(i)) {
        const SpherePolyhedronGap g = sphere_polyhedron(a.position, bodies.radius[i], b);
        add(g.normal, g.gap, a.position, bodies.radius[i], 1.0, g.key());
    } else if (is_sphere(j)) {
        const SpherePolyhedronGap g = sphere_polyhedron(b.position, bodies.radius[j], a);
        add(-g.normal, g.gap, b.position, bodies.radius[j], -1.0, g.key());
    } else {
        polyhedron_polyhedron(a, b, margin, axes_.axis(bodies.id[i], bodies.id[j]), scratch_, manifold_);
    }
    return manifold_.points();
}

// A ball about the centre of body i.
void NarrowPhase::ball_on_wall(const WallShape& shape, const WallFrame& frame, std::size_t i, double radius,
                               double margin) {
    const Vec3& x = placed_[i].position;
    WallContacts found;
    find_contacts(shape, frame.moves ? frame.pose.to_local(x) : x, radius, margin, found);
    for (int k = 0; k < found.count; ++k) {
        const WallContact& c = found.item[static_cast<std::size_t>(k)];
        const Vec3 normal = frame.moves ? Vec3(frame.pose.rotation * c.normal) : c.normal;
        wall_points_.push_back({x - (radius + 0.5 * c.gap) * normal, normal, c.gap, c.feature, 0});
    }
}

void NarrowPhase::add_points(const Manifold& manifold, const WallFrame& frame, std::uint32_t part) {
    for (const ManifoldPoint& p : manifold.points()) {
        if (frame.moves)
            wall_points_.push_back({frame.pose.to_world(p.point), frame.pose.rotation * p.normal, p.gap, p.key, part});
        else
            wall_points_.push_back({p.point, p.normal, p.gap, p.key, part});
    }
}

// Terrain does not move.
void NarrowPhase::polyhedron_on_terrain(const WallShape& shape, const WallFrame& frame, std::size_t i, double margin) {
    const Terrain& terrain = *std::get<TerrainWall>(shape).terrain;
    const Placed& body = placed_[i];
    Vec3 low = body.vertex[0], high = low;
    for (const Vec3& v : body.vertex) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
    }
    const Vec3 room = Vec3::Constant(margin);
    // a triangle above a body that has sunk in must be found too
    const Vec3 deep(0.0, 0.0, terrain_depth(body.shape->radius));
    terrain.visit(body.position + low - room, body.position + high + room + deep, [&](std::uint32_t t) {
        if (polyhedron_triangle(body, terrain.mesh, t, terrain_depth(body.shape->radius), margin, scratch_, manifold_))
            add_points(manifold_, frame, t);
    });
    // farther in than triangles look, or beyond the border: never silence
    if (wall_points_.empty() && (terrain.under(body.position) || terrain.outside(body.position)))
        ball_on_wall(shape, frame, i, body.shape->inner_radius, margin);
}

const NarrowPhase::Block& NarrowPhase::block_of(const Vec3& sides) {
    for (const Block& block : blocks_)
        if (block.sides == sides) return block;
    Polyhedron box;
    for (int k = 0; k < 8; ++k)
        box.vertex.push_back(0.5 * sides.cwiseProduct(Vec3((k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0,
                                                           (k & 4) != 0 ? 1.0 : -1.0)));
    box.face = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    Block block{sides, {}, {}};
    const PlacedShape made = make_shape(box);
    block.shape = made.shape;
    block.room.resize(placed_size(block.shape));
    contact::place(block.shape, Vec3::Zero(), made.rotation, block.room);
    blocks_.push_back(std::move(block));
    return blocks_.back();
}

// A box with bodies outside is a polyhedron that does not move by itself.
void NarrowPhase::polyhedron_on_block(const BoxWall& box, const WallFrame& frame, std::size_t i, double margin) {
    const Block& block = block_of(box.upper - box.lower);
    const std::span<const Vec3> room(block.room);
    const std::size_t vertices = block.shape.vertex.size();
    const Placed placed{&block.shape, 0.5 * (box.lower + box.upper), room.first(vertices), room.subspan(vertices)};
    Vec3 no_guess = Vec3::Zero();
    if (polyhedron_polyhedron(in_frame(frame, i), placed, margin, no_guess, scratch_, manifold_))
        add_points(manifold_, frame, 0);
}

Placed NarrowPhase::in_frame(const WallFrame& frame, std::size_t i) {
    const Placed& body = placed_[i];
    if (!frame.moves) return body;
    const Quat turn(Mat3(frame.pose.rotation.transpose()));
    return contact::place(*body.shape, frame.pose.to_local(body.position), turn * state_->bodies.orientation[i],
                          wall_room_);
}

std::span<const WallPoint> NarrowPhase::wall(const WallShape& shape, const WallFrame& frame, std::size_t i,
                                             double margin) {
    wall_points_.clear();
    if (is_sphere(i)) {
        ball_on_wall(shape, frame, i, state_->bodies.radius[i], margin);
    } else if (std::holds_alternative<TerrainWall>(shape)) {
        polyhedron_on_terrain(shape, frame, i, margin);
    } else if (const auto* box = std::get_if<BoxWall>(&shape); box != nullptr && !box->inside) {
        polyhedron_on_block(*box, frame, i, margin);
    } else {
        polyhedron_wall(shape, in_frame(frame, i), margin, places_);
        for (const Manifold& place : places_.places()) add_points(place, frame, 0);
    }
    return wall_points_;
}

std::size_t NarrowPhase::bytes() const {
    return placed_.capacity() * sizeof(Placed) + (room_.capacity() + wall_room_.capacity()) * sizeof(Vec3) +
           axes_.bytes() + wall_points_.capacity() * sizeof(WallPoint);
}

}  // namespace scree::contact
