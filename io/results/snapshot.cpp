#include "io/results/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/wall_description.hpp"

namespace scree::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "scree snapshot";
constexpr const char* kFolder = "snapshots";

std::vector<Vec3> shifted(const std::vector<Vec3>& positions, const Vec3& origin) {
    std::vector<Vec3> out(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) out[i] = positions[i] + origin;
    return out;
}

void write_bodies(const Hdf5Group& root, const Scene& scene, const Bodies& bodies, const Layout& layout) {
    const Hdf5Group group = root.group("bodies");
    const auto asked = [&](const char* field) {
        const std::vector<std::string>& fields = scene.output.fields;
        return std::find(fields.begin(), fields.end(), field) != fields.end();
    };
    std::vector<std::int64_t> id;
    for (BodyId i : bodies.id) id.push_back(static_cast<std::int64_t>(raw(i)));
    write_rows(group, "id", rows_of(id), {"1", "stable number of the body; rows are in its order"}, layout);
    write_rows(group, "position", rows_of(shifted(bodies.position, scene.origin)), {"m", "centre", "world"}, layout);
    write_rows(group, "radius", rows_of(bodies.radius), {"m", "radius"}, layout);
    if (asked("velocity")) {
        write_rows(group, "velocity", rows_of(bodies.velocity), {"m/s", "velocity of the centre", "world"}, layout);
    }
    if (asked("spin") && bodies.spin.size() == bodies.size()) {
        write_rows(group, "spin", rows_of(bodies.spin), {"rad/s", "angular velocity", "world"}, layout);
    }
    if (asked("mass")) write_rows(group, "mass", rows_of(bodies.mass), {"kg", "mass"}, layout);
    if (asked("material")) {
        std::vector<std::int32_t> material;
        for (MaterialIndex m : bodies.material) material.push_back(raw(m));
        write_rows(group, "material", rows_of(material), {"1", "row of /materials"}, layout);
    }
    if (asked("orientation") && bodies.orientation.size() == bodies.size()) {
        std::vector<double> wxyz;
        for (const Quat& q : bodies.orientation) wxyz.insert(wxyz.end(), {q.w(), q.x(), q.y(), q.z()});
        Rows rows = rows_of(wxyz);
        rows.count = bodies.size();
        rows.shape = {4};
        write_rows(group, "orientation", rows, {"1", "unit quaternion w, x, y, z from the body to the world", "world"},
                   layout);
    }
}

void write_materials(const Hdf5Group& root, const Scene& scene) {
    const Hdf5Group group = root.group("materials");
    std::vector<std::string> name;
    std::vector<double> density;
    for (const Material& m : scene.materials) {
        name.push_back(m.name);
        density.push_back(m.density);
    }
    write_texts(group, "name", name, "name of the material");
    write_rows(group, "density", rows_of(density), {"kg/m3", "density"});
}

void write_walls(const Hdf5Group& root, const Scene& scene, double time) {
    const Hdf5Group group = root.group("walls");
    std::vector<std::string> name, shape, parameters;
    std::vector<std::int32_t> material;
    std::vector<std::uint8_t> present;
    std::vector<double> rotation;
    std::vector<Vec3> translation;
    for (const Wall& wall : scene.walls) {
        name.push_back(wall.name);
        shape.push_back(shape_name(wall.shape));
        parameters.push_back(shape_json(wall.shape));
        material.push_back(raw(wall.material));
        present.push_back(wall.present(time) ? 1 : 0);
        const WallPose pose = pose_at(wall.motion, time);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) rotation.push_back(pose.rotation(i, j));
        }
        translation.push_back(pose.translation + scene.origin);
    }
    write_texts(group, "name", name, "name of the wall");
    write_texts(group, "shape", shape, "plane, box, cylinder, cone, disc, orifice_floor or slot_floor");
    write_texts(group, "parameters", parameters, "JSON: the shape in its own frame [m]; null is an infinite length");
    write_rows(group, "material", rows_of(material), {"1", "row of /materials"});
    write_rows(group, "present", rows_of(present), {"1", "1 if the wall is there at this time, else 0"});
    Rows matrices = rows_of(rotation);
    matrices.count = scene.walls.size();
    matrices.shape = {3, 3};
    write_rows(group, "rotation", matrices, {"1", "world = rotation . local + translation", "world"});
    write_rows(group, "translation", rows_of(translation), {"m", "world = rotation . local + translation", "world"});
}

void write_contacts(const Hdf5Group& root, const Scene& scene, const std::vector<ContactRecord>& contacts,
                    const Layout& layout) {
    const Hdf5Group group = root.group("contacts");
    std::vector<std::int64_t> a, b;
    std::vector<std::uint32_t> feature;
    std::vector<Vec3> point, normal, impulse, force;
    std::vector<double> gap;
    std::vector<std::uint8_t> status;
    for (const ContactRecord& c : contacts) {
        a.push_back(static_cast<std::int64_t>(c.key.a));
        b.push_back(c.key.is_wall() ? -1 - static_cast<std::int64_t>(raw(c.key.wall_index()))
                                    : static_cast<std::int64_t>(c.key.b));
        feature.push_back(c.key.feature);
        point.push_back(c.point + scene.origin);
        normal.push_back(c.normal);
        gap.push_back(c.gap);
        impulse.push_back(c.impulse);
        force.push_back(c.impulse / c.step);
        status.push_back(static_cast<std::uint8_t>(c.status));
    }
    write_rows(group, "id_a", rows_of(a), {"1", "body a"}, layout);
    write_rows(group, "id_b", rows_of(b), {"1", "body b; -1 - row of /walls for a wall"}, layout);
    write_rows(group, "feature", rows_of(feature), {"1", "which surface or edge of the wall; 0 between bodies"},
               layout);
    write_rows(group, "point", rows_of(point), {"m", "where they touch, at the middle of the step", "world"}, layout);
    write_rows(group, "normal", rows_of(normal), {"1", "unit normal from b to a", "world"}, layout);
    write_rows(group, "gap", rows_of(gap), {"m", "distance at the end of the step; negative: penetration"}, layout);
    write_rows(group, "impulse", rows_of(impulse), {"N s", "impulse on a in the step", "world"}, layout);
    write_rows(group, "force", rows_of(force), {"N", "mean force on a over the step", "world"}, layout);
    write_rows(group, "status", rows_of(status), {"1", "0 open, 1 sticking, 2 sliding"}, layout);
}

bool is_snapshot_name(const std::string& name) {
    return name.size() > 3 && name.ends_with(".h5") && name.find_first_not_of("0123456789") == name.size() - 3;
}

}  // namespace

void write_snapshot(const std::string& path, std::uint64_t number, const Scene& scene, const State& state,
                    const std::vector<ContactRecord>& contacts, const Provenance& provenance) {
    AtomicFile out(path);
    Hdf5File file = Hdf5File::create(out.temporary());
    const Hdf5Group& root = file.root();
    const Layout layout{.gzip = scene.output.compression};
    const Vec3 gravity = scene.gravity.at(state.time);
    write_format(root, kFormat);
    root.attribute("number", number);
    root.attribute("time", state.time);
    root.attribute("step", state.step);
    root.attribute("title", scene.title);
    root.attribute("gravity", std::span<const double>(gravity.data(), 3));
    root.attribute("units", "time s, gravity m/s2");
    write_provenance(root, provenance);
    write_materials(root, scene);
    write_walls(root, scene, state.time);
    write_bodies(root, scene, state.bodies, layout);
    if (scene.output.contacts) write_contacts(root, scene, contacts, layout);
    file.close();
    out.commit();
}

SnapshotSeries::SnapshotSeries(std::string run_folder, std::uint64_t first_number)
    : run_folder_(std::move(run_folder)), xdmf_(run_folder_ + "/run.xdmf") {
    const std::string folder = run_folder_ + "/" + kFolder;
    make_folder(folder);
    remove_leftovers(folder);
    for (const std::string& path : list_snapshots(run_folder_)) {
        const std::string name = fs::path(path).filename().string();
        if (std::stoull(name) >= first_number) break;
        try {
            xdmf_.add(path, std::string(kFolder) + "/" + name);
        } catch (const IoError&) {
            // A snapshot that was damaged since must not keep the run from going on: it is left out of the list.
        }
    }
}

void SnapshotSeries::write(const Scene& scene, State& state, const std::vector<ContactRecord>& contacts,
                           const Provenance& provenance) {
    const std::string relative = fmt::format("{}/{:06}.h5", kFolder, state.snapshots_written);
    const std::string path = run_folder_ + "/" + relative;
    write_snapshot(path, state.snapshots_written, scene, state, contacts, provenance);
    xdmf_.add(path, relative);
    xdmf_.write();
    std::error_code code;
    const std::uintmax_t size = fs::file_size(path, code);
    if (!code) bytes_ += size;
    ++files_;
    ++state.snapshots_written;
}

std::vector<std::string> list_snapshots(const std::string& run_folder) {
    std::vector<std::string> paths;
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(run_folder + "/" + kFolder, code)) {
        if (is_snapshot_name(entry.path().filename().string())) paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end(), [](const std::string& a, const std::string& b) {
        return a.size() != b.size() ? a.size() < b.size() : a < b;
    });
    return paths;
}

}  // namespace scree::io
