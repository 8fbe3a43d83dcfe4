"""What all pictures of a run have in common: the part of space that they show and the range of the colours. Goes over
the snapshots one at a time."""
import numpy as np

from .errors import PictureError
from .snapshots import Snapshot
from .walls import extent_of

WHOLE, PIECE = 1.6, 0.35  # sizes of walls over that of all bodies: shown whole up to, else so much beyond the bodies
FROM_ZERO = ("speed", "spin")  # fields whose colours start at zero


def over_ground(snapshot):
    """Which bodies to show: over terrain, none that fell off its edge. What is not finite counts as shown."""
    grounds = [extent_of(wall, np.inf) for wall in snapshot.walls if wall.shape == "terrain"]
    if not grounds:
        return np.ones(len(snapshot.radius), dtype=bool)
    low, high = np.min([g[0] for g in grounds], axis=0), np.max([g[1] for g in grounds], axis=0)
    x = snapshot.position
    beside = ((x[:, :2] < low[:2]) | (x[:, :2] > high[:2])).any(axis=1)
    return ~(beside | (x[:, 2] < low[2] - 10.0 * snapshot.radius))


class Survey:
    def __init__(self, paths, name):
        """`name`: the field, None for the speed (the radius where no velocities were written)."""
        self.lower, self.upper = np.full(3, np.inf), np.full(3, -np.inf)
        self.low, self.high = np.inf, -np.inf
        self.field_name = name
        walls = {}
        for path in paths:
            snapshot = Snapshot(path)
            if self.field_name is None:
                self.field_name = "speed" if "speed" in snapshot.available_fields() else "radius"
            field = snapshot.field(self.field_name)
            shown = over_ground(snapshot)
            self.take_bodies(snapshot.position[shown], snapshot.radius[shown], path)
            self.take_values(field, field.values[shown], snapshot.radius[shown])
            for wall in snapshot.walls:
                walls.setdefault((wall.name, wall.rotation.tobytes(), wall.translation.tobytes()), wall)
        self.take_walls(walls.values())
        self.finish(field)

    def take_bodies(self, position, radius, path):
        if len(radius) == 0:
            return
        if not np.isfinite(position).all():
            raise PictureError(f"{path} has positions that are not finite")
        low, high = position - radius[:, None], position + radius[:, None]
        lowest, highest = low.min(axis=0), high.max(axis=0)
        if len(radius) > 1000:
            # A few bodies that rolled far away must not make the others small.
            most = np.percentile(low, 0.2, axis=0), np.percentile(high, 99.8, axis=0)
            slack = 0.2 * (most[1] - most[0])
            lowest, highest = np.maximum(lowest, most[0] - slack), np.minimum(highest, most[1] + slack)
        self.lower, self.upper = np.minimum(self.lower, lowest), np.maximum(self.upper, highest)

    def take_values(self, field, values, radius):
        """All but the largest half percent, so that one fast body does not make the rest dark."""
        values = values[np.isfinite(values)]
        if len(values) == 0:
            return
        if field.signed:
            high = float(np.percentile(abs(values), 99.5))
            self.low, self.high = min(self.low, -high), max(self.high, high)
        elif field.name in FROM_ZERO:
            # what is at rest has no colours of its own: 1e-6 of the speed of falling through a radius
            size = float(np.median(radius))
            least = 1e-6 * (2.0 * 9.81 * size) ** 0.5 / (size if field.name == "spin" else 1.0)
            self.low, self.high = 0.0, max(self.high, least, float(np.percentile(values, 99.5)))
        else:
            self.low, self.high = min(self.low, float(values.min())), max(self.high, float(values.max()))

    def take_walls(self, walls):
        """Bounded walls are shown whole; of those much larger than what the bodies reach, a piece."""
        any_body = bool(np.isfinite(self.lower).all())
        lower, upper = self.lower, self.upper
        size = float(np.max(upper - lower)) if any_body else np.inf
        for low, high in filter(None, (extent_of(wall, 4.0 * size) for wall in walls)):
            if any_body and np.max(high - low) > WHOLE * size:
                low, high = np.maximum(low, lower - PIECE * size), np.minimum(high, upper + PIECE * size)
            self.lower, self.upper = np.minimum(self.lower, low), np.maximum(self.upper, high)

    def finish(self, field):
        if not np.isfinite(self.lower).all():  # no bodies and nothing but endless walls
            self.lower, self.upper = np.full(3, -0.5), np.full(3, 0.5)
        least = 0.05 * max(float(np.max(self.upper - self.lower)), 1e-12)  # a thickness for flat scenes
        thin = self.upper - self.lower < least
        self.lower, self.upper = np.where(thin, self.lower - 0.5 * least, self.lower), np.where(
            thin, self.upper + 0.5 * least, self.upper)
        if not self.low <= self.high:  # no values
            self.low, self.high = 0.0, 1.0
        if field.signed and self.high == 0.0:
            self.low, self.high = -1.0, 1.0
