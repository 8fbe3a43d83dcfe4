// A thin disc, two-sided: its face, or its rim beyond its radius. A centre exactly in its plane is on the normal's
// side. One place, feature 0.
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {

void disc_contacts(const DiscWall& disc, const Probe& probe, WallContacts& out) {
    const AxialFrame at(probe.centre, disc.centre, disc.normal);
    if (std::max(std::abs(at.height), at.distance - disc.radius) - probe.radius > probe.margin) return;
    if (at.distance <= disc.radius) {
        const double gap = std::abs(at.height) - probe.radius;
        out.add(at.height < 0.0 ? Vec3(-disc.normal) : disc.normal, gap, 0);
        return;
    }
    add_point((at.distance - disc.radius) * at.outward(disc.normal) + at.height * disc.normal, disc.normal, probe, 0,
              out);
}

}  // namespace scree::contact::detail
