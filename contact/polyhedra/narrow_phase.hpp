// Where two things touch, whatever their shapes, in scenes with polyhedra: one call a pair, one file a pair of shapes
// behind it. Between pairs it keeps the bodies placed in the world and the room to work in, so that a step allocates
// nothing.
#pragma once

#include <span>
#include <vector>

#include "contact/candidate_list.hpp"
#include "contact/polyhedra/axis_cache.hpp"
#include "contact/polyhedra/manifold.hpp"
#include "contact/polyhedra/placed.hpp"
#include "contact/polyhedra/polyhedron_wall.hpp"
#include "contact/polyhedra/scratch.hpp"
#include "contact/walls/wall_contact.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::contact {

// One point at which a body touches a wall.
struct WallPoint {
    Vec3 point;   // [m] world
    Vec3 normal;  // unit, world, from the wall to the body
    double gap;   // [m]
    std::uint32_t feature, part;
};

class NarrowPhase {
  public:
    // Bodies and shapes where they are now; `state` must stay. `pairs`: how many will be asked for, more or less.
    void place(const State& state, std::size_t pairs);

    // Points where bodies i < j are at most `margin` apart; the normal points from j to i. `coming`: v_j - v_i [m/s],
    // for spheres whose centres coincide. Valid until the next call.
    std::span<const ManifoldPoint> pair(std::size_t i, std::size_t j, double margin, const Vec3& coming);
    // The same for body i and a wall that stands as `frame` tells.
    std::span<const WallPoint> wall(const WallShape& shape, const WallFrame& frame, std::size_t i, double margin);

    std::size_t bytes() const;

  private:
    bool is_sphere(std::size_t i) const { return placed_[i].shape == nullptr; }
    void ball_on_wall(const WallShape& shape, const WallFrame& frame, std::size_t i, double radius, double margin);
    void add_points(const Manifold& manifold, const WallFrame& frame, std::uint32_t part);
    void polyhedron_on_block(const BoxWall& box, const WallFrame& frame, std::size_t i, double margin);
    void polyhedron_on_terrain(const WallShape& shape, const WallFrame& frame, std::size_t i, double margin);
    Placed in_frame(const WallFrame& frame, std::size_t i);

    const State* state_ = nullptr;
    std::vector<Placed> placed_;   // n; of spheres only the position
    std::vector<Vec3> room_;       // vertices and normals of all bodies
    std::vector<Vec3> wall_room_;  // and of one, in a wall's frame
    AxisCache axes_;
    PolyhedraScratch scratch_;
    Manifold manifold_;
    WallPlaces places_;
    // Boxes that keep bodies outside, as shapes, by their sides; few.
    struct Block {
        Vec3 sides;  // [m]
        ConvexShape shape;
        std::vector<Vec3> room;
    };
    const Block& block_of(const Vec3& sides);
    std::vector<Block> blocks_;
    std::vector<WallPoint> wall_points_;
};

}  // namespace scree::contact
