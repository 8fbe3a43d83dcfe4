// A vector that changes in time: constant, or linear between the rows of a table (constant before the first row and
// after the last).
#pragma once

#include <algorithm>
#include <vector>

#include "core/vec.hpp"

namespace scree {

struct TimeTable {
    std::vector<double> time;  // [s], increasing; at least one row
    std::vector<Vec3> value;   // one a row

    static TimeTable constant(const Vec3& v) { return {{0.0}, {v}}; }
    bool is_constant() const { return value.size() == 1; }

    Vec3 at(double t) const {
        const auto above = std::upper_bound(time.begin(), time.end(), t);
        if (above == time.begin()) return value.front();
        if (above == time.end()) return value.back();
        const auto i = static_cast<std::size_t>(above - time.begin());
        const double s = (t - time[i - 1]) / (time[i] - time[i - 1]);
        return (1.0 - s) * value[i - 1] + s * value[i];
    }
    // largest norm over all times
    double max_norm() const {
        double largest = 0.0;
        for (const Vec3& v : value) largest = std::max(largest, v.norm());
        return largest;
    }
};

}  // namespace scree
