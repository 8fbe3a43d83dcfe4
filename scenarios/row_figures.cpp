#include "scenarios/row_figures.hpp"

#include "scenarios/named_shapes.hpp"

namespace scree::scenarios {

RowFigures::RowFigures(const io::Node& node, std::uint64_t stream, const Context& context)
    : context_(context), stream_(stream) {
    if (node.has("orientation")) orientations_ = Orientations(node.at("orientation"), context);
}

std::optional<RowFigure> RowFigures::figure(std::uint64_t row, std::size_t shape, double diameter,
                                            const std::optional<Quat>& turned) {
    const NamedShape& named = context_.shapes[shape];
    if (named.variants.empty()) return std::nullopt;
    Random look = look_of(context_.seed, stream_, row);
    const std::size_t variant = named.draw_variant(look);
    const PlacedShape& placed = named.variants[variant];
    const double factor = diameter > 0.0 ? diameter / equivalent_diameter(placed.shape) : 1.0;
    const auto [at, is_new] = number_.try_emplace({shape, variant, factor}, instances_.size());
    if (is_new) instances_.push_back(at->first);
    const Quat q = turned ? *turned : orientations_.draw(look);
    return RowFigure{at->second, factor * placed.shape.radius, (q * placed.rotation).normalized()};
}

}  // namespace scree::scenarios
