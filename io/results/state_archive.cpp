#include "io/results/state_archive.hpp"

#include <array>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "core/errors.hpp"
#include "core/flat_shapes.hpp"
#include "core/parallel/sorted_slices.hpp"
#include "io/checksum.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/hdf5/shared_file.hpp"
#include "io/results/flat_shape_fields.hpp"

namespace scree::io {

namespace {

// How one thing of type E becomes `width` numbers of type Number.
template <class E>
struct Packing {  // numbers, and the enums that are ids
    static auto plain() {
        if constexpr (std::is_enum_v<E>) {
            return std::underlying_type_t<E>{};
        } else {
            return E{};
        }
    }
    using Number = decltype(plain());
    static constexpr std::size_t width = 1;
    static void pack(const E& from, Number* to) { *to = static_cast<Number>(from); }
    static void unpack(const Number* from, E& to) { to = static_cast<E>(*from); }
};
template <>
struct Packing<Vec3> {
    using Number = double;
    static constexpr std::size_t width = 3;
    static void pack(const Vec3& from, double* to) { std::memcpy(to, from.data(), sizeof(Vec3)); }
    static void unpack(const double* from, Vec3& to) { std::memcpy(to.data(), from, sizeof(Vec3)); }
};
template <>
struct Packing<Quat> {
    using Number = double;
    static constexpr std::size_t width = 4;
    static void pack(const Quat& from, double* to) {
        to[0] = from.w(), to[1] = from.x(), to[2] = from.y(), to[3] = from.z();
    }
    static void unpack(const double* from, Quat& to) { to = Quat(from[0], from[1], from[2], from[3]); }
};
template <std::size_t N>
struct Packing<std::array<double, N>> {
    using Number = double;
    static constexpr std::size_t width = N;
    static void pack(const std::array<double, N>& from, double* to) { std::memcpy(to, from.data(), sizeof(from)); }
    static void unpack(const double* from, std::array<double, N>& to) { std::memcpy(to.data(), from, sizeof(to)); }
};

// Rows begin <= row < end of a dataset.
struct Range {
    std::uint64_t begin = 0, end = 0;
};

template <class Things, class Member>
auto packed_column(const Things& things, const Member& member) {
    using Pack = Packing<std::remove_cvref_t<decltype(member(things[0]))>>;
    std::vector<typename Pack::Number> packed(things.size() * Pack::width);
    std::size_t at = 0;
    for (const auto& thing : things) Pack::pack(member(thing), packed.data() + Pack::width * at++);
    return packed;
}

struct Writer {
    static constexpr bool kReading = false;
    SharedFile& file;
    RowsChecksum checksum;

    // One number (or small array) a thing: `member` picks it. The things are equal on all ranks.
    template <class Things, class Member>
    void column(const std::string& name, const Things& things, const Member& member, const Meaning& meaning) {
        if (!file.ranks().root()) return;
        const auto packed = packed_column(things, member);
        const Rows rows = view(packed, things.size(), Packing<std::remove_cvref_t<decltype(member(things[0]))>>::width);
        file.by_root([&](const Hdf5Group& root) { write_rows(root, name, rows, meaning); });
        add(name, rows, {0, rows.count});
    }
    // Each rank has its own things.
    template <class Things, class Member>
    void slice(const std::string& name, const Things& things, const Member& member, const Meaning& meaning) {
        const auto packed = packed_column(things, member);
        const Rows rows = view(packed, things.size(), Packing<std::remove_cvref_t<decltype(member(things[0]))>>::width);
        add(name, rows, file.rows(name, rows, meaning));
    }
    void bodies_here() {}
    void contacts_here() {}
    void cells_here(std::uint64_t) {}

  private:
    template <class Number>
    static Rows view(const std::vector<Number>& packed, std::size_t count, std::size_t width) {
        Rows rows = rows_of(std::span<const Number>(packed));
        rows.count = count;
        if (width > 1) rows.shape = {width};
        return rows;
    }
    void add(const std::string& name, const Rows& rows, const SharedFile::Extent& extent) {
        checksum.add(name, extent.begin, rows.data, rows.count, rows.row_bytes());
        if (file.ranks().root()) checksum.add_total(name, extent.total);
    }
};

class Reader {
  public:
    static constexpr bool kReading = true;
    Reader(const Hdf5Group& group, const Communicator& ranks) : root(group), ranks_(ranks) {}
    const Hdf5Group& root;
    RowsChecksum checksum;

    template <class Things, class Member>
    void column(const std::string& name, Things& things, const Member& member, const Meaning&) {
        using Pack = Packing<std::remove_cvref_t<decltype(member(things[0]))>>;
        const std::uint64_t total = rows_in<Pack>(name);
        read<Pack>(name, things, member, {0, total}, total, ranks_.root());
    }
    template <class Things, class Member>
    void slice(const std::string& name, Things& things, const Member& member, const Meaning&) {
        using Pack = Packing<std::remove_cvref_t<decltype(member(things[0]))>>;
        const std::uint64_t total = rows_in<Pack>(name);
        if (total != 0 && total != total_) throw_length(name);
        read<Pack>(name, things, member, total == 0 ? Range{} : range_, total, true);
    }
    // From here on, slice() reads the rows of this rank's bodies.
    void bodies_here() {
        total_ = rows_in<Packing<BodyId>>("bodies/id");
        const Division division{total_, 1, ranks_.size()};
        range_ = {division.first(ranks_.rank()), division.first(ranks_.rank() + 1)};
    }
    // From here on, it reads those of the contacts whose body a this rank has.
    void contacts_here() {
        const std::uint64_t bodies = total_;
        total_ = rows_in<Packing<std::uint64_t>>("warm_start/a");
        if (ranks_.alone()) {
            range_ = {0, total_};
        } else {
            range_ = {contacts_before(range_.begin, bodies), contacts_before(range_.end, bodies)};
        }
    }

    // From here on, it reads those of this rank's cells of a raster (core/raster.hpp).
    void cells_here(std::uint64_t columns) {
        total_ = rows_in<Packing<double>>("rasters/depth");
        if (columns == 0 || total_ % columns != 0) throw_length("rasters/depth");
        const Division rows{total_ / columns, 1, ranks_.size()};
        range_ = {rows.first(ranks_.rank()) * columns, rows.first(ranks_.rank() + 1) * columns};
    }

  private:
    template <class Pack>
    std::uint64_t rows_in(const std::string& name) const {
        const std::vector<std::size_t> shape = root.dataset(name).shape;
        const bool fits = Pack::width == 1 ? shape.size() == 1 : shape.size() == 2 && shape[1] == Pack::width;
        if (!fits) throw IoError(root.file() + ": dataset '" + name + "' has another shape than expected");
        return shape[0];
    }
    [[noreturn]] void throw_length(const std::string& name) const {
        throw IoError(root.file() + ": dataset '" + name + "' has another length");
    }

    template <class Pack, class Things, class Member>
    void read(const std::string& name, Things& things, const Member& member, const Range& range, std::uint64_t total,
              bool summed) {
        const std::size_t count = range.end - range.begin;
        if constexpr (requires { things.resize(count); }) {
            if (things.empty()) things.resize(count);  // else an earlier column of the same things gave the size
        }
        if (things.size() != count) throw_length(name);
        using Number = typename Pack::Number;
        std::vector<Number> packed(count * Pack::width);
        read_some_rows(root, name, rows_of(std::span<const Number>(packed)).type, range.begin, count, packed.data());
        if (summed) checksum.add(name, range.begin, packed.data(), count, Pack::width * sizeof(Number));
        if (ranks_.root()) checksum.add_total(name, total);
        std::size_t at = 0;
        for (auto& thing : things) Pack::unpack(packed.data() + Pack::width * at++, member(thing));
    }

    std::uint64_t number_at(const char* name, std::uint64_t row) const {
        std::uint64_t number = 0;
        read_some_rows(root, name, ElementType::u64, row, 1, &number);
        return number;
    }
    // The first contact that belongs to body number `row` or one after it: contacts are in order of body a.
    std::uint64_t contacts_before(std::uint64_t row, std::uint64_t bodies) const {
        if (row == 0) return 0;
        if (row >= bodies) return total_;
        const std::uint64_t id = number_at("bodies/id", row);
        std::uint64_t low = 0, high = total_;
        while (low < high) {
            const std::uint64_t middle = low + (high - low) / 2;
            if (number_at("warm_start/a", middle) < id) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }

    Communicator ranks_;
    Range range_;
    std::uint64_t total_ = 0;
};

template <class Archive, class Vector>
void whole(Archive& archive, const std::string& name, Vector& values, const Meaning& meaning) {
    archive.column(
        name, values, [](auto& value) -> auto& { return value; }, meaning);
}
template <class Archive, class T>
void single(Archive& archive, const std::string& name, T& value, const Meaning& meaning) {
    std::span<T, 1> one(&value, 1);
    whole(archive, name, one, meaning);
}

template <class Archive, class Vector>
void each(Archive& archive, const std::string& name, Vector& values, const Meaning& meaning) {
    archive.slice(
        name, values, [](auto& value) -> auto& { return value; }, meaning);
}

template <class Archive, class B>
void visit_bodies(Archive& a, B& b) {
    a.bodies_here();
    each(a, "bodies/id", b.id, {"1", "stable number of the body", ""});
    each(a, "bodies/radius", b.radius, {"m", "radius"});
    each(a, "bodies/mass", b.mass, {"kg", "mass"});
    each(a, "bodies/material", b.material, {"1", "index of the material"});
    each(a, "bodies/position", b.position, {"m", "centre, relative to the scene's origin", "scene"});
    each(a, "bodies/velocity", b.velocity, {"m/s", "velocity", "world"});
    each(a, "bodies/spin", b.spin, {"rad/s", "angular velocity; empty without friction", "world"});
    each(a, "bodies/orientation", b.orientation, {"1", "quaternion w, x, y, z; empty if nothing needs it", "world"});
    each(a, "bodies/shape", b.shape, {"1", "index of the shape, 2^32 - 1 for a sphere; empty if all are spheres"});
    each(a, "bodies/inertia", b.inertia, {"kg m2", "principal moments; empty if all are spheres", "body"});
}

// Shapes are the same on all ranks.
template <class Archive, class S>
void visit_shapes(Archive& a, S& shapes) {
    std::uint64_t count = shapes.size();
    single(a, "shapes/count", count, {"1", "shapes of bodies that are not spheres"});
    if (count == 0) return;
    FlatShapes flat;
    if constexpr (!Archive::kReading) flat = flatten(shapes);
    visit_fields(flat, [&](const char* name, auto& values, const Meaning& meaning) {
        whole(a, std::string("shapes/") + name, values, meaning);
    });
    if constexpr (Archive::kReading) shapes = unflatten(flat);
}

template <class Archive, class W>
void visit_warm_start(Archive& a, W& w) {
    a.contacts_here();
    a.slice("warm_start/a", w.key, [](auto& k) -> auto& { return k.a; }, {"1", "body id"});
    a.slice("warm_start/b", w.key, [](auto& k) -> auto& { return k.b; },
            {"1", "body id, or 2^63 + 2^32 wall index + part of it"});
    a.slice("warm_start/feature", w.key, [](auto& k) -> auto& { return k.feature; },
            {"1", "what meets: surface of a wall, features of polyhedra"});
    each(a, "warm_start/impulse_vector", w.impulse_vector, {"N s", "impulse on a; with friction", "world"});
    each(a, "warm_start/impulse_normal", w.impulse_normal, {"N s", "normal impulse; without friction"});
    single(a, "warm_start/step", w.step, {"s", "length of the step that the impulses belong to"});
}

template <class Archive, class S>
void visit_doors(Archive& a, S& s) {
    a.column("inlets/attempts", s.inlets, [](auto& i) -> auto& { return i.attempts; }, {"1", "draws so far"});
    a.column("inlets/bodies", s.inlets, [](auto& i) -> auto& { return i.bodies; }, {"1", "bodies made so far"});
    a.column("inlets/mass", s.inlets, [](auto& i) -> auto& { return i.mass; }, {"kg", "mass made so far"});
    a.column("outlets/bodies", s.outlets, [](auto& o) -> auto& { return o.bodies; }, {"1", "bodies taken so far"});
    a.column("outlets/mass", s.outlets, [](auto& o) -> auto& { return o.mass; }, {"kg", "mass taken so far"});
}

template <class Archive, class S>
void visit_measures(Archive& a, S& s) {
    const auto column = [&](const char* name, auto MeasureState::*member, const Meaning& meaning) {
        a.column(
            std::string("measures/") + name, s.measures, [member](auto& m) -> auto& { return m.*member; }, meaning);
    };
    column("passed_mass", &MeasureState::passed_mass, {"kg", "passed the surface since the start"});
    column("passed_count", &MeasureState::passed_count, {"1", "bodies that passed since the start"});
    column("passed_mass_at_row", &MeasureState::passed_mass_at_row, {"kg", "at the last history row"});
    column("passed_count_at_row", &MeasureState::passed_count_at_row, {"1", "at the last history row"});
    column("time_at_row", &MeasureState::time_at_row, {"s", "time of the last history row"});
    column("window_time", &MeasureState::window_time, {"s", "time inside the window so far"});
    // The sums have one length a measure: all numbers one after another, and the lengths.
    std::vector<std::uint64_t> length;
    std::vector<double> sum;
    if constexpr (!Archive::kReading) {
        for (const MeasureState& m : s.measures) {
            length.push_back(m.window_sum.size());
            sum.insert(sum.end(), m.window_sum.begin(), m.window_sum.end());
        }
    }
    whole(a, "measures/window_length", length, {"1", "numbers of each measure in window_sum"});
    whole(a, "measures/window_sum", sum, {"", "time-weighted sums over the window, measure after measure"});
    if constexpr (Archive::kReading) {
        std::size_t total = 0;
        for (std::uint64_t n : length) total += n;
        if (length.size() != s.measures.size() || total != sum.size()) {
            throw IoError(a.root.file() + ": dataset 'measures/window_sum' has another length");
        }
        auto next = sum.begin();
        for (std::size_t i = 0; i < length.size(); ++i) {
            const auto end = next + static_cast<std::ptrdiff_t>(length[i]);
            s.measures[i].window_sum.assign(next, end);
            next = end;
        }
    }
}

template <class Archive, class R>
void visit_rasters(Archive& a, R& r) {
    single(a, "rasters/columns", r.columns, {"1", "cells in a row; 0: the scene has no rasters"});
    if (r.columns == 0) return;
    a.cells_here(r.columns);
    each(a, "rasters/depth", r.depth, {"m", "largest flow depth of each cell so far, row after row"});
    each(a, "rasters/height", r.height, {"m", "largest height above the ground so far"});
    each(a, "rasters/speed", r.speed, {"m/s", "largest speed so far"});
    each(a, "rasters/arrival", r.arrival, {"s", "first time that the cell was covered; infinite: not yet"});
    single(a, "rasters/volume", r.volume, {"m3", "of the bodies at the start"});
    single(a, "rasters/centre", r.centre, {"m", "centre of mass at the start", "scene"});
    single(a, "rasters/top", r.top, {"m", "highest point of a body at the start, over its centre", "scene"});
}

template <class Archive, class L>
void visit_ledger(Archive& a, L& l) {
    single(a, "ledger/kinetic_0", l.kinetic_0, {"J", "kinetic energy at the start"});
    single(a, "ledger/potential_0", l.potential_0, {"J", "potential energy at the start"});
    single(a, "ledger/kinetic", l.kinetic, {"J", "kinetic energy"});
    single(a, "ledger/potential", l.potential, {"J", "potential energy"});
    single(a, "ledger/work", l.work,
           {"J", "restitution, friction, walls, correction, gravity, inlets, outlets, rotation"});
    single(a, "ledger/kinetic_max", l.kinetic_max, {"J", "largest kinetic energy so far"});
    single(a, "ledger/potential_min", l.potential_min, {"J", "smallest potential energy so far"});
    single(a, "ledger/potential_max", l.potential_max, {"J", "largest potential energy so far"});
    single(a, "ledger/gained", l.gained, {"J", "energy that single contacts added"});
}

template <class Archive, class T>
void visit_totals(Archive& a, T& t) {
    single(a, "totals/steps", t.steps, {"1", "steps, each substep counted"});
    single(a, "totals/substepped", t.substepped, {"1", "scenario steps cut into substeps"});
    single(a, "totals/steps_not_converged", t.steps_not_converged, {"1", "steps that ended unconverged"});
    single(a, "totals/sweeps", t.sweeps, {"1", "sweeps"});
    single(a, "totals/contact_updates", t.contact_updates, {"1", "contacts times sweeps"});
    single(a, "totals/sweeps_max", t.sweeps_max, {"1", "most sweeps in a step"});
    single(a, "totals/residual_sum", t.residual_sum, {"1", "sum over steps of the scaled residual, rms"});
    single(a, "totals/residual_max", t.residual_max, {"1", "largest scaled residual"});
    single(a, "totals/penetration_max", t.penetration_max, {"m", "largest penetration"});
    single(a, "totals/penetration_max_relative", t.penetration_max_relative, {"1", "over the diameter"});
    single(a, "totals/penetration_mean_sum", t.penetration_mean_sum, {"m", "sum over steps of the mean"});
    single(a, "totals/penetration_mean_relative_sum", t.penetration_mean_relative_sum, {"1", "over the diameter"});
    single(a, "totals/steps_with_contacts", t.steps_with_contacts, {"1", "steps with contacts"});
    single(a, "totals/momentum_error_max", t.momentum_error_max, {"1", "largest relative momentum error"});
    single(a, "totals/wall_by_phase", t.wall_by_phase,
           {"s", "detection, setup, solve, integration, correction, measures, output"});
    single(a, "totals/wall_time", t.wall_time, {"s", "time of the wall clock"});
}

template <class Archive, class S, class B, class W>
void visit_state(Archive& a, S& s, B& bodies, W& warm_start) {
    single(a, "time", s.time, {"s", "simulated time"});
    single(a, "step", s.step, {"1", "scenario steps done"});
    single(a, "next_id", s.next_id, {"1", "next free body id"});
    single(a, "block_size", s.block_size, {"m", "edge of the blocks that order the work; 0: not chosen yet"});
    single(a, "snapshots_written", s.snapshots_written, {"1", "snapshots so far"});
    single(a, "history_rows", s.history_rows, {"1", "rows of the history so far"});
    single(a, "trajectory_rows", s.trajectory_rows, {"1", "rows of the trajectories so far"});
    whole(a, "followed", s.followed, {"1", "ids of the bodies whose trajectories are written"});
    visit_bodies(a, bodies);
    visit_warm_start(a, warm_start);
    visit_shapes(a, s.shapes);
    visit_doors(a, s);
    visit_measures(a, s);
    visit_rasters(a, s.rasters);
    visit_ledger(a, s.ledger);
    visit_totals(a, s.totals);
}

}  // namespace

std::uint64_t write_state(SharedFile& file, const State& state, const Bodies& bodies, const WarmStart& warm_start) {
    Writer writer{file, {}};
    visit_state(writer, state, bodies, warm_start);
    file.by_root([](const Hdf5Group& root) {
        for (const char* name : {"totals/wall_by_phase", "totals/wall_time"}) {
            mark_dataset(root, name, "wall_clock", "differs from run to run");
        }
    });
    return file.ranks().sum(writer.checksum.value());
}

std::uint64_t read_state(const Hdf5Group& root, State& state, const Communicator& ranks) {
    state = {};
    Reader reader(root, ranks);
    visit_state(reader, state, state.bodies, state.warm_start);
    return reader.checksum.value();
}

}  // namespace scree::io
