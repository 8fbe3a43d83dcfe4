#include "io/results/sealed_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/checksum.hpp"

namespace scree::io {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::string_view kStart = "Scree, sealed HDF5 file:";

[[noreturn]] void fail(const std::string& path, const char* what) {
    throw_system_error(path, what, errno != 0 ? errno : EIO);
}

// The text of a seal: the length of the file and the checksum of what follows the seal.
std::string seal_text(std::istream& in, std::uint64_t size) {
    in.seekg(static_cast<std::streamoff>(kSealBytes));
    std::vector<char> piece(kPiece);
    Checksum checksum;
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        if (in.gcount() > 0) checksum.add(piece.data(), static_cast<std::size_t>(in.gcount()));
    }
    std::string text = fmt::format("{} {} bytes, checksum {:016x}\n", kStart, size, checksum.value());
    text.resize(kSealBytes, '\0');
    return text;
}

}  // namespace

void seal(const std::string& path) {
    errno = 0;
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    if (!file) fail(path, "cannot be opened");
    const std::string text = seal_text(file, std::filesystem::file_size(path));
    if (file.bad()) fail(path, "cannot be read");
    file.clear();
    file.seekp(0);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) fail(path, "cannot be written");
}

void check_seal(const std::string& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, "cannot be opened");
    std::string found(kSealBytes, '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    if (file.bad()) fail(path, "cannot be read");
    if (!found.starts_with(kStart)) throw IoError(path + ": this is not a checkpoint of Scree");
    std::error_code code;
    const std::uint64_t size = std::filesystem::file_size(path, code);
    const std::string expected = seal_text(file, size);
    if (file.bad()) fail(path, "cannot be read");
    if (found == expected) return;
    const std::string length = fmt::format(": {} bytes,", size);
    throw IoError(path + ": this file is damaged: " +
                  (found.find(length) == std::string::npos ? "it is truncated (its length has changed)"
                                                           : "its checksum does not fit its bytes"));
}

bool has_seal(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string found(kStart.size(), '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    return found == kStart;
}

}  // namespace scree::io
