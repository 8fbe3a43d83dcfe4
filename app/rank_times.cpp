#include "app/rank_times.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "app/human_text.hpp"

namespace scree::app {
namespace {

constexpr std::array kSteps = {Phase::detection, Phase::setup, Phase::solve, Phase::integration, Phase::correction};

double mean(const std::vector<double>& values) {
    return values.empty() ? 0.0
                          : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double largest(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

template <class Get>
std::vector<double> of_each(const std::vector<RankFigures>& all, const Get& get) {
    std::vector<double> values;
    for (const RankFigures& one : all) values.push_back(static_cast<double>(get(one)));
    return values;
}

io::RankLoads::Range range_of(const std::vector<std::vector<double>>& rows, std::size_t column) {
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row[column]);
    if (values.empty()) return {};
    return {*std::min_element(values.begin(), values.end()), mean(values), largest(values)};
}

std::vector<double> packed(const RankFigures& own) {
    std::vector<double> row(own.phase.begin(), own.phase.end());
    const solvers::RankReport& r = own.report;
    for (const std::uint64_t count :
         {r.own, r.ghosts, r.contacts, r.neighbours, r.messages, r.bytes, r.repartitions, r.migrated}) {
        row.push_back(static_cast<double>(count));
    }
    row.push_back(r.wait_seconds);
    return row;
}

RankFigures unpacked(const std::vector<double>& row) {
    RankFigures one;
    std::copy_n(row.begin(), kPhaseCount, one.phase.begin());
    auto at = row.begin() + kPhaseCount;
    solvers::RankReport& r = one.report;
    for (std::uint64_t* count :
         {&r.own, &r.ghosts, &r.contacts, &r.neighbours, &r.messages, &r.bytes, &r.repartitions, &r.migrated}) {
        *count = static_cast<std::uint64_t>(*at++);
    }
    r.wait_seconds = *at;
    return one;
}

// Of the time in steps, what the ranks on average waited for messages.
double communication_share(const std::vector<RankFigures>& all) {
    const double steps = mean(of_each(all, [](const RankFigures& f) { return f.steps(); }));
    return steps > 0.0 ? mean(of_each(all, [](const RankFigures& f) { return f.report.wait_seconds; })) / steps : 0.0;
}

template <class Get>
std::string list_line(const std::vector<RankFigures>& all, std::string_view name, const char* number, const Get& get) {
    std::vector<std::string> texts;
    for (const double value : of_each(all, get)) texts.push_back(fmt::format(fmt::runtime(number), value));
    return fmt::format("    {}: [{}]\n", name, fmt::join(texts, ", "));
}

}  // namespace

double RankFigures::steps() const {
    double sum = 0.0;
    for (const Phase p : kSteps) sum += phase[static_cast<std::size_t>(p)];
    return sum;
}

std::vector<RankFigures> gather(const RankFigures& own, const Communicator& ranks) {
    std::vector<RankFigures> all;
    for (const auto& row : ranks.gather(packed(own))) all.push_back(unpacked(row));
    return all;
}

double imbalance(const std::vector<double>& values) {
    const double average = mean(values);
    return average > 0.0 ? largest(values) / average : 1.0;
}

RankTimes::RankTimes(const State& state, const Communicator& ranks)
    : ranks_(ranks), before_(state.totals.wall_by_phase) {}

RankFigures RankTimes::figures(const State& state, const solvers::RankReport& report) const {
    RankFigures own{state.totals.wall_by_phase, report};
    for (std::size_t p = 0; p < kPhaseCount; ++p) own.phase[p] -= before_[p];
    return own;
}

PhaseTimes RankTimes::mean(const State& state) const {
    PhaseTimes times = state.totals.wall_by_phase;
    if (ranks_.alone()) return times;
    std::array<ExactSum, kPhaseCount> sums;
    for (std::size_t p = 0; p < kPhaseCount; ++p) sums[p].add(times[p]);
    ranks_.sum(sums);
    for (std::size_t p = 0; p < kPhaseCount; ++p) times[p] = sums[p].value() / ranks_.size();
    return times;
}

io::RankLoads RankTimes::loads(const State& state, const solvers::RankReport& report) {
    const RankFigures own = figures(state, report);
    const std::array row = {
        own.work() - work_logged_,          report.wait_seconds - wait_logged_,   static_cast<double>(report.own),
        static_cast<double>(report.ghosts), static_cast<double>(report.contacts), static_cast<double>(report.messages),
        static_cast<double>(report.bytes)};
    work_logged_ = own.work();
    wait_logged_ = report.wait_seconds;
    const auto rows = ranks_.gather(row);
    io::RankLoads loads;
    loads.time = state.time;
    loads.step = state.step;
    loads.ranks = ranks_.size();
    loads.repartitions = report.repartitions;
    std::size_t column = 0;
    for (io::RankLoads::Range* range :
         {&loads.work, &loads.wait, &loads.bodies, &loads.ghosts, &loads.contacts, &loads.messages, &loads.bytes}) {
        *range = range_of(rows, column++);
    }
    return loads;
}

std::string ranks_section(const std::vector<RankFigures>& all) {
    const auto work = of_each(all, [](const RankFigures& f) { return f.work(); });
    const auto sum = [&](auto member) {
        return fmt::format("{:.0f}", mean(of_each(all, [member](const RankFigures& f) { return f.report.*member; })) *
                                         static_cast<double>(all.size()));
    };
    using R = solvers::RankReport;
    std::string text =
        fmt::format("ranks:  # of this part of the run, where it was resumed\n  number: {}\n", all.size());
    text +=
        fmt::format("  imbalance: {:.4f}  # largest work of a rank over the mean; work: time in steps, less waiting\n",
                    imbalance(work));
    text += fmt::format("  communication_share: {:.4f}  # of the time in steps: waiting for other ranks, mean\n",
                        communication_share(all));
    text += fmt::format("  repartitions: {}  # times that space was shared out anew\n",
                        all.empty() ? 0 : all.front().report.repartitions);
    text += fmt::format("  migrated: {}  # bodies that went to another rank\n", sum(&R::migrated));
    text += fmt::format("  messages: {}\n  bytes: {}\n", sum(&R::messages), sum(&R::bytes));
    text += "  time_by_phase:  # [s]\n";
    for (std::size_t p = 0; p < kPhaseCount; ++p) {
        const auto times = of_each(all, [p](const RankFigures& f) { return f.phase[p]; });
        text += fmt::format("    {}: {{mean: {:.4f}, max: {:.4f}}}\n", kPhaseNames[p], mean(times), largest(times));
    }
    text += "  each:  # a number a rank; times in s, bodies and contacts at the end\n";
    const auto count = [&](std::string_view name, auto member) {
        text += list_line(all, name, "{:.0f}", [member](const RankFigures& f) { return f.report.*member; });
    };
    count("bodies", &R::own);
    count("ghosts", &R::ghosts);
    count("contacts", &R::contacts);
    count("neighbours", &R::neighbours);
    count("messages", &R::messages);
    count("bytes", &R::bytes);
    text += list_line(all, "work", "{:.4f}", [](const RankFigures& f) { return f.work(); });
    text += list_line(all, "wait", "{:.4f}", [](const RankFigures& f) { return f.report.wait_seconds; });
    for (std::size_t p = 0; p < kPhaseCount; ++p)
        text += list_line(all, kPhaseNames[p], "{:.4f}", [p](const RankFigures& f) { return f.phase[p]; });
    return text;
}

std::string ranks_line(const std::vector<RankFigures>& all) {
    if (all.size() < 2) return "";
    const auto work = of_each(all, [](const RankFigures& f) { return f.work(); });
    return fmt::format(
        "  ranks       {}, imbalance {:.3f} (largest work over the mean), {} of the time in steps waiting\n",
        all.size(), imbalance(work), percent_text(communication_share(all)));
}

}  // namespace scree::app
