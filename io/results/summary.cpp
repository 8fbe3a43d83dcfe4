#include "io/results/summary.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "core/exact_sum.hpp"
#include "core/parallel/together.hpp"
#include "core/state_hash.hpp"
#include "io/atomic_file.hpp"

namespace scree::io {

namespace {

std::string number(double value) {
    if (std::isnan(value)) return ".nan";
    if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
    // YAML 1.1 takes 1e-05 for a text: a number has a point
    std::string text = fmt::format("{:.9g}", value);
    const std::size_t exponent = text.find('e');
    if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
    return text;
}

double mean(double sum, std::uint64_t count) {
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

// Block maps with a comment a line; text always in quotes, so that no word or hash is taken for a number.
class Writer {
  public:
    void open(const std::string& key) { out_ << YAML::Key << key << YAML::Value << YAML::BeginMap; }
    void open() { out_ << YAML::BeginMap; }
    void close() { out_ << YAML::EndMap; }
    void real(const std::string& key, double value, const std::string& comment = "") {
        out_ << YAML::Key << key << YAML::Value << number(value);
        note(comment);
    }
    void integer(const std::string& key, std::uint64_t value, const std::string& comment = "") {
        out_ << YAML::Key << key << YAML::Value << std::to_string(value);
        note(comment);
    }
    void word(const std::string& key, const std::string& value) { out_ << YAML::Key << key << YAML::Value << value; }
    void text(const std::string& key, const std::string& value, const std::string& comment = "") {
        out_ << YAML::Key << key << YAML::Value << YAML::DoubleQuoted << value;
        note(comment);
    }
    void reals(const std::string& key, const std::vector<double>& values) {
        out_ << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
        for (double value : values) out_ << number(value);
        out_ << YAML::EndSeq;
    }
    void texts(const std::string& key, const std::vector<std::string>& values) {
        out_ << YAML::Key << key << YAML::Value;
        if (values.empty()) out_ << YAML::Flow;
        out_ << YAML::BeginSeq;
        for (const std::string& value : values) out_ << YAML::DoubleQuoted << value;
        out_ << YAML::EndSeq;
    }
    std::string str() const { return std::string(out_.c_str()) + "\n"; }

  private:
    void note(const std::string& comment) {
        if (!comment.empty()) out_ << YAML::Comment(comment);
    }
    YAML::Emitter out_;
};

void write_work(Writer& w, const Summary& s) {
    const RunTotals& t = s.totals;
    w.integer("substeps", t.steps, "all steps, each part of a cut step counted");
    w.integer("steps_cut", t.substepped, "steps that were cut because bodies were too fast");
    w.open("sweeps");
    w.integer("total", t.sweeps);
    w.real("mean", mean(static_cast<double>(t.sweeps), t.steps), "a step");
    w.integer("max", static_cast<std::uint64_t>(t.sweeps_max), "in one step");
    w.integer("contact_updates", t.contact_updates);
    w.close();
    w.open("residual");
    w.real("mean", mean(t.residual_sum, t.steps), "scaled natural map, rms over contacts, mean over steps");
    w.real("max", t.residual_max);
    w.integer("steps_not_converged", t.steps_not_converged);
    w.close();
    w.open("penetration");
    w.real("max", t.penetration_max, "m");
    w.real("mean", mean(t.penetration_mean_sum, t.steps_with_contacts), "m, mean over contacts and steps");
    w.real("max_relative_to_diameter", t.penetration_max_relative);
    w.real("mean_relative_to_diameter", mean(t.penetration_mean_relative_sum, t.steps_with_contacts));
    w.close();
}

void write_energy(Writer& w, const Summary& s) {
    const Ledger& l = s.ledger;
    w.open("energy");
    w.real("drift", l.drift(), "what the ledger cannot account for, over the range of energies met");
    w.real("imbalance", l.imbalance(), "J, the same as it is");
    w.real("kinetic", l.kinetic, "J, at the end");
    w.real("potential", l.potential, "J, at the end, zero at the scene's origin");
    w.real("kinetic_at_start", l.kinetic_0, "J");
    w.real("potential_at_start", l.potential_0, "J");
    w.open("by_law");
    for (std::size_t i = 0; i < kWorkCount; ++i) w.real(std::string(kWorkNames[i]), l.work[i], "J, since the start");
    w.close();
    w.real("gained", l.gained, "J, added by single contacts");
    w.close();
    w.real("momentum_error", s.totals.momentum_error_max, "largest of a step, relative");
}

void write_mass(Writer& w, const Summary& s) {
    const auto amounts = [&](const char* key, const std::vector<NamedAmount>& list) {
        w.open(key);
        for (const NamedAmount& amount : list) {
            w.open(amount.name);
            w.integer("bodies", amount.bodies);
            w.real("mass", amount.mass, "kg");
            w.close();
        }
        w.close();
    };
    double came = 0.0, went = 0.0;
    for (const NamedAmount& inlet : s.inlets) came += inlet.mass;
    for (const NamedAmount& outlet : s.outlets) went += outlet.mass;
    w.open("mass");
    w.real("start", s.mass - came + went, "kg, from what is there now, came and went");
    w.real("now", s.mass, "kg");
    amounts("inlets", s.inlets);
    amounts("outlets", s.outlets);
    w.close();
}

void write_plan(Writer& w, const Summary& s) {
    w.open("plan");
    for (const bool on : {true, false}) {
        w.open(on ? "on" : "left_out");
        for (const PlanLine& line : s.plan) {
            if (line.on == on) w.text(line.feature, line.reason);
        }
        w.close();
    }
    w.integer("bytes_per_body", s.bytes_per_body);
    w.integer("bytes_per_contact", s.bytes_per_contact);
    w.close();
}

void write_measures(Writer& w, const Summary& s) {
    w.open("measures");
    for (const SummaryMean& m : s.measures) {
        w.open(m.column);
        if (m.value.size() == 1) {
            w.real("mean", m.value[0]);
        } else {
            w.reals("mean", m.value);
        }
        w.text("unit", m.unit);
        w.reals("window", {m.from, m.until});
        w.real("covered", m.covered, "s of the window");
        w.close();
    }
    w.close();
}

void write_runout(Writer& w, const Runout& r) {
    const auto place = [](const Vec3& x) { return std::vector<double>{x.x(), x.y(), x.z()}; };
    w.open("runout");
    w.real("fall_height", r.fall_height, "m, H: from the highest point released to the toe");
    w.real("length", r.length, "m, L: horizontal, straight from the one to the other");
    w.real("height_over_length", r.length > 0.0 ? r.fall_height / r.length : std::nan(""), "H/L");
    w.reals("top", place(r.top));
    w.reals("toe", place(r.toe));
    w.open("centre_of_mass");
    w.reals("start", place(r.centre_before));
    w.reals("end", place(r.centre_after));
    w.real("fall_height", r.centre_fall, "m");
    w.real("length", r.centre_length, "m, horizontal");
    w.real("height_over_length", r.centre_length > 0.0 ? r.centre_fall / r.centre_length : std::nan(""));
    w.close();
    w.real("released_volume", r.released_volume, "m3, of the bodies at the start, without pores");
    w.real("volume_beyond", r.beyond, "m3, of the bodies that are not over the grid; no figure counts them");
    w.open("deposit");
    w.real("area", r.deposit_area, "m2, cells deeper than rasters.covered");
    w.real("volume", r.deposit_volume, "m3, their flow depth times their area");
    w.real("depth_max", r.deposit_most, "m");
    w.close();
    w.real("flowed_area", r.flowed_area, "m2, cells that were covered at any time");
    w.close();
}

void write_provenance_map(Writer& w, const Provenance& p) {
    w.open("provenance");
    for (const auto& [name, value] : provenance_lines(p)) {
        if (name == "git_dirty" || name == "ranks" || name == "seed") {
            w.word(name, value);
        } else if (name != "restart_of") {
            w.text(name, value);
        }
    }
    w.texts("restart_of", p.restart_of);
    w.close();
}

void write_error_vs_time(Writer& w, const Summary& s) {
    const RunTotals& t = s.totals;
    w.open("error_vs_time");
    w.real("wall_s_per_simulated_s", s.simulated_time > 0.0 ? t.wall_time / s.simulated_time : 0.0);
    w.real("residual_mean", mean(t.residual_sum, t.steps));
    w.real("penetration_mean", mean(t.penetration_mean_relative_sum, t.steps_with_contacts), "over the diameter");
    w.real("energy_drift", s.ledger.drift());
    w.close();
}

}  // namespace

Summary summarise(const Scene& scene, const Plan& plan, const State& state, const Communicator& ranks) {
    Summary s;
    s.title = scene.title;
    s.state_hash = state_hash(state.bodies, ranks);
    s.steps = state.step;
    s.simulated_time = state.time;
    s.bodies = ranks.sum(state.bodies.owned());
    ExactSum mass;
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        if (!state.bodies.is_ghost(i)) mass.add(state.bodies.mass[i]);
    }
    s.mass = ranks.sum(mass);
    for (std::size_t i = 0; i < scene.inlets.size() && i < state.inlets.size(); ++i) {
        s.inlets.push_back({scene.inlets[i].name, state.inlets[i].bodies, state.inlets[i].mass});
    }
    for (std::size_t i = 0; i < scene.outlets.size() && i < state.outlets.size(); ++i) {
        s.outlets.push_back({scene.outlets[i].name, state.outlets[i].bodies, state.outlets[i].mass});
    }
    s.totals = state.totals;
    s.ledger = state.ledger;
    s.plan = plan.lines;
    s.bytes_per_body = plan.bytes_per_body;
    s.bytes_per_contact = plan.bytes_per_contact;
    return s;
}

std::string to_yaml(const Summary& s) {
    Writer w;
    w.open();
    w.text("title", s.title);
    w.word("status", s.status);
    w.text("reason", s.reason);
    w.text("state_hash", fmt::format("{:016x}", s.state_hash), "over ids, positions, velocities, ... at the end");
    w.integer("steps", s.steps);
    w.real("simulated_time", s.simulated_time, "s");
    w.real("wall_time", s.totals.wall_time, "s");
    w.open("time_by_phase");
    for (std::size_t i = 0; i < kPhaseCount; ++i) w.real(std::string(kPhaseNames[i]), s.totals.wall_by_phase[i], "s");
    w.close();
    w.integer("bodies", s.bodies, "at the end");
    w.integer("contacts", s.contacts, "in the last step");
    w.integer("active_contacts", s.active_contacts, "of them with an impulse");
    write_work(w, s);
    write_energy(w, s);
    write_mass(w, s);
    write_measures(w, s);
    if (s.runout) write_runout(w, *s.runout);
    write_error_vs_time(w, s);
    write_plan(w, s);
    w.open("output");
    w.integer("files", s.output_files);
    w.integer("bytes", s.output_bytes);
    w.close();
    w.texts("warnings", s.warnings);
    write_provenance_map(w, s.provenance);
    w.close();
    return w.str();
}

void write_summary(const std::string& path, const Summary& summary, const Communicator& ranks) {
    by_root(ranks, [&] { write_text_atomically(path, to_yaml(summary)); });
}

}  // namespace scree::io
