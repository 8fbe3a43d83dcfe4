#include "scenarios/shared_text.hpp"

#include <filesystem>

namespace scree::scenarios {
namespace {

constexpr std::size_t kPiece = std::size_t{4} << 20;  // [bytes]

}  // namespace

SharedText::SharedText(const std::string& path, const Communicator& ranks) : ranks_(ranks) {
    if (ranks.root()) {
        stream_.open(path, std::ios::binary | std::ios::ate);
        is_file_ = stream_ && std::filesystem::is_regular_file(path);
        if (is_file_) size_ = static_cast<std::uint64_t>(stream_.tellg());
        stream_.seekg(0);
    }
    is_file_ = ranks.any(is_file_);
    size_ = ranks.max(size_);
}

std::string SharedText::next() {
    std::string piece = ranks_.root() ? read() : std::string();
    ranks_.broadcast(piece);
    if (piece.empty()) failed_ = ranks_.any(failed_);
    return piece;
}

// On rank 0.
std::string SharedText::read() {
    std::string text = std::move(rest_);
    rest_.clear();
    while (stream_) {
        const std::size_t had = text.size();
        text.resize(had + kPiece);
        stream_.read(text.data() + had, static_cast<std::streamsize>(kPiece));
        text.resize(had + static_cast<std::size_t>(stream_.gcount()));
        failed_ = stream_.bad() || (stream_.fail() && !stream_.eof());
        const std::size_t line_end = stream_ ? text.rfind('\n') : std::string::npos;
        if (line_end == std::string::npos) continue;  // a very long line, or the end of the file
        rest_ = text.substr(line_end + 1);
        text.resize(line_end + 1);
        break;
    }
    return text;
}

}  // namespace scree::scenarios
