// The table itself: whole, consistent, and told to the user.
#include "io/scenario/schema.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/errors.hpp"
#include "io/scenario/schema_text.hpp"

namespace scree::io {
namespace {

TEST(SchemaTable, EveryRowIsComplete) {
    for (const Row& row : schema_rows()) {
        EXPECT_GE(row.doc.size(), 5U) << row.path;
        EXPECT_EQ(row.doc.back(), '.') << row.path;
        EXPECT_EQ(row.kind == Kind::choice || row.kind == Kind::choices, !row.choices.empty()) << row.path;
        EXPECT_EQ(row.kind == Kind::table, !row.columns.empty()) << row.path;
        // A user can always tell what happens without the key.
        const bool shared = row.path.find('.') == std::string::npos && std::isupper(row.path[0]) != 0;
        const int answers =
            (row.is_required ? 1 : 0) + (row.standard.empty() ? 0 : 1) + (row.when_absent.empty() ? 0 : 1);
        EXPECT_EQ(answers, row.kind == Kind::variant || shared ? 0 : 1) << row.path;
    }
}

TEST(SchemaTable, EveryRowHangsInTheTree) {
    std::set<const Row*> reached;
    const auto visit = [&](const SchemaNode& node, const auto& again) -> void {
        if (node.row != nullptr) reached.insert(node.row);
        for (const SchemaNode* key : node.keys) again(*key, again);
        for (const SchemaNode* form : node.variants) again(*form, again);
    };
    visit(schema_root(), visit);
    for (const SchemaNode* shared : shared_sections()) visit(*shared, visit);
    EXPECT_EQ(reached.size(), schema_rows().size());
}

TEST(SchemaTable, RulesNameKeysThatAreThere) {
    std::set<std::string> paths;
    for (const Row& row : schema_rows()) paths.insert(row.path);
    for (const Rule& rule : schema_rules()) {
        for (const std::string& key : rule.keys) {
            const std::string direct = rule.where.empty() ? key : rule.where + "." + key;
            EXPECT_TRUE(paths.count(direct) + paths.count(rule.where + "[]." + key) == 1) << direct;
        }
    }
}

TEST(Explain, AKeyWithUnitDefaultRangeAndMeaning) {
    EXPECT_EQ(explain("correction.share"),
              "correction.share\n"
              "    expected: a number 0 to 1\n"
              "    default: 0.83\n"
              "    The share of each penetration that one step aims to take away. Large values shake dense packs,\n"
              "    small ones leave more overlap.\n");
    const std::string step = explain("time.step");
    EXPECT_NE(step.find("expected: a time > 0 (s, ms, us, min, h); a bare number is in s\n    required\n"),
              std::string::npos)
        << step;
}

TEST(Explain, FormsCanBeNamedInManyWays) {
    const std::string normal = explain("walls[plane].normal");
    EXPECT_EQ(normal.rfind("walls[plane].normal\n", 0), 0U);
    EXPECT_EQ(explain("walls.plane.normal"), normal);
    EXPECT_EQ(explain("walls[3].plane.normal"), normal);
    const std::string any = explain("walls[2].normal");
    EXPECT_NE(any.find(normal), std::string::npos);
    EXPECT_NE(any.find("walls[disc].normal\n"), std::string::npos);
    EXPECT_EQ(explain("materials.glass.density"), explain("materials.*.density"));
    EXPECT_EQ(explain("materials.density"), explain("materials.NAME.density"));
}

TEST(Explain, ALastPartListsAllKeysOfThatName) {
    const std::string text = explain("restitution");
    EXPECT_NE(text.find("materials.NAME.restitution\n"), std::string::npos);
    EXPECT_NE(text.find("pairs[].restitution\n"), std::string::npos);
    EXPECT_EQ(explain("tolerance"), explain("solver.tolerance"));
}

TEST(Explain, ASectionShowsItsKeys) {
    const std::string text = explain("correction");
    for (const char* key : {"correction\n", "correction.enabled\n", "correction.sweeps\n", "correction.share\n"}) {
        EXPECT_NE(text.find(key), std::string::npos) << key;
    }
    const std::string region = explain("bodies.random.region.sphere");
    EXPECT_NE(region.find("bodies[random].region[sphere].radius\n"), std::string::npos) << region;
}

TEST(Explain, AnUnknownKeyGetsTheNearest) {
    const auto message = [](const char* key) {
        try {
            return explain(key);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            return std::string(error.what());
        }
    };
    EXPECT_EQ(message("solver.tolerence")
                  .rfind("'solver.tolerence' is no key of a scenario (did you mean 'solver.tolerance'?)", 0),
              0U);
    EXPECT_EQ(message("tolerence").rfind("'tolerence' is no key of a scenario (did you mean 'tolerance'?)", 0), 0U);
    EXPECT_EQ(message("qqqqqqqqqqqq").rfind("'qqqqqqqqqqqq' is no key of a scenario; its first keys are ", 0), 0U);
    EXPECT_EQ(message("").rfind("'' is no key of a scenario; ", 0), 0U);
}

TEST(Reference, HasEveryKey) {
    const std::string page = reference_markdown();
    for (const Row& row : schema_rows()) {
        const auto dot = row.path.rfind('.');
        if (row.kind == Kind::variant) continue;
        const std::string key = dot == std::string::npos ? row.path : row.path.substr(dot + 1);
        const bool shared = dot == std::string::npos && std::isupper(key[0]) != 0;
        EXPECT_NE(page.find(shared ? "## " + key : "| `" + key + "` |"), std::string::npos) << row.path;
        EXPECT_NE(page.find(row.doc), std::string::npos) << row.path;
    }
}

}  // namespace
}  // namespace scree::io
