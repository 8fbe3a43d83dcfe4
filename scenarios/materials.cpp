#include "scenarios/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace scree::scenarios {
namespace {

void set_pair(const io::Node& pair, const std::vector<PairLaw>& own, const Context& context, Scene& scene,
              std::map<std::pair<MaterialIndex, MaterialIndex>, int>& first_line) {
    const io::Node::List& names = pair.at("materials").items();
    if (names.size() != 2) {
        context.error(pair.at("materials"), fmt::format("takes two names, not {}", names.size()));
        return;
    }
    const std::size_t before = context.errors();
    MaterialIndex a = context.material(names[0]), b = context.material(names[1]);
    if (context.errors() != before) return;
    if (b < a) std::swap(a, b);
    const auto [earlier, is_new] = first_line.emplace(std::pair{a, b}, pair.mark.line);
    if (!is_new) {
        context.error(pair.at("materials"), fmt::format("the pair of '{}' and '{}' is already on line {}",
                                                        names[0].text(), names[1].text(), earlier->second));
        return;
    }
    const PairLaw &first = own[raw(a)], &second = own[raw(b)];
    scene.pairs.set(a, b,
                    {number_or(pair, "friction", std::min(first.friction, second.friction)),
                     number_or(pair, "restitution", 0.5 * (first.restitution + second.restitution))});
}

}  // namespace

void build_materials(const io::Node& scenario, Context& context, Scene& scene) {
    const io::Node& node = scenario.at("materials");
    std::vector<PairLaw> own;
    for (const auto& [name, properties] : std::get<io::Node::Map>(node.value)) {
        scene.materials.push_back({name, properties.number("density")});
        context.materials.push_back(name);
        own.push_back({number_or(properties, "friction", 0.5), number_or(properties, "restitution", 0.0)});
    }
    if (own.empty()) {
        context.error(node, "needs at least one material");
        scene.materials.push_back({"", 1.0});
        own.push_back({});
    }
    if (own.size() > std::numeric_limits<std::uint16_t>::max()) {
        context.error(node, fmt::format("has {} materials; at most 65535 are possible", own.size()));
        own.resize(1);
        scene.materials.resize(1);
        context.materials.resize(1);
    }
    scene.pairs = PairTable(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        for (std::size_t j = i; j < own.size(); ++j) {
            scene.pairs.set(
                MaterialIndex{static_cast<std::uint16_t>(i)}, MaterialIndex{static_cast<std::uint16_t>(j)},
                {std::min(own[i].friction, own[j].friction), std::min(own[i].restitution, own[j].restitution)});
        }
    }
    std::map<std::pair<MaterialIndex, MaterialIndex>, int> first_line;
    for (const io::Node& pair : items_of(scenario, "pairs")) set_pair(pair, own, context, scene, first_line);
}

}  // namespace scree::scenarios
