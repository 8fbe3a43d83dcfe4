// Generators: from an item of `bodies` to bodies. The random numbers of body k of generator i are those of
// Random(seed, i, k), so that no body's size depends on any other body.
//
// On many ranks each makes a part of the bodies only, with the ids and the bits that one rank would give them: which
// rank holds which body at the start is of no meaning, since the time step moves them to where they belong.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/bodies.hpp"
#include "core/convex_shape.hpp"
#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// A rank's part of n things in a row.
struct Part {
    std::uint64_t begin, end;

    Part(std::uint64_t n, const Communicator& ranks)
        : begin(n * static_cast<std::uint64_t>(ranks.rank()) / static_cast<std::uint64_t>(ranks.size())),
          end(n * static_cast<std::uint64_t>(ranks.rank() + 1) / static_cast<std::uint64_t>(ranks.size())) {}
    bool has(std::uint64_t k) const { return begin <= k && k < end; }
};

// Bodies as they come, those of this rank. Positions in the local frame.
class BodyList {
  public:
    std::vector<std::uint64_t> id;  // increasing
    std::vector<double> radius;     // [m]
    std::vector<MaterialIndex> material;
    std::vector<Vec3> position, velocity, spin;  // [m], [m/s], [rad/s]
    std::vector<ShapeIndex> shape;               // kSphere or an index of `shapes`
    std::vector<Quat> orientation;               // of the body frame
    std::vector<ConvexShape> shapes;             // the same on all ranks; empty while all bodies are spheres
    std::vector<std::string> shape_name;         // of each: what it was made from
    std::uint64_t next_id = 0;                   // of the next generator's first body: the same on all ranks

    std::size_t size() const { return radius.size(); }
    void add(std::uint64_t i, double r, MaterialIndex m, const Vec3& x, const Vec3& v, const Vec3& w) {
        id.push_back(i);
        radius.push_back(r);
        material.push_back(m);
        position.push_back(x);
        velocity.push_back(v);
        spin.push_back(w);
        shape.push_back(kSphere);
        orientation.push_back(Quat::Identity());
    }
    // A polyhedron: `x` is its centre of mass, `q` turns the axes of its shape into the world's.
    void add(std::uint64_t i, ShapeIndex s, MaterialIndex m, const Vec3& x, const Quat& q, const Vec3& v,
             const Vec3& w) {
        add(i, shapes[raw(s)].radius, m, x, v, w);
        shape.back() = s;
        orientation.back() = q;
    }
    // `name`: what it is made from.
    ShapeIndex add_shape(ConvexShape s, std::string name = {}) {
        shapes.push_back(std::move(s));
        shape_name.push_back(std::move(name));
        return ShapeIndex{static_cast<std::uint32_t>(shapes.size() - 1)};
    }
    // A variant of context.shapes, `factor` times as large; the same one twice is one shape. To be called alike on all
    // ranks.
    ShapeIndex add_instance(const NamedShape& named, std::size_t variant, double factor);

  private:
    std::map<std::tuple<std::string, std::size_t, double>, ShapeIndex> instances_;
};

// More bodies than a LocalBody can count are refused, on each rank.
inline constexpr double kMostBodies = 4294967295.0;

// `ranks` share what is made: each calls the generator and gets its part.
void generate_sphere(const io::Node& node, const Context& context, const Communicator& ranks, BodyList& bodies);
void generate_polyhedron(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                         BodyList& bodies);
void generate_lattice(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                      BodyList& bodies);
// Blocks that fill a part of space, and masonry. Every rank makes all shapes.
void generate_voronoi(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                      BodyList& bodies);
void generate_rock_mass(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                        BodyList& bodies);
void generate_wall_of_blocks(const io::Node& node, const Context& context, const Communicator& ranks, BodyList& bodies);
void generate_arch(const io::Node& node, const Context& context, const Communicator& ranks, BodyList& bodies);
// Bodies in what was taken from a terrain of the scene. Every rank looks at all places.
void generate_release(const io::Node& node, std::uint64_t stream, const Context& context, const Scene& scene,
                      const Communicator& ranks, BodyList& bodies);
// Keeps clear of the bodies already in the list and of the walls that are there at time 0. Each place depends on all
// that were taken before, so the list must be whole, and all bodies are made: on many ranks each does all the work and
// holds the bodies of the whole region for a while.
void generate_random(const io::Node& node, std::uint64_t stream, const Context& context, const Scene& scene,
                     BodyList& bodies);

}  // namespace scree::scenarios
