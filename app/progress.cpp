#include "app/progress.hpp"

#include <fmt/format.h>

#include "app/human_text.hpp"

namespace scree::app {
namespace {

constexpr double kSampleInterval = 0.25;  // [s]
constexpr double kMemory = 30.0;          // [s] that the speed is taken over

std::string share_done(const ProgressFigures& f) {
    return fmt::format("{:.1f} %", f.end > 0.0 ? 100.0 * std::min(1.0, f.time / f.end) : 100.0);
}

std::string time_left(const ProgressFigures& f) {
    return duration_text(f.speed * std::max(0.0, f.end - f.time));
}

}  // namespace

std::string live_text(const ProgressFigures& f, int width) {
    std::vector<std::string> fields = {share_done(f), fmt::format("t {:.4g} s", f.time)};
    if (f.speed > 0.0) {
        fields.push_back(time_left(f) + " left");
        fields.push_back(fmt::format("{:.3g} s/s", f.speed));
    }
    fields.push_back(plural(f.report.contacts, "contact", "contacts"));
    fields.push_back(fmt::format("residual {:.1e}", f.report.residual_rms));
    fields.push_back(plural(static_cast<std::uint64_t>(f.report.sweeps), "sweep", "sweeps"));
    fields.push_back(fmt::format("overlap {:.1e} d", f.report.penetration.max_relative));
    fields.push_back(plural(f.report.bodies, "body", "bodies"));
    fields.push_back("step " + count_text(f.step));
    std::string line;
    for (const std::string& field : fields) {
        const std::size_t wanted = line.size() + field.size() + (line.empty() ? 0 : 3);
        if (wanted >= static_cast<std::size_t>(width)) break;
        if (!line.empty()) line += " | ";
        line += field;
    }
    return line;
}

std::string plain_text(const ProgressFigures& f) {
    std::string line = fmt::format(
        "{}, t = {:.6g} of {:.6g} s, step {} of {}, {} bodies, {} contacts, {} sweeps, residual {:.1e}, overlap {:.1e} "
        "d",
        share_done(f), f.time, f.end, f.step, f.steps, f.report.bodies, f.report.contacts, f.report.sweeps,
        f.report.residual_rms, f.report.penetration.max_relative);
    if (f.speed > 0.0) line += fmt::format(", {:.3g} s a simulated second, {} left", f.speed, time_left(f));
    return line;
}

void SpeedMeter::add(double wall, double simulated) {
    samples_.push_back({wall, simulated});
    while (samples_.size() > 2 && wall - samples_[1].wall > kMemory) samples_.pop_front();
}

double SpeedMeter::speed() const {
    if (samples_.size() < 2) return 0.0;
    const double simulated = samples_.back().simulated - samples_.front().simulated;
    return simulated > 0.0 ? (samples_.back().wall - samples_.front().wall) / simulated : 0.0;
}

Progress::Progress(Console& console, double report_interval)
    : console_(console), report_interval_(report_interval), start_(std::chrono::steady_clock::now()) {}

double Progress::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

Progress::Due Progress::due() {
    const double wall = now();
    if (wall - last_sample_ < kSampleInterval && last_sample_ > 0.0) return Due::nothing;
    last_sample_ = wall;
    if (report_interval_ <= 0.0 || wall - last_report_ < report_interval_) return Due::line;
    last_report_ = wall;
    return Due::report;
}

void Progress::show(Due due, ProgressFigures figures) {
    if (due == Due::nothing) return;
    meter_.add(now(), figures.time);
    figures.speed = meter_.speed();
    console_.live(live_text(figures, console_.width()));
    if (due == Due::report && !console_.terminal()) console_.info(plain_text(figures));
}

}  // namespace scree::app
