#include "io/hdf5/file_driver.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

namespace {

// What HDF5 holds of an open file; it knows the first member only.
struct OpenFile {
    H5FD_t known{};
    int descriptor = -1;
    haddr_t end_of_addresses = 0, end_of_file = 0;
    dev_t device = 0;
    ino_t inode = 0;
};

bool only_places = false;
haddr_t last_place = 0;
int fault = 0, closed_fault = 0;

OpenFile& of(H5FD_t* file) {
    return *reinterpret_cast<OpenFile*>(file);
}
const OpenFile& of(const H5FD_t* file) {
    return *reinterpret_cast<const OpenFile*>(file);
}

// HDF5 is not told.
herr_t keep_fault() {
    if (fault == 0) fault = errno != 0 ? errno : EIO;
    return 0;
}

// In the words in which HDF5's own driver gives the system's reason (hdf5_file.cpp finds it there).
herr_t refuse(const char* function, hid_t minor, const char* what) {
    H5Epush2(H5E_DEFAULT, __FILE__, function, __LINE__, H5E_ERR_CLS, H5E_VFL, minor, "%s, error message = '%s'", what,
             std::strerror(errno));
    return -1;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
    int mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
    if ((flags & H5F_ACC_TRUNC) != 0) mode |= O_TRUNC;
    if ((flags & H5F_ACC_CREAT) != 0) mode |= O_CREAT;
    if ((flags & H5F_ACC_EXCL) != 0) mode |= O_EXCL;
    const int descriptor = ::open(name, mode | O_CLOEXEC, 0666);
    struct stat info {};
    if (descriptor < 0 || ::fstat(descriptor, &info) != 0) {
        refuse("open", H5E_CANTOPENFILE, "unable to open file");
        if (descriptor >= 0) ::close(descriptor);
        return nullptr;
    }
    fault = 0;
    auto* file = new OpenFile;
    file->descriptor = descriptor;
    file->end_of_file = static_cast<haddr_t>(info.st_size);
    file->device = info.st_dev;
    file->inode = info.st_ino;
    return &file->known;
}

herr_t close_file(H5FD_t* file) {
    const int result = ::close(of(file).descriptor);
    delete &of(file);
    if (result != 0) keep_fault();
    closed_fault = fault;
    fault = 0;
    return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
    const OpenFile &x = of(a), &y = of(b);
    if (x.device != y.device) return x.device < y.device ? -1 : 1;
    return x.inode == y.inode ? 0 : x.inode < y.inode ? -1 : 1;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
}

haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) {
    return of(file).end_of_addresses;
}
herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    of(file).end_of_addresses = end;
    return 0;
}
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) {
    return of(file).end_of_file;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* buffer) {
    auto* to = static_cast<char*>(buffer);
    while (size > 0) {
        const ssize_t n = ::pread(of(file).descriptor, to, size, static_cast<off_t>(at));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return refuse("read", H5E_READERROR, "file read failed");
        if (n == 0) {  // past the end: zeros
            std::memset(to, 0, size);
            break;
        }
        to += n, at += static_cast<haddr_t>(n), size -= static_cast<std::size_t>(n);
    }
    return 0;
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t type, hid_t, haddr_t at, std::size_t size, const void* buffer) {
    const bool numbers = type == H5FD_MEM_DRAW;
    if (numbers) last_place = at;
    if (fault != 0 || (numbers && only_places)) return 0;
    const auto* from = static_cast<const char*>(buffer);
    while (size > 0) {
        const ssize_t n = ::pwrite(of(file).descriptor, from, size, static_cast<off_t>(at));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return keep_fault();
        from += n, at += static_cast<haddr_t>(n), size -= static_cast<std::size_t>(n);
    }
    of(file).end_of_file = std::max(of(file).end_of_file, at);
    return 0;
}

herr_t truncate_file(H5FD_t* file, hid_t, hbool_t) {
    OpenFile& f = of(file);
    if (f.end_of_addresses == f.end_of_file || fault != 0) return 0;
    if (::ftruncate(f.descriptor, static_cast<off_t>(f.end_of_addresses)) != 0) return keep_fault();
    f.end_of_file = f.end_of_addresses;
    return 0;
}

hid_t registered() {
    static const hid_t id = [] {
        static H5FD_class_t driver{};
        driver.name = "scree_file";
        driver.maxaddr = (haddr_t{1} << 62) - 1;
        driver.fc_degree = H5F_CLOSE_WEAK;
        driver.open = open_file;
        driver.close = close_file;
        driver.cmp = compare;
        driver.query = query;
        driver.get_eoa = end_of_addresses;
        driver.set_eoa = set_end_of_addresses;
        driver.get_eof = end_of_file;
        driver.read = read_bytes;
        driver.write = write_bytes;
        driver.truncate = truncate_file;
        const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
        std::copy(std::begin(map), std::end(map), driver.fl_map);
        return H5FDregister(&driver);
    }();
    return id;
}

}  // namespace

void use_file_driver(const Hdf5Id& access, const std::string& file) {
    const std::string what = "HDF5 cannot be used";
    if (registered() < 0) throw_hdf5_error(file, what);
    require(H5Pset_driver(access.get(), registered(), nullptr), file, what);
}

int fault_of_open_file() {
    return fault;
}
int fault_of_closed_file() {
    return closed_fault;
}

OnlyPlaces::OnlyPlaces() {
    only_places = true;
    last_place = 0;
}
OnlyPlaces::~OnlyPlaces() {
    only_places = false;
}
std::uint64_t OnlyPlaces::last() const {
    return last_place;
}

}  // namespace scree::io
