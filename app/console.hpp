// What a run says to people, on standard error: messages, warnings, and one line that is rewritten in place when
// standard error is a terminal. Colours only there, and never if NO_COLOR is set. Writing to a broken pipe or a full
// disk never ends a run: what cannot be shown is dropped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scree::app {

// All of `text` to a file descriptor; false if that cannot be.
bool write_all(int descriptor, std::string_view text);

enum class Loudness { silent, quiet, normal, verbose };

class Console {
  public:
    explicit Console(Loudness loudness);
    Console(Loudness loudness, int descriptor, bool terminal, bool colours, int width);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    // Silent: nothing at all, as on all ranks but the first.
    void info(std::string_view text);     // not if quiet
    void detail(std::string_view text);   // only if verbose
    void warning(std::string_view text);  // always; remembered
    void error(std::string_view text);    // always
    // Replaces the line shown last; for terminals only.
    void live(std::string_view text);
    void end_live();

    bool terminal() const { return terminal_; }
    int width() const { return width_; }
    Loudness loudness() const { return loudness_; }
    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    void message(std::string_view colour, std::string_view label, std::string_view text);

    Loudness loudness_;
    int descriptor_;
    bool terminal_, colours_;
    int width_;
    bool live_shown_ = false;
    std::vector<std::string> warnings_;
};

}  // namespace scree::app
