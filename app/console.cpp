#include "app/console.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace scree::app {
namespace {

constexpr std::string_view kClearLine = "\r\x1b[K";

bool colours_wanted() {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    return (no_color == nullptr || *no_color == '\0') && term != nullptr && std::string_view(term) != "dumb";
}

int terminal_width(int descriptor) {
    winsize size{};
    if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 20) return size.ws_col;
    return 80;
}

}  // namespace

bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t n = ::write(descriptor, text.data(), text.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

Console::Console(Loudness loudness)
    : Console(loudness, STDERR_FILENO, isatty(STDERR_FILENO) == 1, isatty(STDERR_FILENO) == 1 && colours_wanted(),
              terminal_width(STDERR_FILENO)) {}

Console::Console(Loudness loudness, int descriptor, bool terminal, bool colours, int width)
    : loudness_(loudness), descriptor_(descriptor), terminal_(terminal), colours_(colours), width_(width) {}

Console::~Console() {
    end_live();
}

void Console::message(std::string_view colour, std::string_view label, std::string_view text) {
    if (loudness_ == Loudness::silent) return;
    std::string line;
    if (live_shown_) line += kClearLine;
    live_shown_ = false;
    if (colours_ && !colour.empty()) {
        line.append(colour).append(label).append("\x1b[0m");
    } else {
        line.append(label);
    }
    line.append(text);
    if (line.empty() || line.back() != '\n') line += '\n';
    write_all(descriptor_, line);
}

void Console::info(std::string_view text) {
    if (loudness_ > Loudness::quiet) message("", "", text);
}
void Console::detail(std::string_view text) {
    if (loudness_ == Loudness::verbose) message("", "", text);
}
void Console::warning(std::string_view text) {
    warnings_.emplace_back(text);
    message("\x1b[33m", "warning: ", text);
}
void Console::error(std::string_view text) {
    message("\x1b[31m", "error: ", text);
}

void Console::live(std::string_view text) {
    if (!terminal_ || loudness_ <= Loudness::quiet) return;
    std::string line(kClearLine);
    line.append(text.substr(0, static_cast<std::size_t>(width_ - 1)));
    write_all(descriptor_, line);
    live_shown_ = true;
}

void Console::end_live() {
    if (live_shown_) write_all(descriptor_, "\n");
    live_shown_ = false;
}

}  // namespace scree::app
