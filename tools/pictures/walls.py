"""Walls as lines: the edges of each shape, the contours that the eye sees of round ones, a grid on endless planes.

Parameters: io/wall_description.cpp, in the wall's own frame; a length that is null has no end. `bounds` (lower, upper)
[m] is the part of space that is drawn: endless surfaces end there.
"""
import numpy as np

SAMPLES = 160
CELLS = 8  # of the grid on a plane, along its longer side
GROWN = 0.02  # walls are drawn a little farther than the bounds, in diagonals: some lie on them


def lines_of(wall, bounds, camera):
    """[(points (n, 3) in the world, is an edge)]; points that are not drawn are NaN."""
    maker = MAKERS.get(wall.shape)
    if maker is None:
        return []
    grown = GROWN * np.linalg.norm(bounds[1] - bounds[0])
    lower, upper = bounds[0] - grown, bounds[1] + grown
    result = []
    for points, is_edge in maker(wall.parameters, Frame(wall, (lower, upper), camera)):
        world = wall.to_world(points)
        rounding = 1e-9 * grown
        outside = ((world < lower - rounding) | (world > upper + rounding)).any(axis=1)
        result.append((np.where(outside[:, None], np.nan, world), is_edge))
    return result


def extent_of(wall, reach):
    """Lowest and highest point of a wall that is bounded, at least across its axis; None of an endless one. Where it
    has no end: (inf, -inf), which widens nothing. `reach`: what is longer counts as endless."""
    p = wall.parameters
    if wall.shape == "box":
        low, high = np.asarray(p["lower"], float), np.asarray(p["upper"], float)
        points = np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)])
    elif wall.shape in ("cylinder", "cone"):
        radii = (p["radius"],) * 2 if wall.shape == "cylinder" else (p["radius_base"], p["radius_end"])
        base, axis = np.asarray(p["base"], float), unit(p["axis"])
        length = p.get("length")
        endless = length is None or not length <= reach
        end = base if endless else base + length * axis
        points = np.concatenate([circle(base, axis, radii[0]), circle(end, axis, radii[1])])
    elif wall.shape == "disc":
        points = circle(np.asarray(p["centre"], float), unit(p["normal"]), p["radius"])
    elif wall.shape == "terrain":
        points = np.array([p["lower"], p["upper"]], float)
    else:
        return None
    world = wall.to_world(points)
    low, high = world.min(axis=0), world.max(axis=0)
    if wall.shape == "cylinder" and endless:
        along = np.abs(wall.rotation @ axis) > 1e-6
        low, high = np.where(along, np.inf, low), np.where(along, -np.inf, high)
    return low, high


class Frame:
    """The bounds and the eye, seen from the wall's own frame."""

    def __init__(self, wall, bounds, camera):
        lower, upper = bounds
        corners = np.array([[(lower, upper)[i >> k & 1][k] for k in range(3)] for i in range(8)])
        self.corners = (corners - wall.translation) @ wall.rotation
        self.size = float(np.max(upper - lower))
        self.wall, self.camera = wall, camera

    def to_eye(self, local):
        return self.camera.direction_to_eye(self.wall.to_world(np.asarray(local)[None, :])[0]) @ self.wall.rotation


def unit(vector):
    vector = np.asarray(vector, dtype=float)
    return vector / np.linalg.norm(vector)


def across(normal):
    """Two unit vectors at right angles to `normal` and to each other; along the axes of space if possible."""
    start = np.eye(3)[int(np.argmin(np.abs(normal)))]
    first = unit(start - (start @ normal) * normal)
    return first, np.cross(normal, first)


def segment(a, b):
    return a + np.linspace(0.0, 1.0, SAMPLES)[:, None] * (np.asarray(b) - a)


def circle(centre, axis, radius):
    first, second = across(axis)
    angle = np.linspace(0.0, 2.0 * np.pi, 2 * SAMPLES)[:, None]
    return centre + radius * (np.cos(angle) * first + np.sin(angle) * second)


def box(p, frame):
    low, high = np.asarray(p["lower"], float), np.asarray(p["upper"], float)
    for axis in range(3):
        for i in range(4):
            a = low.copy()
            others = [k for k in range(3) if k != axis]
            for bit, k in enumerate(others):
                a[k] = (low, high)[i >> bit & 1][k]
            b = a.copy()
            b[axis] = high[axis]
            yield segment(a, b), True


def cylinder(p, frame):
    base, axis = np.asarray(p["base"], float), unit(p["axis"])
    length = p.get("length")
    if length is None or not np.isfinite(length):
        along = (frame.corners - base) @ axis
        base, length = base + along.min() * axis, along.max() - along.min()
    yield from surface_of_revolution(base, axis, length, p["radius"], p["radius"], frame)


def cone(p, frame):
    yield from surface_of_revolution(np.asarray(p["base"], float), unit(p["axis"]), p["length"], p["radius_base"],
                                     p["radius_end"], frame)


def surface_of_revolution(base, axis, length, radius_base, radius_end, frame):
    end = base + length * axis
    for centre, radius in ((base, radius_base), (end, radius_end)):
        if radius > 0.0:
            yield circle(centre, axis, radius), True
    # The contour is where the surface's normal, e(phi) + slope * axis, is at right angles to the line of sight.
    eye = frame.to_eye(0.5 * (base + end))
    slope = (radius_base - radius_end) / length
    first, second = across(axis)
    size = np.hypot(eye @ first, eye @ second)
    if size < 1e-9 or abs(slope * (eye @ axis)) > size:
        return
    middle, half = np.arctan2(eye @ second, eye @ first), np.arccos(-slope * (eye @ axis) / size)
    for phi in (middle - half, middle + half):
        e = np.cos(phi) * first + np.sin(phi) * second
        yield segment(base + radius_base * e, end + radius_end * e), True


def disc(p, frame):
    centre, normal = np.asarray(p["centre"], float), unit(p["normal"])
    yield circle(centre, normal, p["radius"]), True
    for direction in across(normal):
        yield segment(centre - p["radius"] * direction, centre + p["radius"] * direction), False


def border(point, normal, frame):
    """Corners, in order, of the piece of the plane inside the bounds; empty if the plane misses them."""
    height = (frame.corners - point) @ normal
    ends = [(i, i | 1 << k) for k in range(3) for i in range(8) if not i >> k & 1]  # the bounds' edges
    found = [frame.corners[i] + height[i] / (height[i] - height[j]) * (frame.corners[j] - frame.corners[i])
             for i, j in ends if (height[i] < 0.0) != (height[j] < 0.0)]
    if len(found) < 3:
        return np.zeros((0, 3))
    found = np.array(found)
    first, second = across(normal)
    middle = found - found.mean(axis=0)
    return found[np.argsort(np.arctan2(middle @ second, middle @ first))]


def grid(point, normal, frame, first=None, hole=None):
    """A plane inside the bounds: its border and a grid. hole(a, b): in the plane's coordinates about `point`, where
    there is nothing."""
    corners = border(point, normal, frame)
    if len(corners) == 0:
        return
    first = across(normal)[0] if first is None else first
    second = np.cross(normal, first)

    def to_plane(points):
        return (points - point) @ first, (points - point) @ second

    for i, corner in enumerate(corners):
        line = segment(corners[i - 1], corner)
        if hole is not None:
            line[hole(*to_plane(line))] = np.nan
        yield line, True
    a, b = to_plane(corners)
    pitch = max(np.ptp(a), np.ptp(b)) / CELLS
    for low, high, low_other, high_other, swap in ((a.min(), a.max(), b.min(), b.max(), False),
                                                   (b.min(), b.max(), a.min(), a.max(), True)):
        for c in np.arange(np.ceil(low / pitch), np.floor(high / pitch) + 1) * pitch:
            s = np.linspace(low_other, high_other, 3 * SAMPLES)
            u, v = (s, np.full_like(s, c)) if swap else (np.full_like(s, c), s)
            line = point + u[:, None] * first + v[:, None] * second
            if hole is not None:
                line[hole(u, v)] = np.nan
            yield line, False


def plane(p, frame):
    yield from grid(np.asarray(p["point"], float), unit(p["normal"]), frame)


def orifice_floor(p, frame):
    centre, normal, radius = np.asarray(p["centre"], float), unit(p["normal"]), p["hole_radius"]
    yield from grid(centre, normal, frame, hole=lambda u, v: u * u + v * v < radius * radius)
    yield circle(centre, normal, radius), True


def slot_floor(p, frame):
    centre, normal, width = np.asarray(p["centre"], float), unit(p["normal"]), p["width"]
    along = unit(p["along"])
    sideways = np.cross(normal, along)
    length = p.get("length")
    if length is None or not np.isfinite(length):
        length = 4.0 * frame.size
    yield from grid(centre, normal, frame, along, lambda u, v: (abs(u) < 0.5 * length) & (abs(v) < 0.5 * width))
    a, b = 0.5 * length * along, 0.5 * width * sideways
    for start, end in ((a + b, b - a), (b - a, -a - b), (-a - b, a - b), (a - b, a + b)):
        yield segment(centre + start, centre + end), True


MAKERS = {"plane": plane, "box": box, "cylinder": cylinder, "cone": cone, "disc": disc, "orifice_floor": orifice_floor,
          "slot_floor": slot_floor}
