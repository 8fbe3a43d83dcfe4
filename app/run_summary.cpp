#include "app/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/human_text.hpp"

namespace scree::app {
namespace {

constexpr double kOverlapShown = 0.05;  // of the diameter
constexpr double kGainShown = 0.05;     // of what contacts took
constexpr double kDriftShown = 1e-8;

double share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

double mean(double sum, std::uint64_t n) {
    return n == 0 ? 0.0 : sum / static_cast<double>(n);
}

// Energy that single contacts added, over what contacts took in all.
double gained_share(const Ledger& ledger) {
    const double taken = -(ledger[Work::restitution] + ledger[Work::friction]) + ledger.gained;
    return ledger.gained > 0.0 && taken > 0.0 ? ledger.gained / taken : 0.0;
}

// Plain numbers have the unit "1" in files.
std::string unit_text(const std::string& unit) {
    return unit == "1" ? "" : " " + unit;
}

std::string measure_line(const io::SummaryMean& m) {
    std::string value;
    if (m.value.empty() || m.covered <= 0.0) {
        value = "no value: the run did not reach its time window";
    } else if (m.value.size() == 1) {
        value = fmt::format("{:.5g}{}", m.value.front(), unit_text(m.unit));
    } else {
        const auto [low, high] = std::minmax_element(m.value.begin(), m.value.end());
        value = fmt::format("{} values, {:.4g} to {:.4g}{}", m.value.size(), *low, *high, unit_text(m.unit));
    }
    std::string line = fmt::format("    {:<28} {}, mean over {:.4g} to {:.4g} s", m.column, value, m.from, m.until);
    if (m.covered > 0.0 && m.covered < 0.999 * (m.until - m.from)) line += fmt::format(" ({:.4g} s of it)", m.covered);
    return line + "\n";
}

std::string amounts(const char* label, const std::vector<io::NamedAmount>& all) {
    std::string text;
    for (const io::NamedAmount& a : all) {
        text += fmt::format("  {:<12}{}: {}, {:.5g} kg\n", label, a.name, plural(a.bodies, "body", "bodies"), a.mass);
    }
    return text;
}

std::string headline(const io::Summary& s) {
    std::string text = s.status == "complete"        ? "complete"
                       : s.status == "stopped_early" ? fmt::format("stopped early ({})", s.reason)
                                                     : fmt::format("failed: {}", s.reason);
    text +=
        fmt::format("\n  time        {:.6g} s simulated in {}", s.simulated_time, duration_text(s.totals.wall_time));
    if (s.simulated_time > 0.0) {
        text += fmt::format(" ({:.3g} s of wall time for one simulated second)", s.totals.wall_time / s.simulated_time);
    }
    return text + fmt::format(", {}\n", plural(s.steps, "step", "steps"));
}

}  // namespace

std::vector<std::string> run_warnings(const Scene& scene, const State& state) {
    const RunTotals& t = state.totals;
    std::vector<std::string> warnings;
    if (t.steps_not_converged > 0) {
        warnings.push_back(fmt::format(
            "{} ({}) ended at the limit of {} sweeps with the residual above the tolerance of {:g}: solver.max_sweeps "
            "is too small, or time.step too large",
            plural(t.steps_not_converged, "step", "steps"), percent_text(share(t.steps_not_converged, t.steps)),
            scene.solver.max_sweeps, scene.solver.tolerance));
    }
    if (t.substepped > 0) {
        warnings.push_back(fmt::format(
            "{} ({}) had to be cut into substeps, because a body would have moved more than {:g} of its radius",
            plural(t.substepped, "step", "steps"), percent_text(share(t.substepped, state.step)),
            scene.time.max_travel));
    }
    if (t.penetration_max_relative > kOverlapShown) {
        warnings.push_back(fmt::format("the largest overlap was {} of the diameter ({})",
                                       percent_text(t.penetration_max_relative), length_text(t.penetration_max)));
    }
    const double gained = gained_share(state.ledger);
    if (gained > kGainShown) {
        warnings.push_back(
            fmt::format("single contacts added {:.3g} J of energy in all, {} of what contacts took: contacts that are "
                        "not solved well "
                        "enough (solver.tolerance, time.step), or restitution together with friction",
                        state.ledger.gained, percent_text(gained)));
    }
    if (state.ledger.drift() > kDriftShown) {
        warnings.push_back(
            fmt::format("the energy ledger is open by {:.1e} of the range of energies", state.ledger.drift()));
    }
    return warnings;
}

io::Summary make_summary(const Scene& scene, const Plan& plan, const State& state, const RunOutput& output,
                         const StepReport& last, const std::string& status, const std::string& reason,
                         std::vector<std::string> warnings, const Communicator& ranks) {
    io::Summary summary = io::summarise(scene, plan, state, ranks);
    summary.status = status;
    summary.reason = reason;
    summary.contacts = last.contacts;
    summary.active_contacts = last.active;
    for (const solvers::Measures::Mean& m : solvers::Measures::means(scene, state)) {
        summary.measures.push_back({m.column, m.unit, m.value, m.from, m.until, m.covered});
    }
    const RunOutput::Files files = output.snapshot_files();
    summary.output_files = files.count;
    summary.output_bytes = files.bytes;
    summary.warnings = std::move(warnings);
    summary.provenance = output.provenance();
    return summary;
}

std::string summary_text(const io::Summary& s, const Scene& scene, const RunFolder& folder,
                         const std::vector<RankFigures>& all) {
    const RunTotals& t = s.totals;
    std::string text = headline(s);
    text +=
        fmt::format("  bodies      {}, {:.5g} kg, {} ({} of them carry a force)\n", plural(s.bodies, "body", "bodies"),
                    s.mass, plural(s.contacts, "contact", "contacts"), count_text(s.active_contacts));
    text += amounts("inlet", s.inlets) + amounts("outlet", s.outlets);
    text += fmt::format("  residual    mean {:.1e}, largest {:.1e} (tolerance {:g}); {:.1f} sweeps a step\n",
                        mean(t.residual_sum, t.steps), t.residual_max, scene.solver.tolerance,
                        mean(static_cast<double>(t.sweeps), t.steps));
    text +=
        fmt::format("  not solved  {} of {} steps ended above the tolerance ({})\n", count_text(t.steps_not_converged),
                    count_text(t.steps), percent_text(share(t.steps_not_converged, t.steps)));
    text += fmt::format("  overlap     mean {}, largest {} of the diameter\n",
                        percent_text(mean(t.penetration_mean_relative_sum, t.steps_with_contacts)),
                        percent_text(t.penetration_max_relative));
    text +=
        fmt::format("  balances    energy {:.1e} of its range, momentum {:.1e}; energy added by contacts {:.2g} J\n",
                    s.ledger.drift(), t.momentum_error_max, s.ledger.gained);
    if (!s.measures.empty()) text += "  measures\n";
    for (const io::SummaryMean& m : s.measures) text += measure_line(m);
    text += ranks_line(all);
    for (const std::string& warning : s.warnings) text += "  warning     " + warning + "\n";
    text += fmt::format("  state       {:016x}\n", s.state_hash);
    text += fmt::format("  results     {}: summary.yaml, history.h5, run.xdmf (for ParaView) with {}, {}\n",
                        folder.path().string(), plural(s.output_files, "snapshot", "snapshots"),
                        bytes_text(static_cast<double>(s.output_bytes)));
    return text;
}

}  // namespace scree::app
