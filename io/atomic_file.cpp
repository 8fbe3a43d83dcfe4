#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/errors.hpp"
#include "core/parallel/together.hpp"

namespace scree::io {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kSuffix = ".tmp";

// A file descriptor that closes itself.
class Descriptor {
  public:
    Descriptor(const std::string& path, int flags) : path_(path), fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        if (fd_ < 0) throw_system_error(path, "cannot be opened", errno);
    }
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    void write_all(std::string_view text) const {
        while (!text.empty()) {
            const ssize_t n = ::write(fd_, text.data(), text.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) throw_system_error(path_, "cannot be written", errno);
            text.remove_prefix(static_cast<std::size_t>(n));
        }
    }
    // As much as fits in `room`; "" at the end of the file.
    std::string_view read_piece(std::vector<char>& room) const {
        ssize_t n = 0;
        do {
            n = ::read(fd_, room.data(), room.size());
        } while (n < 0 && errno == EINTR);
        if (n < 0) throw_system_error(path_, "cannot be read", errno);
        return {room.data(), static_cast<std::size_t>(n)};
    }
    // Some file systems cannot sync a folder and say EINVAL: there is then nothing more to be done.
    void sync() const {
        if (::fsync(fd_) != 0 && errno != EINVAL) throw_system_error(path_, "cannot be brought to the disk", errno);
    }
    void close() {
        const int result = ::close(fd_);
        fd_ = -1;
        if (result != 0) throw_system_error(path_, "cannot be closed", errno);
    }

  private:
    std::string path_;
    int fd_;
};

std::string folder_of(const std::string& path) {
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

}  // namespace

void throw_system_error(const std::string& path, const std::string& what, int error_number) {
    throw IoError(path + ": " + what + ": " + std::strerror(error_number));
}

AtomicFile::AtomicFile(std::string path, const Communicator& ranks)
    : path_(std::move(path)), temporary_(path_ + std::string(kSuffix)), ranks_(ranks) {}

AtomicFile::~AtomicFile() {
    if (!committed_ && ranks_.root()) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    by_root(ranks_, [&] { commit_here(); });
}

void AtomicFile::commit_here() {
    Descriptor file(temporary_, O_RDONLY);
    file.sync();
    file.close();
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) throw_system_error(path_, "cannot be replaced", errno);
    committed_ = true;
    Descriptor folder(folder_of(path_), O_RDONLY | O_DIRECTORY);
    folder.sync();
    folder.close();
}

void write_text_atomically(const std::string& path, std::string_view text) {
    AtomicFile file(path);
    Descriptor out(file.temporary(), O_WRONLY | O_CREAT | O_TRUNC);
    out.write_all(text);
    out.close();
    file.commit();
}

void copy_file(const std::string& from, const std::string& to) {
    const Descriptor in(from, O_RDONLY);
    Descriptor out(to, O_WRONLY | O_CREAT | O_TRUNC);
    std::vector<char> room(std::size_t{1} << 20);
    for (std::string_view piece = in.read_piece(room); !piece.empty(); piece = in.read_piece(room))
        out.write_all(piece);
    out.close();
}

std::string read_text(const std::string& path) {
    if (fs::is_directory(path)) throw_system_error(path, "cannot be read", EISDIR);
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) throw_system_error(path, "cannot be opened", errno != 0 ? errno : EIO);
    std::ostringstream text;
    text << in.rdbuf();
    if (in.bad()) throw_system_error(path, "cannot be read", errno != 0 ? errno : EIO);
    return text.str();
}

void make_folder(const std::string& path) {
    std::error_code code;
    fs::create_directories(path, code);
    if (code) throw IoError(path + ": this folder cannot be made: " + code.message());
    if (!fs::is_directory(path)) throw_system_error(path, "this folder cannot be made", ENOTDIR);
}

void remove_leftovers(const std::string& folder) {
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
        const std::string name = entry.path().filename().string();
        if (name.size() > kSuffix.size() && name.ends_with(kSuffix)) fs::remove(entry.path(), code);
    }
}

}  // namespace scree::io
