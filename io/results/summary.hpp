// summary.yaml: what happened in a run, readable by a person and by a YAML parser. Every number has its unit in a
// comment or a `unit` entry.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/runout.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/results/provenance.hpp"

namespace scree::io {

// Mean of one column of a measure over the measure's window.
struct SummaryMean {
    std::string column, unit;        // "outflow.mass_rate", "kg/s"
    std::vector<double> value;       // one a number of the column (profiles have several)
    double from = 0.0, until = 0.0;  // [s] window asked for
    double covered = 0.0;            // [s] of it that the run covered
};

struct NamedAmount {
    std::string name;
    std::uint64_t bodies = 0;
    double mass = 0.0;  // [kg]
};

struct Summary {
    // Filled by summarise():
    std::string title;
    std::uint64_t state_hash = 0;
    std::uint64_t steps = 0;      // scenario steps
    double simulated_time = 0.0;  // [s]
    std::size_t bodies = 0;       // at the end
    double mass = 0.0;            // [kg] at the end
    std::vector<NamedAmount> inlets, outlets;
    RunTotals totals;
    Ledger ledger;
    std::vector<PlanLine> plan;
    std::size_t bytes_per_body = 0, bytes_per_contact = 0;
    // Filled by the caller:
    std::string status;               // complete, stopped_early, failed
    std::string reason;               // in words; may be empty
    std::size_t contacts = 0;         // of the last step
    std::size_t active_contacts = 0;  // of them with an impulse
    std::vector<SummaryMean> measures;
    std::optional<Runout> runout;
    std::uint64_t output_files = 0, output_bytes = 0;
    std::vector<std::string> warnings;  // sentences
    Provenance provenance;
};

// Collective: of the bodies of all ranks.
Summary summarise(const Scene& scene, const Plan& plan, const State& state,
                  const Communicator& ranks = Communicator::self());
std::string to_yaml(const Summary& summary);
// Atomically, by rank 0; collective.
void write_summary(const std::string& path, const Summary& summary, const Communicator& ranks = Communicator::self());

}  // namespace scree::io
