// Numbers as people read them: durations, bytes, counts, lengths. For messages only; files hold SI.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/vec.hpp"

namespace scree::app {

std::string duration_text(double seconds);   // "0.42 s", "3 min 05 s", "2 h 10 min", "4 d 03 h"
std::string bytes_text(double bytes);        // "512 B", "1.3 MB"
std::string count_text(std::uint64_t n);     // "1 234 567"
std::string percent_text(double share);      // 0.0123 -> "1.23 %"
std::string length_text(double metres);      // "6 mm", "1.2 m"
std::string point_text(const Vec3& metres);  // "(0.1, 0, 2.5) m"
std::string plural(std::uint64_t n, std::string_view singular, std::string_view plural_form);  // "1 body", "2 bodies"

// "23:50:00", "50:00", "1-02:00:00" (days first, as Slurm writes it) or seconds; nothing if it is none of these.
std::optional<double> parse_clock(std::string_view text);

}  // namespace scree::app
