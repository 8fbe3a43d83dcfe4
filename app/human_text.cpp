#include "app/human_text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

namespace scree::app {

std::string duration_text(double seconds) {
    if (!std::isfinite(seconds)) return "unknown";
    if (seconds < 0.0) return fmt::format("-{}", duration_text(-seconds));
    if (seconds < 59.95) return fmt::format("{:.3g} s", seconds);
    const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
    const std::uint64_t minutes = whole / 60, hours = minutes / 60, days = hours / 24;
    if (hours == 0) return fmt::format("{} min {:02} s", minutes, whole % 60);
    if (days == 0) return fmt::format("{} h {:02} min", hours, minutes % 60);
    return fmt::format("{} d {:02} h", days, hours % 24);
}

std::string bytes_text(double bytes) {
    static constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    while (bytes >= 999.5 && unit + 1 < kUnits.size()) {
        bytes /= 1000.0;
        ++unit;
    }
    return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

std::string count_text(std::uint64_t n) {
    const std::string digits = std::to_string(n);
    if (digits.size() <= 4) return digits;
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
        text += digits[i];
    }
    return text;
}

std::string percent_text(double share) {
    return fmt::format("{:.3g} %", 100.0 * share);
}

std::string length_text(double metres) {
    const double size = std::abs(metres);
    if (size == 0.0) return "0 m";
    if (size < 1e-3) return fmt::format("{:.4g} um", metres * 1e6);
    if (size < 1.0) return fmt::format("{:.4g} mm", metres * 1e3);
    if (size < 1e4) return fmt::format("{:.4g} m", metres);
    return fmt::format("{:.4g} km", metres * 1e-3);
}

std::string point_text(const Vec3& metres) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g}) m", metres.x(), metres.y(), metres.z());
}

std::string plural(std::uint64_t n, std::string_view singular, std::string_view plural_form) {
    return fmt::format("{} {}", count_text(n), n == 1 ? singular : plural_form);
}

namespace {

std::optional<double> whole_number(std::string_view text) {
    std::uint32_t value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return static_cast<double>(value);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t from = 0;;) {
        const std::size_t to = text.find(separator, from);
        parts.push_back(text.substr(from, to - from));
        if (to == std::string_view::npos) return parts;
        from = to + 1;
    }
}

}  // namespace

std::optional<double> parse_clock(std::string_view text) {
    double days = 0.0;
    if (const std::size_t dash = text.find('-'); dash != std::string_view::npos) {
        const auto number = whole_number(text.substr(0, dash));
        if (!number) return std::nullopt;
        days = *number;
        text.remove_prefix(dash + 1);
    }
    const std::vector<std::string_view> parts = split(text, ':');
    if (parts.size() > 3 || (days > 0.0 && parts.size() < 3)) return std::nullopt;
    double seconds = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto number = whole_number(parts[i]);
        if (!number || (i > 0 && (parts[i].size() != 2 || *number >= 60.0))) return std::nullopt;
        seconds = seconds * 60.0 + *number;
    }
    return days * 86400.0 + seconds;
}

}  // namespace scree::app
