#include "io/hdf5/hdf5_file.hpp"

#include <algorithm>
#include <type_traits>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/file_driver.hpp"
#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

static_assert(std::is_same_v<hid_t, std::int64_t>, "Hdf5Id holds an hid_t without showing hdf5.h");
static_assert(std::is_same_v<herr_t, int>);

namespace {

// The outermost message says what was tried, the innermost why it failed.
struct ErrorText {
    std::string outermost, innermost;
};

herr_t collect_error(unsigned, const H5E_error2_t* error, void* data) {
    auto* text = static_cast<ErrorText*>(data);
    const std::string description = error->desc != nullptr ? error->desc : "";
    if (text->outermost.empty()) text->outermost = description;
    text->innermost = description;
    return 0;
}

// If the system refused something, its reason says it all; HDF5 hides it in "..., error message = 'reason', ...".
std::string system_reason(const std::string& description) {
    constexpr std::string_view kBefore = "error message = '";
    const std::size_t start = description.find(kBefore);
    if (start == std::string::npos) return "";
    const std::string rest = description.substr(start + kBefore.size());
    return rest.substr(0, rest.find('\''));
}

Hdf5Id file_access(const std::string& path) {
    silence_hdf5();
    Hdf5Id access = owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "HDF5 cannot be used");
    // Closing the file closes what is still open in it: a file that stays open by mistake would not be whole.
    require(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), path, "HDF5 cannot be used");
#if H5_VERSION_GE(1, 10, 7)
    // Files under their final name are never written to, so locks protect nothing; on some network file systems they
    // fail.
    require(H5Pset_file_locking(access.get(), false, true), path, "HDF5 cannot be used");
#endif
    return access;
}

Hdf5Group root_group(const Hdf5Id& file, const std::string& path) {
    return {owned(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose, path, "cannot be read"), path, "/"};
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
}

void collect_datasets(const Hdf5Group& root, hid_t group, const std::string& prefix, std::vector<DatasetInfo>& out) {
    std::vector<std::string> names;
    require(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names), root.file(),
            "its contents cannot be listed");
    for (const std::string& name : names) {
        H5L_info_t link;
        require(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT), root.file(), "its contents cannot be listed");
        if (link.type == H5L_TYPE_EXTERNAL && H5Oexists_by_name(group, name.c_str(), H5P_DEFAULT) <= 0) continue;
        const Hdf5Id object = owned(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose, root.file(),
                                    "'" + prefix + name + "' cannot be opened");
        const H5I_type_t kind = H5Iget_type(object.get());
        if (kind == H5I_GROUP) collect_datasets(root, object.get(), prefix + name + "/", out);
        if (kind == H5I_DATASET) out.push_back(root.dataset(prefix + name));
    }
}

}  // namespace

void silence_hdf5() {
    // Every file is closed here: HDF5 needs no clean-up of its own at exit.
    static const bool done = [] { return H5dont_atexit() >= 0 && H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0; }();
    static_cast<void>(done);
}

void throw_hdf5_error(const std::string& file, const std::string& what) {
    ErrorText text;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, collect_error, &text);
    std::string message = file + ": " + what;
    if (fault_of_open_file() != 0) throw_system_error(file, what, fault_of_open_file());  // the cause of what follows
    const std::string reason = system_reason(text.innermost);
    if (!reason.empty()) throw IoError(message + ": " + reason);
    if (!text.outermost.empty()) message += ": " + text.outermost;
    if (text.innermost != text.outermost) message += ": " + text.innermost;
    throw IoError(message);
}

Hdf5Id& Hdf5Id::operator=(Hdf5Id&& other) noexcept {
    if (this != &other) {
        reset();
        id_ = other.id_;
        closer_ = other.closer_;
        other.id_ = -1;
    }
    return *this;
}

int Hdf5Id::reset() {
    const int result = id_ >= 0 ? closer_(id_) : 0;
    id_ = -1;
    return result;
}

Hdf5File::Hdf5File(Hdf5Id id, std::string path)
    : path_(std::move(path)), id_(std::move(id)), root_(root_group(id_, path_)) {}

Hdf5File Hdf5File::create(const std::string& path, std::size_t user_block) {
    const Hdf5Id access = file_access(path);
    use_file_driver(access, path);
    const Hdf5Id creation = owned(H5Pcreate(H5P_FILE_CREATE), H5Pclose, path, "HDF5 cannot be used");
    require(H5Pset_userblock(creation.get(), user_block), path, "HDF5 cannot be used");
    return {owned(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, path,
                  "cannot be created"),
            path};
}

Hdf5File Hdf5File::open(const std::string& path) {
    const Hdf5Id access = file_access(path);
    return {owned(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, path, "cannot be read"), path};
}

Hdf5File Hdf5File::open_writable(const std::string& path) {
    const Hdf5Id access = file_access(path);
    use_file_driver(access, path);
    return {owned(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose, path, "cannot be opened"), path};
}

void Hdf5File::close() {
    require(H5Fflush(id_.get(), H5F_SCOPE_GLOBAL), path_, "cannot be written");
    root_ = Hdf5Group({}, path_, "/");
    require(id_.reset(), path_, "cannot be closed");
    if (fault_of_closed_file() != 0) throw_system_error(path_, "cannot be written", fault_of_closed_file());
}

Hdf5Group::Hdf5Group(Hdf5Id id, std::string file, std::string path)
    : id_(std::move(id)), file_(std::move(file)), path_(std::move(path)) {}

Hdf5Group Hdf5Group::existing_group(const std::string& name) const {
    const std::string below = (path_ == "/" ? "" : path_) + "/" + name;
    return {owned(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose, file_, "has no group '" + below + "'"), file_,
            below};
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
    if (!has(name)) {
        const std::string what = "group '" + name + "' cannot be made";
        owned(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, file_, what);
    }
    return existing_group(name);
}

bool Hdf5Group::has(const std::string& name) const {
    // H5Lexists wants every part of the way to be there.
    for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
        if (H5Lexists(id(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    }
    return H5Lexists(id(), name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5Group::remove(const std::string& name) const {
    require(H5Ldelete(id(), name.c_str(), H5P_DEFAULT), file_, "'" + name + "' cannot be removed");
}

void Hdf5Group::link(const std::string& name, const std::string& path, const std::string& object) const {
    require(H5Lcreate_external(path.c_str(), object.c_str(), id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), file_,
            "'" + name + "' cannot be linked");
}

std::vector<DatasetInfo> Hdf5Group::datasets() const {
    std::vector<DatasetInfo> all;
    collect_datasets(*this, id(), "", all);
    return all;
}

void write_format(const Hdf5Group& root, std::string_view format) {
    root.attribute("format", format);
    const std::uint64_t version[] = {kFormatMajor, kFormatMinor};
    root.attribute("format_version", version);
}

void check_format(const Hdf5Group& root, std::string_view format) {
    const std::string found = root.has_attribute("format") ? root.text_attribute("format") : "";
    if (found != format) {
        throw IoError(root.file() + ": this is not a " + std::string(format) +
                      (found.empty() ? " (it has no attribute 'format')" : ", but a " + found));
    }
    const std::vector<double> version = root.numbers_attribute("format_version");
    if (version.empty() || version[0] != static_cast<double>(kFormatMajor)) {
        throw IoError(root.file() + ": format version " + (version.empty() ? "?" : std::to_string(version[0])) +
                      " is not known to this Scree, which reads version " + std::to_string(kFormatMajor));
    }
}

}  // namespace scree::io
