// The shapes of bodies that a file lists one by one. All ranks see all rows, so that each numbers the different shapes
// and sizes in the order of their first row, alike on all ranks.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "scenarios/figures.hpp"

namespace scree::scenarios {

// A variant of a shape of context.shapes, so many times as large.
struct RowInstance {
    std::size_t shape, variant;
    double factor;

    bool operator<(const RowInstance& other) const {
        return std::tie(shape, variant, factor) < std::tie(other.shape, other.variant, other.factor);
    }
};

struct RowFigure {
    std::size_t instance;
    double radius;  // [m] of the ball about the centre of mass that holds it
    Quat orientation;
};

class RowFigures {
  public:
    // Orientations as the key `orientation` of the file's node says, where rows have none.
    RowFigures(const io::Node& node, std::uint64_t stream, const Context& context);

    // The body of a row. `shape`: of context.shapes. `diameter` [m] of the ball of equal volume; 0: the shape's own
    // size. Nothing if the shape was found faulty.
    std::optional<RowFigure> figure(std::uint64_t row, std::size_t shape, double diameter,
                                    const std::optional<Quat>& turned);
    // All that the rows so far need.
    const std::vector<RowInstance>& instances() const { return instances_; }

  private:
    const Context& context_;
    std::uint64_t stream_;
    Orientations orientations_;
    std::map<RowInstance, std::size_t> number_;
    std::vector<RowInstance> instances_;
};

}  // namespace scree::scenarios
