// The contact problem of a small scene's next step, put together as the time step does, with its parts at hand.
#pragma once

#include "contact/candidate_list.hpp"
#include "contact/find_contacts.hpp"
#include "solvers/contact_problem.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::testing {

// Contacts of the bodies as they stand (taken for the middle of the step).
inline contact::ContactSet contacts_of(const SmallScene& w) {
    const contact::StepTimes times{w.state.time, w.scene.time.step};
    std::vector<double> margin;
    contact::contact_margins(w.scene, w.state, times, margin);
    contact::CandidateList candidates;
    candidates.update(w.scene, w.state, times.step, margin);
    contact::ContactSet contacts;
    contact::find_contacts(w.scene, w.state, times, candidates, Domain(), contacts);
    return contacts;
}

template <class Law>
struct SolverCase {
    contact::ContactSet contacts;
    solvers::Layout layout;
    solvers::ContactProblem<Law> problem;
    Vec3 dv_free;
    std::vector<Vec3> wall_velocity;

    // Frictional laws need w.state.bodies.spin. `walls_move`: every wall contact's wall has this velocity.
    explicit SolverCase(const SmallScene& w, const Vec3& walls_move = Vec3::Zero()) : contacts(contacts_of(w)) {
        const double h = w.scene.time.step;
        dv_free = h * w.scene.gravity.at(w.state.time + 0.5 * h);
        layout.arrange(contacts, w.state.bodies, solvers::choose_block_size(w.state.bodies));
        for (const contact::Contact& c : contacts)
            wall_velocity.push_back(c.key.is_wall() ? walls_move : Vec3(Vec3::Zero()));
        problem.assemble(contacts, layout, w.state, dv_free, wall_velocity);
        problem.scale(dv_free.norm());
    }
    SolverCase(SolverCase&&) = delete;  // the problem refers to the layout

    Vec3 velocity(std::size_t body) const {
        const auto& line = problem.line_of(body);
        return {line.v[0], line.v[1], line.v[2]};
    }
};

}  // namespace scree::testing
