#include "io/results/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/errors.hpp"
#include "core/parallel/sorted_slices.hpp"
#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/hdf5/shared_file.hpp"
#include "io/results/body_mesh.hpp"
#include "io/results/shapes_file.hpp"
#include "io/results/terrain_file.hpp"
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

// `arrays`: those that the run has; a rank without bodies cannot see it.
void write_bodies(SharedFile& file, const Scene& scene, const Bodies& bodies, const Bodies::Arrays& arrays,
                  const Layout& layout) {
    const auto write = [&](const char* field, const Rows& rows, const Meaning& meaning) {
        file.rows(std::string("bodies/") + field, rows, meaning, layout);
    };
    const auto asked = [&](const char* field) {
        const std::vector<std::string>& fields = scene.output.fields;
        return std::find(fields.begin(), fields.end(), field) != fields.end();
    };
    std::vector<std::int64_t> id;
    for (BodyId i : bodies.id) id.push_back(static_cast<std::int64_t>(raw(i)));
    write("id", rows_of(id), {"1", "stable number of the body; rows are in its order"});
    write("position", rows_of(shifted(bodies.position, scene.origin)), {"m", "centre", "world"});
    write("radius", rows_of(bodies.radius), {"m", "radius"});
    if (asked("velocity")) write("velocity", rows_of(bodies.velocity), {"m/s", "velocity of the centre", "world"});
    if (asked("spin") && arrays.spin) write("spin", rows_of(bodies.spin), {"rad/s", "angular velocity", "world"});
    if (asked("mass")) write("mass", rows_of(bodies.mass), {"kg", "mass"});
    if (asked("material")) {
        std::vector<std::int32_t> material;
        for (MaterialIndex m : bodies.material) material.push_back(raw(m));
        write("material", rows_of(material), {"1", "row of /materials"});
    }
    if (arrays.shape) {
        std::vector<std::int32_t> shape;
        for (const ShapeIndex s : bodies.shape) shape.push_back(s == kSphere ? -1 : static_cast<std::int32_t>(raw(s)));
        write("shape", rows_of(shape), {"1", "row of /shapes/vertices; -1 for a sphere"});
    }
    if ((arrays.shape || asked("orientation")) && arrays.orientation) {
        std::vector<double> wxyz;
        for (const Quat& q : bodies.orientation) wxyz.insert(wxyz.end(), {q.w(), q.x(), q.y(), q.z()});
        Rows rows = rows_of(wxyz);
        rows.count = bodies.size();
        rows.shape = {4};
        write("orientation", rows, {"1", "unit quaternion w, x, y, z from the body to the world", "world"});
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
    write_texts(group, "shape", shape, "plane, box, cylinder, cone, disc, orifice_floor, slot_floor or terrain");
    write_texts(group, "parameters", parameters, "JSON: the shape in its own frame [m]; null is an infinite length");
    write_rows(group, "material", rows_of(material), {"1", "row of /materials"});
    write_rows(group, "present", rows_of(present), {"1", "1 if the wall is there at this time, else 0"});
    Rows matrices = rows_of(rotation);
    matrices.count = scene.walls.size();
    matrices.shape = {3, 3};
    write_rows(group, "rotation", matrices, {"1", "world = rotation . local + translation", "world"});
    write_rows(group, "translation", rows_of(translation), {"m", "world = rotation . local + translation", "world"});
}

// `contacts`: in order of key.
void write_contacts(SharedFile& file, const Scene& scene, const std::vector<ContactRecord>& contacts,
                    const Layout& layout) {
    const auto write = [&](const char* field, const Rows& rows, const Meaning& meaning) {
        file.rows(std::string("contacts/") + field, rows, meaning, layout);
    };
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
    write("id_a", rows_of(a), {"1", "body a"});
    write("id_b", rows_of(b), {"1", "body b; -1 - row of /walls for a wall"});
    write("feature", rows_of(feature), {"1", "which surface or edge of the wall; 0 between bodies"});
    write("point", rows_of(point), {"m", "where they touch, at the middle of the step", "world"});
    write("normal", rows_of(normal), {"1", "unit normal from b to a", "world"});
    write("gap", rows_of(gap), {"m", "distance at the end of the step; negative: penetration"});
    write("impulse", rows_of(impulse), {"N s", "impulse on a in the step", "world"});
    write("force", rows_of(force), {"N", "mean force on a over the step", "world"});
    write("status", rows_of(status), {"1", "0 open, 1 sticking, 2 sliding"});
}

bool is_snapshot_name(const std::string& name) {
    return name.size() > 3 && name.ends_with(".h5") && name.find_first_not_of("0123456789") == name.size() - 3;
}

}  // namespace

void write_snapshot(const std::string& path, std::uint64_t number, const Scene& scene, const State& state,
                    const std::vector<ContactRecord>& contacts, const Provenance& provenance,
                    const Communicator& ranks) {
    AtomicFile out(path, ranks);
    SharedFile file(out.temporary(), 0, ranks);
    const Layout layout{.gzip = scene.output.compression};
    const Vec3 gravity = scene.gravity.at(state.time);
    file.by_root([&](const Hdf5Group& root) {
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
        if (!state.shapes.empty()) root.link("shapes", kShapesFile, "/shapes");
        if (has_terrain(scene)) root.link("terrain", kTerrainFile, "/terrain");
    });
    const bool shapes = !state.shapes.empty();
    const auto write = [&](const Bodies& bodies, bool spin, bool orientation) {
        write_bodies(file, scene, bodies, {spin, orientation, shapes}, layout);
        if (shapes && scene.output.mesh) write_body_mesh(file, bodies, state.shapes, scene.origin, layout);
    };
    if (ranks.alone()) {
        const Bodies& b = state.bodies;
        write(b, b.spin.size() == b.size(), b.orientation.size() == b.size());
    } else {
        const BodySlice slice = slice_bodies(state.bodies, kPackedRows, ranks);
        const bool none = ranks.all(slice.bodies.size() == 0);  // empty arrays are arrays of no bodies
        write(slice.bodies, slice.arrays.spin || none, slice.arrays.orientation || none);
    }
    if (scene.output.contacts) write_contacts(file, scene, slice_contacts(contacts, kPackedRows, ranks), layout);
    file.close();
    out.commit();
}

SnapshotSeries::SnapshotSeries(std::string run_folder, std::uint64_t first_number, const Communicator& ranks)
    : run_folder_(std::move(run_folder)), ranks_(ranks), xdmf_(run_folder_ + "/run.xdmf") {
    by_root(ranks_, [&] {
        const std::string folder = run_folder_ + "/" + kFolder;
        make_folder(folder);
        remove_leftovers(folder);
        list_again(first_number);
    });
}

void SnapshotSeries::list_again(std::uint64_t first_number) {
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

// What is the same in all snapshots.
void SnapshotSeries::write_constant(const Scene& scene, const State& state, const Provenance& provenance) const {
    const std::string folder = run_folder_ + "/" + kFolder + "/";
    if (!state.shapes.empty())
        write_shapes(folder + kShapesFile, state.shapes, provenance, scene.output.compression, ranks_);
    if (has_terrain(scene)) write_terrain(folder + kTerrainFile, scene, provenance, ranks_);
}

void SnapshotSeries::write(const Scene& scene, State& state, const std::vector<ContactRecord>& contacts,
                           const Provenance& provenance) {
    const std::string relative = fmt::format("{}/{:06}.h5", kFolder, state.snapshots_written);
    const std::string path = run_folder_ + "/" + relative;
    if (!std::exchange(constant_written_, true)) write_constant(scene, state, provenance);
    write_snapshot(path, state.snapshots_written, scene, state, contacts, provenance, ranks_);
    std::uint64_t size = 0;
    by_root(ranks_, [&] {
        xdmf_.add(path, relative);
        xdmf_.write();
        std::error_code code;
        const std::uintmax_t bytes = fs::file_size(path, code);
        if (!code) size = bytes;
    });
    bytes_ += ranks_.max(size);
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
