// Packs of eight against plain doubles: the same bits, lane by lane.
#include "core/simd.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/random.hpp"

namespace scree {
namespace {

struct alignas(64) Lanes {
    double x[kLanes];
};
Lanes random_lanes(Random& random) {
    Lanes a;
    for (double& x : a.x) x = random.normal();
    return a;
}

template <class Operation, class Scalar>
void expect_same(Operation operation, Scalar scalar) {
    Random random(1, 1, 0);
    for (int round = 0; round < 100; ++round) {
        const Lanes a = random_lanes(random), b = random_lanes(random);
        Lanes r;
        operation(Pack::load(a.x), Pack::load(b.x)).store(r.x);
        for (int i = 0; i < kLanes; ++i) EXPECT_EQ(r.x[i], scalar(a.x[i], b.x[i]));
    }
}

TEST(Simd, ArithmeticIsThatOfDoubles) {
    expect_same([](Pack a, Pack b) { return a + b; }, [](double a, double b) { return a + b; });
    expect_same([](Pack a, Pack b) { return a - b; }, [](double a, double b) { return a - b; });
    expect_same([](Pack a, Pack b) { return a * b; }, [](double a, double b) { return a * b; });
    expect_same([](Pack a, Pack b) { return a / b; }, [](double a, double b) { return a / b; });
    expect_same([](Pack a, Pack b) { return max(a, b); }, [](double a, double b) { return std::max(a, b); });
    expect_same([](Pack a, Pack b) { return min(a, b); }, [](double a, double b) { return std::min(a, b); });
    expect_same([](Pack a, Pack b) { return sqrt(a * a + b * b); },
                [](double a, double b) { return std::sqrt(a * a + b * b); });
    expect_same([](Pack a, Pack b) { return where_less(a, b, a, a + b); },
                [](double a, double b) { return a < b ? a : a + b; });
    expect_same([](Pack a, Pack b) { return where_less(a, a, b, a); }, [](double a, double) { return a; });
}

TEST(Simd, SumAndMaximumOverTheLanes) {
    Random random(2, 1, 0);
    for (int round = 0; round < 100; ++round) {
        const Lanes a = random_lanes(random);
        double largest = a.x[0];
        for (const double x : a.x) largest = std::max(largest, x);
        EXPECT_EQ(max_lanes(Pack::load(a.x)), largest);
        EXPECT_EQ(sum_lanes(Pack::load(a.x)),
                  ((a.x[0] + a.x[1]) + (a.x[2] + a.x[3])) + ((a.x[4] + a.x[5]) + (a.x[6] + a.x[7])));
    }
}

TEST(Simd, CrossAndDot) {
    const Pack3 x{Pack::all(1.0), Pack::all(2.0), Pack::all(3.0)}, y{Pack::all(4.0), Pack::all(-5.0), Pack::all(6.0)};
    const Pack3 c = cross(x, y);
    EXPECT_EQ(max_lanes(dot(x, y)), 12.0);
    EXPECT_EQ(max_lanes(c.x), 27.0);
    EXPECT_EQ(max_lanes(c.y), 6.0);
    EXPECT_EQ(max_lanes(c.z), -13.0);
}

struct alignas(32) Row {
    double x[4];
};

TEST(Simd, GatherTurnsRowsIntoPacks) {
    std::array<Row, 20> table;
    for (int i = 0; i < 20; ++i)
        for (int c = 0; c < 4; ++c) table[static_cast<std::size_t>(i)].x[c] = 10.0 * i + c;
    const std::array<int, kLanes> index{7, 0, 19, 3, 3, 12, 0, 1};  // rows may be asked for twice
    std::array<Pack, 4> pack;
    gather4([&](int i) { return table[static_cast<std::size_t>(index[static_cast<std::size_t>(i)])].x; }, pack[0],
            pack[1], pack[2], pack[3]);
    for (int c = 0; c < 4; ++c) {
        Lanes r;
        pack[static_cast<std::size_t>(c)].store(r.x);
        for (int i = 0; i < kLanes; ++i) EXPECT_EQ(r.x[i], 10.0 * index[static_cast<std::size_t>(i)] + c);
    }
}

TEST(Simd, ScatterPutsPacksBackAndTouchesNothingElse) {
    std::array<Row, 20> table;
    for (Row& row : table)
        for (double& x : row.x) x = -1.0;
    const std::array<std::size_t, kLanes> index{7, 0, 19, 3, 4, 12, 2, 1};
    std::array<Lanes, 4> lanes;
    for (std::size_t c = 0; c < 4; ++c)
        for (int i = 0; i < kLanes; ++i) lanes[c].x[i] = 10.0 * i + static_cast<double>(c);
    scatter4([&](int i) { return table[index[static_cast<std::size_t>(i)]].x; }, Pack::load(lanes[0].x),
             Pack::load(lanes[1].x), Pack::load(lanes[2].x), Pack::load(lanes[3].x));
    std::array<bool, 20> written{};
    for (std::size_t i = 0; i < kLanes; ++i) {
        written[index[i]] = true;
        for (int c = 0; c < 4; ++c) EXPECT_EQ(table[index[i]].x[c], 10.0 * static_cast<double>(i) + c);
    }
    for (std::size_t k = 0; k < table.size(); ++k) {
        if (written[k]) continue;
        for (const double x : table[k].x) EXPECT_EQ(x, -1.0);
    }
}

}  // namespace
}  // namespace scree
