#include "core/flat_shapes.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/make_shape.hpp"

namespace scree {
namespace {

// A wedge and a pyramid, neither along the axes.
std::vector<ConvexShape> two_shapes() {
    Polyhedron wedge{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}, {2, 0, 3}, {0, 1, 3}},
                     {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
    Polyhedron pyramid{{{1, 1, 0}, {-1, 1, 0.1}, {-1, -1, 0}, {1, -1, -0.1}, {0.2, 0, 2}},
                       {{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    return {make_shape(wedge).shape, make_shape(pyramid).shape};
}

TEST(FlatShapes, BackAndForthIsTheSameBits) {
    const auto shapes = two_shapes(), again = unflatten(flatten(shapes));
    ASSERT_EQ(again.size(), shapes.size());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const ConvexShape &a = shapes[s], &b = again[s];
        EXPECT_EQ(a.vertex, b.vertex);
        EXPECT_EQ(a.corner, b.corner);
        EXPECT_EQ(a.link_begin, b.link_begin);
        EXPECT_EQ(a.link, b.link);
        ASSERT_EQ(a.face.size(), b.face.size());
        for (std::size_t f = 0; f < a.face.size(); ++f) {
            EXPECT_EQ(a.face[f].normal, b.face[f].normal);
            EXPECT_EQ(a.face[f].offset, b.face[f].offset);
            EXPECT_EQ(a.face[f].begin, b.face[f].begin);
            EXPECT_EQ(a.face[f].count, b.face[f].count);
        }
        ASSERT_EQ(a.edge.size(), b.edge.size());
        for (std::size_t e = 0; e < a.edge.size(); ++e) {
            EXPECT_EQ(a.edge[e].from, b.edge[e].from);
            EXPECT_EQ(a.edge[e].to, b.edge[e].to);
            EXPECT_EQ(a.edge[e].left, b.edge[e].left);
            EXPECT_EQ(a.edge[e].right, b.edge[e].right);
        }
        EXPECT_EQ(a.volume, b.volume);
        EXPECT_EQ(a.inertia, b.inertia);
        EXPECT_EQ(a.radius, b.radius);
        EXPECT_EQ(a.inner_radius, b.inner_radius);
    }
}

TEST(FlatShapes, DamagedArraysAreRefused) {
    const FlatShapes good = flatten(two_shapes());
    const auto refused = [&](auto change) {
        FlatShapes flat = good;
        change(flat);
        EXPECT_THROW(unflatten(flat), IoError);
    };
    refused([](FlatShapes& f) { f.vertices[1] += 1; });
    refused([](FlatShapes& f) { f.corner[3] = 99; });
    refused([](FlatShapes& f) { f.sides[0] = 1000; });
    refused([](FlatShapes& f) { f.left[2] = 50; });
    refused([](FlatShapes& f) { f.volume.pop_back(); });
    refused([](FlatShapes& f) { f.vertices[0] = ~std::uint64_t{0}; });
}

}  // namespace
}  // namespace scree
