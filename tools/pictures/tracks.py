"""The ways of single bodies: trajectories.h5, or the positions in the snapshots."""
import numpy as np

from .runs import open_hdf5

CORNERS = 0.08  # of the straight runout, between corners of the way of the mass
FOLLOWED = 40  # bodies, where the run followed none


def tracks_of(run, snapshots):
    """[(points (n, 3))] of each body followed."""
    path = run / "trajectories.h5"
    if path.exists():
        with open_hdf5(path) as file:
            ways = [item[...] for name, item in file["history"].items() if name.endswith(".position")]
    else:
        ids = snapshots[0].bodies.get("id", np.arange(len(snapshots[0].radius)))
        chosen = ids[np.linspace(0, len(ids) - 1, min(FOLLOWED, len(ids))).astype(int)] if len(ids) else []
        places = [dict(zip(s.bodies["id"].tolist(), s.position)) for s in snapshots if "id" in s.bodies]
        ways = [np.array([place[i] for place in places if i in place]) for i in chosen]
    return [way[np.isfinite(way).all(axis=1)] for way in ways if len(way) > 1]


def way_of_the_mass(crest, toe, snapshots):
    """Corners of a line from the crest to the toe along the middle of the bodies (medians) at the snapshots."""
    corners, target = [np.asarray(crest[:2])], np.asarray(toe[:2])
    least = CORNERS * np.linalg.norm(target - corners[0])  # between corners
    for snapshot in snapshots:
        middle = np.median(snapshot.position[:, :2], axis=0) if len(snapshot.radius) else target
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
