// What stands and what falls, by theory, of the scenarios that are shipped: an arch on either side of its least
// thickness, a jointed slope on either side of its angle of friction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plan.hpp"
#include "io/scenario/scenario_reader.hpp"
#include "scenarios/build.hpp"
#include "solvers/energy.hpp"
#include "solvers/stepper.hpp"

namespace scree {
namespace {

class Shipped {
  public:
    Shipped(const std::string& name, const std::vector<std::string>& overrides) {
        const std::string folder = SCREE_SCENARIO_DIR;
        io::Diagnostics diagnostics;
        const io::ReadResult read = io::read_scenario(folder + "/" + name + ".yaml", overrides, diagnostics);
        EXPECT_EQ(diagnostics.report(), "");
        built_ = scenarios::build(read.root, folder, diagnostics);
        EXPECT_EQ(diagnostics.report(), "");
        plan_ = make_plan(built_.scene, built_.state.bodies);
        start_ = built_.state.bodies.position;
        solvers::start_ledger(built_.scene, built_.state);
        stepper_ = std::make_unique<solvers::Stepper>(built_.scene, plan_);
    }
    void run(double time) {
        while (built_.state.time < time * (1.0 - 1e-9)) stepper_->advance(built_.state);
    }
    double farthest_way() const {  // [m]
        double way = 0.0;
        for (std::size_t i = 0; i < start_.size(); ++i)
            way = std::max(way, (built_.state.bodies.position[i] - start_[i]).norm());
        return way;
    }
    const Bodies& bodies() const { return built_.state.bodies; }

  private:
    scenarios::Built built_;
    Plan plan_;
    std::vector<Vec3> start_;
    std::unique_ptr<solvers::Stepper> stepper_;
};

// The least thickness of a semicircle of 11 voussoirs with flat faces is 0.104589 of the radius, by linear programming
// over the lines of thrust.
TEST(Arch, StandsHalfAPercentAboveTheLeastThicknessAndFallsHalfAPercentBelow) {
    Shipped thick("arch", {"bodies[0].thickness=0.105112"}), thin("arch", {"bodies[0].thickness=0.104066"});
    thick.run(1.0);
    EXPECT_LT(thick.farthest_way(), 1e-6);
    thin.run(0.8);
    EXPECT_GT(thin.farthest_way(), 0.1);
}

// Friction 0.8 is more than tan 35 = 0.700, 0.6 is less: what slides freely does so with g (sin 35 - 0.6 cos 35).
TEST(JointedSlope, SlidesWhereFrictionIsLessThanTheDipOfItsPlanes) {
    Shipped stands("jointed_slope", {}), slides("jointed_slope", {"materials.rock.friction=0.6"});
    stands.run(0.3);
    EXPECT_LT(stands.farthest_way(), 1e-4);
    slides.run(0.3);
    const double dip = 35.0 * M_PI / 180.0, expected = 9.81 * (std::sin(dip) - 0.6 * std::cos(dip));
    const Vec3 down(std::cos(dip), 0.0, -std::sin(dip));
    std::size_t free = 0;
    for (const Vec3& v : slides.bodies().velocity) free += std::abs(v.dot(down) / 0.3 / expected - 1.0) < 0.01 ? 1 : 0;
    EXPECT_GT(free, 15U);  // of 170; others are held back by those beneath, or fall off the face
}

}  // namespace
}  // namespace scree
