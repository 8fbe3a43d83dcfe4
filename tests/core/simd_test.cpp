// Packs against plain doubles and floats: the same bits, lane by lane.
#include "core/simd_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

template <class Real>
void expect_any_less_sees_every_lane() {
    using Numbers = PackOf<Real>;
    alignas(64) Real x[Numbers::kLanes] = {};
    EXPECT_FALSE(any_less(Numbers::load(x), Numbers::all(0)));
    for (Real& one : x) {
        one = Real(-1);
        EXPECT_TRUE(any_less(Numbers::load(x), Numbers::all(0)));
        one = std::numeric_limits<Real>::quiet_NaN();
        EXPECT_FALSE(any_less(Numbers::load(x), Numbers::all(0)));
        one = 0;
    }
}
TEST(Simd, AnyLessSeesEveryLane) {
    expect_any_less_sees_every_lane<double>();
    expect_any_less_sees_every_lane<float>();
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

TEST(Simd, MaskOfTheLanesThatAreLessOrEqual) {
    Random random(4, 1, 0);
    std::uint32_t seen = 0, missed = 0;
    for (int round = 0; round < 100; ++round) {
        const Lanes a = random_lanes(random);
        Lanes b = random_lanes(random);
        b.x[round % kLanes] = a.x[round % kLanes];  // equal counts
        b.x[(round + 3) % kLanes] = std::numeric_limits<double>::quiet_NaN();
        std::uint32_t expected = 0;
        for (int i = 0; i < kLanes; ++i) expected |= a.x[i] <= b.x[i] ? 1U << i : 0U;
        EXPECT_EQ(mask_less_equal(Pack::load(a.x), Pack::load(b.x)), expected);
        seen |= expected;
        missed |= ~expected;
    }
    EXPECT_EQ(seen & missed & 0xffU, 0xffU);  // every lane both ways
    EXPECT_EQ(mask_less_equal(Pack::all(-0.0), Pack::all(0.0)), 0xffU);
    EXPECT_EQ(mask_less_equal(Pack::all(1.0), Pack::all(-1.0)), 0U);
}

TEST(Simd, LoadsFromAnyAddress) {
    alignas(64) std::array<double, 3 * kLanes> table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = static_cast<double>(i);
    for (std::size_t from = 0; from + kLanes <= table.size(); ++from) {
        Lanes got;
        Pack::load_anywhere(table.data() + from).store(got.x);
        for (std::size_t i = 0; i < kLanes; ++i) EXPECT_EQ(got.x[i], table[from + i]);
    }
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

template <class Real>
struct alignas(64) Numbers {
    Real x[PackOf<Real>::kLanes];
};

TEST(Simd, ArithmeticOfFloatsIsThatOfFloats) {
    Random random(3, 1, 0);
    for (int round = 0; round < 100; ++round) {
        Numbers<float> a, b, r;
        for (float& x : a.x) x = static_cast<float>(random.normal());
        for (float& x : b.x) x = static_cast<float>(random.normal());
        const PackF p = PackF::load(a.x), q = PackF::load(b.x);
        const auto expect = [&](const PackF& got, auto scalar) {
            got.store(r.x);
            for (int i = 0; i < kLanesSingle; ++i) EXPECT_EQ(r.x[i], scalar(a.x[i], b.x[i]));
        };
        expect(p * q - p / q, [](float x, float y) { return x * y - x / y; });
        expect(max(p, q) + min(p, PackF::all(0.5F)),
               [](float x, float y) { return std::max(x, y) + std::min(x, 0.5F); });
        expect(sqrt(p * p + q * q), [](float x, float y) { return std::sqrt(x * x + y * y); });
        expect(where_less(p, q, p, q), [](float x, float y) { return x < y ? x : y; });
        EXPECT_EQ(max_lanes(p), static_cast<double>(*std::max_element(a.x, a.x + kLanesSingle)));
    }
}

template <class Real, int kColumns>
void expect_rows_there_and_back() {
    constexpr std::size_t kLanesHere = PackOf<Real>::kLanes;
    struct alignas(sizeof(Real) * kColumns) Line {
        Real x[kColumns];
    };
    std::array<Line, 40> table;
    for (std::size_t i = 0; i < table.size(); ++i)
        for (int c = 0; c < kColumns; ++c) table[i].x[c] = static_cast<Real>(10 * static_cast<int>(i) + c);
    const auto start = table;
    const auto index = [](int i) { return static_cast<std::size_t>(i * 7 % 40); };  // no row twice
    PackOf<Real> pack[kColumns];
    const auto row = [&](int i) { return table[index(i)].x; };
    if constexpr (kColumns == 8)
        gather8(row, pack);
    else
        gather4(row, pack[0], pack[1], pack[2], pack[3]);
    for (int c = 0; c < kColumns; ++c) {
        Numbers<Real> got;
        pack[c].store(got.x);
        for (std::size_t i = 0; i < kLanesHere; ++i) EXPECT_EQ(got.x[i], start[index(static_cast<int>(i))].x[c]);
        pack[c] = pack[c] + PackOf<Real>::all(static_cast<Real>(1000 * (c + 1)));
    }
    if constexpr (kColumns == 8)
        scatter8(row, pack);
    else
        scatter4(row, pack[0], pack[1], pack[2], pack[3]);
    std::array<bool, 40> written{};
    for (int i = 0; i < static_cast<int>(kLanesHere); ++i) written[index(i)] = true;
    for (std::size_t i = 0; i < table.size(); ++i)
        for (int c = 0; c < kColumns; ++c)
            EXPECT_EQ(table[i].x[c], start[i].x[c] + static_cast<Real>(written[i] ? 1000 * (c + 1) : 0));
}

TEST(Simd, RowsThereAndBackInBothPrecisions) {
    expect_rows_there_and_back<float, 4>();
    expect_rows_there_and_back<float, 8>();
    expect_rows_there_and_back<double, 4>();
    expect_rows_there_and_back<double, 8>();
}

}  // namespace
}  // namespace scree
