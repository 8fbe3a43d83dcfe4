// Whatever is in the file: a tree, or at least one error with a place; never a crash, never another exception.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "io/scenario/scenario_reader.hpp"

namespace scree::io {
namespace {

const std::string kScenario =
    "scenario_version: 1\ntitle: \"a: b\"\nseed: 7\ntime: {end: 1 min, step: 5e-4}\n"
    "materials:\n  glass: &g {density: 2.5 g/cm3, friction: 0.3}\n  steel: {<<: *g, density: 7800}\n"
    "pairs:\n  - {materials: [glass, steel], friction: 0.2}\n"
    "shapes: [{name: s, kind: rock, volume: 2 L}, {name: h, kind: hull, points: [[0, 0, 0], [1, 0, 0]]}]\n"
    "bodies:\n  - {generator: polyhedron, shape: s, material: glass, position: [0, 0, 1],\n"
    "     orientation: {quaternion: [1, 0, 0, 0]}}\n"
    "  - {generator: rock_mass, material: glass, points: [[0, 0, 0]], joints: [{dip: 5 deg, spacing: 1}]}\n"
    "  - generator: random\n    material: glass\n"
    "    size: {distribution: uniform, lower: 5 mm, upper: 6 mm}\n"
    "    region: {shape: cylinder, base: [0, 0, 10 cm], radius: 0.05, length: 0.2}\n    count: 1e3\n"
    "walls:\n  - shape: plane  # floor\n    name: floor\n    material: steel\n    point: [0, 0, 0]\n    normal: [0, 0, "
    "1]\n"
    "measures: [{measure: wall_force, name: f, wall: floor}]\n"
    "output:\n  fields: [velocity, 'spin']\n";

void tree_or_errors(const std::string& text, const std::vector<std::string>& overrides) {
    Diagnostics diagnostics;
    const ReadResult first = read_scenario_text(text, "s.yaml", overrides, diagnostics);
    RC_ASSERT(diagnostics.has_errors() == first.resolved.empty());
    RC_ASSERT(diagnostics.has_errors() == !diagnostics.report().empty());
    if (diagnostics.has_errors()) return;
    Diagnostics again;
    RC_ASSERT(read_scenario_text(first.resolved, "s.yaml", {}, again).resolved == first.resolved);
    RC_ASSERT(!again.has_errors());
}

TEST(AnyScenario, TheUnchangedOneIsGood) {
    Diagnostics diagnostics;
    EXPECT_NE(read_scenario_text(kScenario, "s.yaml", {}, diagnostics).resolved, "");
    EXPECT_EQ(diagnostics.report(), "");
}

RC_GTEST_PROP(AnyScenario, OfRandomBytes, (const std::string& text)) {
    tree_or_errors(text, {});
}

RC_GTEST_PROP(AnyScenario, WithChangedCharacters, ()) {
    std::string text = kScenario;
    const int changes = *rc::gen::inRange(1, 8);
    for (int i = 0; i < changes; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        const std::string signs = "[]{}:,-&*!|>'\"%@`#?\n\t\\ 0.ea\xff~<";
        const char sign = signs[*rc::gen::inRange<std::size_t>(0, signs.size())];
        switch (*rc::gen::inRange(0, 3)) {
            case 0:
                text[at] = sign;
                break;
            case 1:
                text.insert(at, 1, sign);
                break;
            default:
                text.erase(at, *rc::gen::inRange<std::size_t>(1, 30));
        }
        if (text.empty()) break;
    }
    tree_or_errors(text, {});
}

// Words of a scenario in a wrong order.
RC_GTEST_PROP(AnyScenario, OfShuffledPieces, ()) {
    std::string text;
    const int pieces = *rc::gen::inRange(0, 12);
    for (int i = 0; i < pieces; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, kScenario.size());
        text += kScenario.substr(at, *rc::gen::inRange<std::size_t>(1, 60));
        if (*rc::gen::arbitrary<bool>()) text += "\n";
    }
    tree_or_errors(text, {});
}

RC_GTEST_PROP(AnyScenario, WithAnyOverride, (const std::string& value)) {
    const auto paths = std::vector<std::string>{"time.step",
                                                "walls[0].normal",
                                                "walls[+]",
                                                "bodies[0].size",
                                                "materials",
                                                "title",
                                                "seed",
                                                "output.fields[1]",
                                                "a.b[0].c",
                                                "",
                                                "measures[0]",
                                                "[0]",
                                                "pairs[0].materials[+]"};
    const auto& path = paths[*rc::gen::inRange<std::size_t>(0, paths.size())];
    tree_or_errors(kScenario, {path + "=" + value});
    tree_or_errors(kScenario, {path + value});
}

}  // namespace
}  // namespace scree::io
