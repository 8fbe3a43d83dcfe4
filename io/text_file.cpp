#include "io/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/scenario/utf8.hpp"

namespace scree::io {
namespace {

bool is_control(unsigned char c) {
    return (c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c == 0x7F;
}

}  // namespace

std::optional<std::string> read_text_file(const std::string& path, const Mark& named_at, Diagnostics& diagnostics) {
    const auto refuse = [&](const std::string& why) -> std::optional<std::string> {
        diagnostics.error(named_at, named_at.line > 0 ? fmt::format("'{}': {}", path, why) : why);
        return std::nullopt;
    };
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (!std::filesystem::exists(status)) return refuse("there is no such file");
    if (std::filesystem::is_directory(status)) return refuse("this is a folder, not a file");
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
    std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (stream.bad()) return refuse("cannot be read");
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
    diagnostics.add_source(path, text);
    if (!check_text(text, path, diagnostics)) return std::nullopt;
    return text;
}

bool check_text(const std::string& text, const std::string& file, Diagnostics& diagnostics) {
    Mark mark{file, 1, 1};
    bool good = true, in_indentation = true;
    for (std::size_t i = 0; i < text.size();) {
        const auto c = static_cast<unsigned char>(text[i]);
        const std::size_t length = utf8_length(text, i);
        if (length == 0 || is_control(c)) {
            diagnostics.error(mark, fmt::format("byte 0x{:02x} is no text: a scenario is a YAML file in UTF-8", c));
            return false;
        }
        if (c == '\t' && in_indentation) {
            // A line of blanks alone is harmless.
            const auto next = text.find_first_not_of(" \t\r", i);
            if (next != std::string::npos && text[next] != '\n' && text[next] != '#') {
                diagnostics.error(mark, "a tab in the indentation: YAML takes blanks only");
                good = false;
            }
            in_indentation = false;
        }
        if (c != ' ') in_indentation = false;
        ++mark.column;
        if (c == '\n') {
            ++mark.line;
            mark.column = 1;
            in_indentation = true;
        }
        i += length;
    }
    return good;
}

}  // namespace scree::io
