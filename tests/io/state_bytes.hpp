// States compared to the bit.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "core/state.hpp"

namespace scree::io::testing {

// Every byte of every number of a state, in the order of its members; -0.0 is not 0.0 here.
class StateBytes {
  public:
    explicit StateBytes(const State& s) {
        all(s.time, s.step, s.next_id, s.block_size, s.snapshots_written, s.history_rows, s.trajectory_rows);
        list(s.followed);
        const Bodies& b = s.bodies;
        list(b.id), list(b.radius), list(b.mass), list(b.material), list(b.position), list(b.velocity), list(b.spin);
        all(b.orientation.size());
        for (const Quat& q : b.orientation) all(q.w(), q.x(), q.y(), q.z());
        all(s.warm_start.key.size(), s.warm_start.step);
        for (const ContactKey& k : s.warm_start.key) all(k.a, k.b, k.feature);
        list(s.warm_start.impulse_vector), list(s.warm_start.impulse_normal);
        all(s.inlets.size(), s.outlets.size(), s.measures.size());
        for (const InletState& i : s.inlets) all(i.attempts, i.bodies, i.mass);
        for (const OutletState& o : s.outlets) all(o.bodies, o.mass);
        for (const MeasureState& m : s.measures) {
            all(m.passed_mass, m.passed_count, m.passed_mass_at_row, m.passed_count_at_row, m.time_at_row,
                m.window_time);
            list(m.window_sum);
        }
        const RasterState& r = s.rasters;
        all(r.columns, r.volume, r.centre, r.top);
        list(r.depth), list(r.height), list(r.speed), list(r.arrival);
        static_assert(std::is_trivially_copyable_v<Ledger>);
        all(s.ledger);
        const RunTotals& t = s.totals;
        all(t.steps, t.substepped, t.steps_not_converged, t.sweeps, t.contact_updates, t.sweeps_max, t.residual_sum,
            t.residual_max, t.penetration_max, t.penetration_max_relative, t.penetration_mean_sum,
            t.penetration_mean_relative_sum, t.steps_with_contacts, t.momentum_error_max, t.wall_by_phase, t.wall_time);
    }
    bool operator==(const StateBytes&) const = default;

  private:
    template <class... T>
    void all(const T&... values) {
        (bytes_.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
    }
    template <class T>
    void list(const std::vector<T>& values) {
        all(values.size());
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    std::string bytes_;
};

}  // namespace scree::io::testing
