#include "io/results/sealed_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/errors.hpp"
#include "core/parallel/together.hpp"
#include "core/random.hpp"
#include "io/atomic_file.hpp"
#include "io/checksum.hpp"

namespace scree::io {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::uint64_t kStripe = std::uint64_t{64} << 20;
constexpr std::string_view kStart = "Scree, sealed HDF5 file:";

[[noreturn]] void fail(const std::string& path, const char* what) {
    throw_system_error(path, what, errno != 0 ? errno : EIO);
}

// The part of this rank in the checksum of a file that is `size` bytes long.
std::uint64_t sum_of_stripes(std::istream& in, std::uint64_t size, const Communicator& ranks) {
    std::vector<char> piece(kPiece);
    std::uint64_t sum = 0;
    const auto rank = static_cast<std::uint64_t>(ranks.rank()), step = static_cast<std::uint64_t>(ranks.size());
    for (std::uint64_t stripe = rank; kSealBytes + stripe * kStripe < size; stripe += step) {
        std::uint64_t left = std::min<std::uint64_t>(kStripe, size - kSealBytes - stripe * kStripe);
        in.seekg(static_cast<std::streamoff>(kSealBytes + stripe * kStripe));
        Checksum checksum;
        while (left > 0 && in) {
            in.read(piece.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(kPiece, left)));
            checksum.add(piece.data(), static_cast<std::size_t>(in.gcount()));
            left -= static_cast<std::uint64_t>(in.gcount());
        }
        in.clear(in.rdstate() & std::ios::badbit);
        sum += mix64(checksum.value() ^ mix64(stripe));
    }
    return sum;
}

// The text of a seal: the length of the file and the checksum of what follows the seal.
std::string seal_text(std::uint64_t size, std::uint64_t sum) {
    std::string text = fmt::format("{} {} bytes, checksum {:016x}\n", kStart, size, sum);
    text.resize(kSealBytes, '\0');
    return text;
}

std::uint64_t size_of(const std::string& path) {
    std::error_code code;
    const std::uintmax_t size = std::filesystem::file_size(path, code);
    if (code) throw IoError(path + ": cannot be read: " + code.message());
    return size;
}

}  // namespace

void seal(const std::string& path, const Communicator& ranks) {
    std::uint64_t sum = 0;
    together(ranks, [&] {
        errno = 0;
        std::ifstream file(path, std::ios::binary);
        if (!file) fail(path, "cannot be opened");
        sum = sum_of_stripes(file, size_of(path), ranks);
        if (file.bad()) fail(path, "cannot be read");
    });
    sum = ranks.sum(sum);
    by_root(ranks, [&] {
        errno = 0;
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        if (!file) fail(path, "cannot be opened");
        const std::string text = seal_text(size_of(path), sum);
        file.write(text.data(), static_cast<std::streamsize>(text.size()));
        file.close();
        if (!file) fail(path, "cannot be written");
    });
}

void check_seal(const std::string& path, const Communicator& ranks) {
    std::string found(kSealBytes, '\0');
    std::uint64_t size = 0, sum = 0;
    together(ranks, [&] {
        errno = 0;
        std::ifstream file(path, std::ios::binary);
        if (!file) fail(path, "cannot be opened");
        file.read(found.data(), static_cast<std::streamsize>(found.size()));
        if (file.bad()) fail(path, "cannot be read");
        if (!found.starts_with(kStart)) throw IoError(path + ": this is not a checkpoint of Scree");
        file.clear();
        size = size_of(path);
        sum = sum_of_stripes(file, size, ranks);
        if (file.bad()) fail(path, "cannot be read");
    });
    sum = ranks.sum(sum);
    by_root(ranks, [&] {
        if (found == seal_text(size, sum)) return;
        const std::string length = fmt::format(": {} bytes,", size);
        throw IoError(path + ": this file is damaged: " +
                      (found.find(length) == std::string::npos ? "it is truncated (its length has changed)"
                                                               : "its checksum does not fit its bytes"));
    });
}

bool has_seal(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string found(kStart.size(), '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    return found == kStart;
}

}  // namespace scree::io
