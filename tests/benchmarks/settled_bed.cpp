#include "settled_bed.hpp"

#include "contact/candidate_list.hpp"
#include "contact/find_contacts.hpp"
#include "core/random.hpp"
#include "solvers/stepper.hpp"

namespace scree::benchmarks {
namespace {

constexpr double kStep = 1e-3, kPitch = 0.0072, kSide = 20 * kPitch + 0.001;
constexpr int kCells = 20, kSettlingSteps = 350;

void add_sphere(State& state, const Vec3& x, double radius, bool spin) {
    Bodies& b = state.bodies;
    b.id.push_back(BodyId{state.next_id++});
    b.radius.push_back(radius);
    b.mass.push_back(Bodies::sphere_mass(radius, 2500.0));
    b.material.push_back(MaterialIndex{0});
    b.position.push_back(x);
    b.velocity.emplace_back(Vec3::Zero());
    if (spin) b.spin.emplace_back(Vec3::Zero());
}

Scene box_scene(double friction) {
    Scene scene;
    scene.materials = {{"glass", 2500.0}};
    scene.pairs = PairTable(1);
    scene.pairs.set(MaterialIndex{0}, MaterialIndex{0}, {friction, 0.0});
    Wall box;
    box.name = "box";
    box.shape = BoxWall{Vec3::Zero(), Vec3(kSide, kSide, 1.0), true, true, false};
    scene.walls.push_back(box);
    scene.time.step = kStep;
    scene.time.end = 1.0;
    scene.solver.max_sweeps = 40;
    return scene;
}

}  // namespace

Bed settled_bed(int tiles, double friction) {
    Scene scene = box_scene(friction);
    State one;
    for (int k = 0; k < kCells * kCells * kCells; ++k) {
        Random random(1, 0, static_cast<std::uint64_t>(k));
        const double radius = random.uniform(2.7e-3, 3.3e-3);
        Vec3 x(k % kCells + 0.5, k / kCells % kCells + 0.5, k / kCells / kCells + 0.5);
        x = kPitch * x + Vec3(5e-4, 5e-4, 0.0);
        for (int d = 0; d < 3; ++d) x[d] += random.uniform(-2.5e-4, 2.5e-4);
        add_sphere(one, x, radius, friction > 0.0);
    }
    {
        const Plan plan = make_plan(scene, one.bodies);
        solvers::Stepper stepper(scene, plan);
        for (int k = 0; k < kSettlingSteps; ++k) stepper.advance(one);
    }
    Bed bed{scene, {}, {}};
    for (int ty = 0; ty < tiles; ++ty)
        for (int tx = 0; tx < tiles; ++tx)
            for (std::size_t i = 0; i < one.bodies.size(); ++i)
                add_sphere(bed.state, one.bodies.position[i] + Vec3(tx * kSide, ty * kSide, 0.0), one.bodies.radius[i],
                           friction > 0.0);
    bed.scene.walls[0].shape = BoxWall{Vec3::Zero(), Vec3(tiles * kSide, tiles * kSide, 1.0), true, true, false};
    bed.plan = make_plan(bed.scene, bed.state.bodies);
    return bed;
}

contact::ContactSet next_contacts(Bed& bed) {
    const contact::StepTimes times{0.0, bed.scene.time.step};
    for (std::size_t i = 0; i < bed.state.bodies.size(); ++i)
        bed.state.bodies.position[i] += 0.5 * times.step * bed.state.bodies.velocity[i];
    std::vector<double> margin;
    contact::contact_margins(bed.scene, bed.state, times, margin);
    contact::CandidateList candidates;
    candidates.update(bed.scene, bed.state, times.step, margin);
    contact::ContactSet contacts;
    contact::find_contacts(bed.scene, bed.state, times, candidates, Domain(), contacts);
    return contacts;
}

}  // namespace scree::benchmarks
