"""The ways of single bodies: trajectories.h5, or the positions in the snapshots."""
import numpy as np

from .runs import open_hdf5

CORNERS = 0.08  # of the straight runout, between corners of the way of the mass
FOLLOWED = 40  # bodies, where the run followed none


class Places:
    """Of all snapshots, one after the other so that no more than one is in memory: the middle of the bodies (medians),
    and where a few of them were."""

    def __init__(self, paths):
        self.middles, self.ways, chosen = [], {}, None
        for path in paths:
            with open_hdf5(path) as file:
                position = file["bodies/position"][...]
                ids = file["bodies/id"][...] if "bodies/id" in file else np.arange(len(position))
            if len(ids) == 0:
                continue
            self.middles.append(np.median(position[:, :2], axis=0))
            if chosen is None:
                chosen = ids[np.unique(np.linspace(0, len(ids) - 1, FOLLOWED).astype(int))]
            _, rows, _ = np.intersect1d(ids, chosen, return_indices=True)
            for row in rows:
                self.ways.setdefault(int(ids[row]), []).append(position[row])


def tracks_of(run, places):
    """The points (n, 3) of each body followed."""
    path = run / "trajectories.h5"
    if path.exists():
        with open_hdf5(path) as file:
            ways = [item[...] for name, item in file["history"].items() if name.endswith(".position")]
    else:
        ways = [np.array(way) for way in places.ways.values()]
    return [way[np.isfinite(way).all(axis=1)] for way in ways if len(way) > 1]


def way_of_the_mass(crest, toe, middles):
    """Corners of a line from the crest to the toe along the middle of the bodies."""
    corners, target = [np.asarray(crest[:2])], np.asarray(toe[:2])
    least = CORNERS * np.linalg.norm(target - corners[0])  # between corners
    for middle in middles:
        if np.linalg.norm(middle - corners[-1]) > least and np.linalg.norm(middle - target) > least:
            corners.append(middle)
    return [*corners, target]


class Line:
    """A line seen from above: straight pieces between corners (n, 2)."""

    def __init__(self, corners):
        self.corners = np.asarray(corners, dtype=float)
        pieces = np.diff(self.corners, axis=0)
        self.lengths = np.linalg.norm(pieces, axis=1)
        self.directions = pieces / self.lengths[:, None]
        self.starts = np.concatenate([[0.0], np.cumsum(self.lengths)])
        self.length = self.starts[-1]

    def place_of(self, points):
        """Distance along the line and from it, of points (n, 2); before its start and after its end it goes on."""
        along, beside = np.zeros(len(points)), np.full(len(points), np.inf)
        last = len(self.lengths) - 1
        for k, (start, direction) in enumerate(zip(self.corners, self.directions)):
            to = points - start
            s = np.clip(to @ direction, -np.inf if k == 0 else 0.0, np.inf if k == last else self.lengths[k])
            distance = np.linalg.norm(to - s[:, None] * direction, axis=1)
            nearer = distance < beside
            along[nearer], beside[nearer] = self.starts[k] + s[nearer], distance[nearer]
        return along, beside

    def at(self, along):
        """Points (n, 2) at distances along the line."""
        along = np.asarray(along, dtype=float)
        k = np.clip(np.searchsorted(self.starts, along, side="right") - 1, 0, len(self.lengths) - 1)
        return self.corners[k] + (along - self.starts[k])[:, None] * self.directions[k]
