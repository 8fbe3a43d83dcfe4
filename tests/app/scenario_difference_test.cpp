#include "app/scenario_difference.hpp"

#include <gtest/gtest.h>

namespace scree::app {
namespace {

using io::Node;

Node leaf(double x) {
    Node node;
    node.value = x;
    return node;
}
Node map(Node::Map entries) {
    Node node;
    node.value = std::move(entries);
    return node;
}
Node list(Node::List items) {
    Node node;
    node.value = std::move(items);
    return node;
}

Node scenario(double end, double radius) {
    return map({{"time", map({{"end", leaf(end)}, {"step", leaf(1e-3)}})},
                {"walls", list({map({{"radius", leaf(1.0)}}), map({{"radius", leaf(radius)}})})}});
}

TEST(ScenarioDifference, NamesEachKeyThatDiffers) {
    EXPECT_TRUE(differing_keys(scenario(1.0, 2.0), scenario(1.0, 2.0)).empty());
    EXPECT_EQ(differing_keys(scenario(1.0, 2.0), scenario(3.0, 2.5)),
              (std::vector<std::string>{"time.end", "walls[1].radius"}));
}

TEST(ScenarioDifference, MissingKeysItemsAndKindsCount) {
    const Node full = map({{"a", leaf(1.0)}, {"b", leaf(2.0)}});
    const Node part = map({{"a", leaf(1.0)}});
    EXPECT_EQ(differing_keys(full, part), std::vector<std::string>{"b"});
    EXPECT_EQ(differing_keys(part, full), std::vector<std::string>{"b"});
    EXPECT_EQ(differing_keys(map({{"l", list({leaf(1.0)})}}), map({{"l", list({leaf(1.0), leaf(2.0)})}})),
              std::vector<std::string>{"l"});
    Node text;
    text.value = std::string("1");
    EXPECT_EQ(differing_keys(map({{"a", leaf(1.0)}}), map({{"a", text}})), std::vector<std::string>{"a"});
}

TEST(ScenarioDifference, OnlyWhatAltersNoStepMayChange) {
    EXPECT_TRUE(may_change_on_resume("time.end"));
    EXPECT_TRUE(may_change_on_resume("output.snapshot_interval"));
    EXPECT_TRUE(may_change_on_resume("title"));
    EXPECT_FALSE(may_change_on_resume("time.step"));
    EXPECT_FALSE(may_change_on_resume("time.end_not"));
    EXPECT_FALSE(may_change_on_resume("outputs"));
    EXPECT_FALSE(may_change_on_resume("output.fields[1]"));
    EXPECT_FALSE(may_change_on_resume("solver.tolerance"));
}

}  // namespace
}  // namespace scree::app
