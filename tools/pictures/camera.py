"""Where the eye is. Camera coordinates: x to the right, y upwards, z towards the eye, in metres from the target."""
import numpy as np

from .errors import PictureError

# azimuth and elevation [degrees] of the eye; azimuth 0 looks along +y (x to the right), 90 looks along -x
NAMED = {"front": (0.0, 0.0), "side": (90.0, 0.0), "top": (0.0, 90.0), "perspective": (30.0, 22.0)}
PARALLEL = ("front", "side", "top")


def parse_view(text):
    """(azimuth, elevation, is parallel) of a view's name or of two angles "30,20"."""
    if text in NAMED:
        return (*NAMED[text], text in PARALLEL)
    try:
        azimuth, elevation = (float(part) for part in text.split(","))
        if np.isfinite([azimuth, elevation]).all() and abs(elevation) <= 90.0:
            return azimuth, elevation, False
    except ValueError:
        pass
    raise PictureError(f"no view '{text}': one of {', '.join(NAMED)}, or AZIMUTH,ELEVATION in degrees with the "
                       "elevation from -90 to 90", code=2)


def axes_of(azimuth, elevation):
    """Rows: right, up, towards the eye."""
    a, e = np.radians([azimuth, elevation])
    right = np.array([np.cos(a), np.sin(a), 0.0])
    horizontal = np.array([np.sin(a), -np.cos(a), 0.0])  # from the target to the eye, in the ground plane
    toward = np.cos(e) * horizontal + np.sin(e) * np.array([0.0, 0.0, 1.0])
    return np.array([right, np.cross(toward, right), toward])


class Camera:
    """Fits the box lower..upper [m] into pictures of at most `pixels` on the longer side."""

    DISTANCE = 2.2  # of the eye from the target, in diagonals of the box (perspective views)

    def __init__(self, view, lower, upper, pixels):
        azimuth, elevation, parallel = parse_view(view)
        self.parallel = parallel
        self.axes = axes_of(azimuth, elevation)
        self.target = 0.5 * (lower + upper)
        self.distance = None if parallel else self.DISTANCE * float(np.linalg.norm(upper - lower))
        corners = np.array([[(lower, upper)[i >> k & 1][k] for k in range(3)] for i in range(8)])
        local = (corners - self.target) @ self.axes.T
        flat = local[:, :2] * self.magnification(local[:, 2])[:, None]
        low, high = flat.min(axis=0), flat.max(axis=0)
        margin = 0.03 * (high - low).max()
        size = high - low + 2.0 * margin
        size = np.maximum(size, 0.3 * size.max())  # no slivers
        self.pixels_per_metre = pixels / size.max()
        self.width, self.height = (int(n) for n in np.ceil(size * self.pixels_per_metre))
        self.centre = 0.5 * (low + high)

    def magnification(self, z):
        """Size of things at depth z over their size at the target."""
        return np.ones_like(z) if self.distance is None else self.distance / (self.distance - z)

    def project(self, points):
        """Pixel coordinates (x to the right, y downwards), depth [m], pixels per metre there."""
        local = (np.asarray(points) - self.target) @ self.axes.T
        scale = self.pixels_per_metre * self.magnification(local[:, 2])
        x = 0.5 * self.width + scale * local[:, 0] - self.pixels_per_metre * self.centre[0]
        y = 0.5 * self.height - scale * local[:, 1] + self.pixels_per_metre * self.centre[1]
        return x, y, local[:, 2], scale

    def directions_to_eye(self, points):
        """Vectors in the world from `points` (n, 3) to the eye, of any length."""
        if self.distance is None:
            return np.broadcast_to(self.axes[2], np.shape(points))
        return self.target + self.distance * self.axes[2] - points

    def direction_to_eye(self, point):
        """Unit vector in the world from `point` to the eye."""
        if self.distance is None:
            return self.axes[2]
        vector = self.target + self.distance * self.axes[2] - point
        return vector / np.linalg.norm(vector)
