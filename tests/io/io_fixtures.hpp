// For the tests of files: a folder that goes away, a small scene, states of any numbers.
#pragma once

#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/contact_record.hpp"
#include "core/random.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/results/provenance.hpp"

namespace scree::io::testing {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "scree-io-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) std::abort();
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code code;
        std::filesystem::remove_all(path_, code);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

inline Scene sample_scene() {
    Scene scene;
    scene.title = "grains in a box – \"quoted\" & <odd>";
    scene.origin = Vec3(100.0, 200.0, 300.0);
    scene.materials = {{"glass", 2500.0}, {"steel", 7800.0}};
    scene.pairs = PairTable(2);
    Wall plane;
    plane.name = "floor";
    plane.shape = PlaneWall{Vec3::Zero(), Vec3::UnitZ()};
    Wall drum;
    drum.name = "drum";
    drum.material = MaterialIndex{1};
    drum.shape = CylinderWall{Vec3::Zero(), Vec3::UnitY(), 0.5, kForever, true};
    drum.motion.axis = Vec3::UnitY();
    drum.motion.rate = 1.0;
    drum.goes = 0.5;
    scene.walls = {plane, drum};
    scene.inlets.resize(1);
    scene.inlets[0].name = "hose";
    scene.outlets.resize(1);
    scene.outlets[0].name = "hole";
    scene.output.fields = {"velocity", "spin", "material", "mass", "orientation"};
    scene.output.contacts = true;
    return scene;
}

// Any finite number: all exponents, denormals, both zeros.
inline double any_number(Random& random) {
    switch (random.bits() % 8) {
        case 0:
            return -0.0;
        case 1:
            return std::bit_cast<double>(random.bits() & 0x800fffffffffffffULL);  // denormal
        default:
            break;
    }
    const double x = std::bit_cast<double>(random.bits());
    return std::isfinite(x) ? x : 1.0;
}
inline Vec3 any_vector(Random& random) {
    const double x = any_number(random), y = any_number(random), z = any_number(random);
    return {x, y, z};
}

inline State random_state(std::uint64_t seed, std::size_t bodies, bool spins, bool orientations) {
    Random r(seed, 0, 0);
    State s;
    s.time = any_number(r);
    s.step = r.bits() >> 34;
    s.next_id = r.bits();
    s.block_size = any_number(r);
    for (std::size_t i = 0; i < bodies; ++i) {
        s.bodies.id.push_back(BodyId{10 * i + r.bits() % 10});
        s.bodies.radius.push_back(any_number(r));
        s.bodies.mass.push_back(any_number(r));
        s.bodies.material.push_back(MaterialIndex{static_cast<std::uint16_t>(r.bits() % 2)});
        s.bodies.position.push_back(any_vector(r));
        s.bodies.velocity.push_back(any_vector(r));
        if (spins) s.bodies.spin.push_back(any_vector(r));
        if (orientations) s.bodies.orientation.emplace_back(any_number(r), any_number(r), any_number(r), any_number(r));
        s.warm_start.key.push_back(i % 2 == 0 ? ContactKey{i, i + 1, 0} : ContactKey::wall(BodyId{i}, WallIndex{1}, 7));
        if (spins) s.warm_start.impulse_vector.push_back(any_vector(r));
        if (!spins) s.warm_start.impulse_normal.push_back(any_number(r));
    }
    s.warm_start.step = any_number(r);
    s.inlets = {{r.bits(), r.bits(), any_number(r)}};
    s.outlets = {{r.bits(), any_number(r)}};
    s.measures.resize(3);
    for (std::size_t i = 0; i < s.measures.size(); ++i) {
        MeasureState& m = s.measures[i];
        m = {any_number(r), any_number(r), any_number(r), any_number(r), any_number(r), any_number(r), {}};
        for (std::size_t k = 0; k < 2 * i; ++k) m.window_sum.push_back(any_number(r));
    }
    s.followed = {r.bits() >> 1, r.bits()};
    s.trajectory_rows = r.bits();
    s.rasters.columns = 3;
    for (auto* values : {&s.rasters.depth, &s.rasters.height, &s.rasters.speed, &s.rasters.arrival})
        for (int k = 0; k < 21; ++k) values->push_back(k == 0 ? RasterState::kNever : any_number(r));
    s.rasters.volume = any_number(r);
    s.rasters.centre = any_vector(r);
    s.rasters.top = any_vector(r);
    s.ledger.kinetic_0 = any_number(r);
    s.ledger.potential_0 = any_number(r);
    s.ledger.kinetic = any_number(r);
    s.ledger.potential = any_number(r);
    for (double& w : s.ledger.work) w = any_number(r);
    s.ledger.kinetic_max = any_number(r);
    s.ledger.potential_min = any_number(r);
    s.ledger.potential_max = any_number(r);
    s.ledger.gained = any_number(r);
    RunTotals& t = s.totals;
    for (std::uint64_t* n : {&t.steps, &t.substepped, &t.steps_not_converged, &t.sweeps, &t.contact_updates,
                             &t.steps_with_contacts, &s.snapshots_written, &s.history_rows}) {
        *n = r.bits();
    }
    t.sweeps_max = static_cast<int>(r.bits() % 1000);
    for (double* x : {&t.residual_sum, &t.residual_max, &t.penetration_max, &t.penetration_max_relative,
                      &t.penetration_mean_sum, &t.penetration_mean_relative_sum, &t.momentum_error_max, &t.wall_time}) {
        *x = any_number(r);
    }
    for (double& w : t.wall_by_phase) w = any_number(r);
    return s;
}

// Numbers of an ordinary run.
inline State sample_state(std::size_t bodies) {
    State s;
    s.time = 0.25;
    s.step = 250;
    for (std::size_t i = 0; i < bodies; ++i) {
        const double x = static_cast<double>(i);
        s.bodies.id.push_back(BodyId{2 * i});
        s.bodies.radius.push_back(0.003);
        s.bodies.mass.push_back(2.8e-4);
        s.bodies.material.push_back(MaterialIndex{static_cast<std::uint16_t>(i % 2)});
        s.bodies.position.emplace_back(x, 2.0 * x, 0.5);
        s.bodies.velocity.emplace_back(0.0, 0.0, -x);
        s.bodies.spin.emplace_back(x, 0.0, 0.0);
        s.bodies.orientation.emplace_back(1.0, 0.0, 0.0, 0.0);
    }
    s.inlets.resize(1);
    s.outlets = {{3, 0.75}};
    return s;
}

inline std::vector<ContactRecord> sample_contacts() {
    ContactRecord pair{ContactKey::bodies(BodyId{0}, BodyId{2}),
                       Vec3(1, 2, 3),
                       Vec3::UnitX(),
                       -1e-6,
                       Vec3(4, 0, 0),
                       0.5,
                       ContactStatus::sliding};
    ContactRecord wall{ContactKey::wall(BodyId{2}, WallIndex{1}, 3),
                       Vec3(0, 0, 0),
                       Vec3::UnitZ(),
                       1e-6,
                       Vec3(0, 0, 2),
                       0.5,
                       ContactStatus::sticking};
    return {pair, wall};
}

inline Provenance sample_provenance() {
    return make_provenance({"box.yaml", "title: box\n", "title: box\nseed: 1\n", "scree run box.yaml", 42, 1});
}

}  // namespace scree::io::testing
