// How far a run is: on a terminal one line rewritten four times a second, otherwise a plain line every report interval.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "core/step_report.hpp"

namespace scree::app {

// What a progress line shows.
struct ProgressFigures {
    double time = 0.0, end = 0.0;  // [s] simulated
    std::uint64_t step = 0, steps = 0;
    StepReport report;   // of the last step
    double speed = 0.0;  // [s] of wall time for one simulated second; 0: not known yet
};

// One line of at most `width` columns: the last fields are left out if they do not fit.
std::string live_text(const ProgressFigures& figures, int width);
std::string plain_text(const ProgressFigures& figures);

// Wall seconds for one simulated second, over the last half minute.
class SpeedMeter {
  public:
    void add(double wall, double simulated);
    double speed() const;  // 0 while there is nothing to tell from

  private:
    struct Sample {
        double wall, simulated;
    };
    std::deque<Sample> samples_;
};

class Progress {
  public:
    // `report_interval` [s]; 0: no plain lines.
    Progress(Console& console, double report_interval);

    // What is to be shown now. Cheap enough for every step. By the clock, and so on rank 0 only.
    enum class Due { nothing, line, report };
    Due due();
    // A line on a terminal, and each report interval a line elsewhere.
    void show(Due due, ProgressFigures figures);
    double speed() const { return meter_.speed(); }

  private:
    double now() const;

    Console& console_;
    double report_interval_;
    std::chrono::steady_clock::time_point start_;
    double last_sample_ = 0.0, last_report_ = 0.0;
    SpeedMeter meter_;
};

}  // namespace scree::app
