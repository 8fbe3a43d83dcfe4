// A plane: one-sided. A sphere however far behind it is still in contact, so nothing gets through.
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {

void plane_contacts(const PlaneWall& plane, const Probe& probe, WallContacts& out) {
    const double gap = (probe.centre - plane.point).dot(plane.normal) - probe.radius;
    if (gap <= probe.margin) out.add(plane.normal, gap, 0);
}

}  // namespace scree::contact::detail
