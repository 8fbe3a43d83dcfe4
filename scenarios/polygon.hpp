// A polygon seen from above, in the local frame.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "scenarios/context.hpp"

namespace scree::scenarios {

class Polygon {
  public:
    // From rows [x, y] [m] of the scenario; fewer than three are reported.
    Polygon(const io::Node& rows, const Context& context) {
        for (const io::Node& row : rows.items())
            corner_.emplace_back(row.at(0).number() - context.origin.x(), row.at(1).number() - context.origin.y());
        if (!has_area()) context.error(rows, "a polygon has three corners or more");
    }
    bool has_area() const { return corner_.size() >= 3; }
    // Even-odd rule.
    bool holds(double x, double y) const {
        bool inside = false;
        for (std::size_t i = 0, j = corner_.size() - 1; i < corner_.size(); j = i++) {
            const auto& [ax, ay] = corner_[i];
            const auto& [bx, by] = corner_[j];
            if ((ay > y) == (by > y)) continue;
            inside ^= x < ax + (y - ay) / (by - ay) * (bx - ax);
        }
        return inside;
    }

  private:
    std::vector<std::pair<double, double>> corner_;
};

}  // namespace scree::scenarios
