"""The rasters of a run (io/results/raster_files.hpp), or what its snapshots give of them where it kept none."""
import numpy as np

from .errors import PictureError
from .runs import open_hdf5

CELLS = 120  # along the longer side, of a run without rasters and without a grid of heights


class Raster:
    """Values (rows, columns) on cells: `x` (columns + 1) and `y` (rows + 1) are their borders."""

    def __init__(self, x, y, values, unit, label):
        self.x, self.y, self.values, self.unit, self.label = x, y, values, unit, label

    @property
    def area(self):
        return (self.x[1] - self.x[0]) * (self.y[1] - self.y[0])

    def centres(self):
        return 0.5 * (self.x[1:] + self.x[:-1]), 0.5 * (self.y[1:] + self.y[:-1])


LABELS = {"deposit": "deposit", "flow_depth_max": "largest flow depth", "flow_height_max": "largest flow height",
          "speed_max": "largest speed", "arrival_time": "arrival"}


class Rasters:
    """What rasters.h5 holds, by name; `solid_fraction`: bodies over bodies and pores."""

    def __init__(self, run):
        self.rasters, self.solid_fraction, self.covered = {}, 1.0, 0.0
        path = run / "rasters" / "rasters.h5"
        if not path.exists():
            return
        with open_hdf5(path) as file:
            group = file["rasters"]
            self.solid_fraction, self.covered = float(group.attrs["solid_fraction"]), float(group.attrs["covered"])
            for name, item in group.items():
                rows, columns = item.shape
                x = group.attrs["x"] + group.attrs["dx"] * np.arange(columns + 1)
                y = group.attrs["y"] + group.attrs["dy"] * np.arange(rows + 1)
                unit = item.attrs["unit"]
                self.rasters[name] = Raster(x, y, item[...], unit, LABELS.get(name, name))

    def __contains__(self, name):
        return name in self.rasters

    def __getitem__(self, name):
        if name not in self.rasters:
            there = ", ".join(sorted(self.rasters)) or "none: the scenario has no `rasters`"
            raise PictureError(f"no raster '{name}'; there are: {there}", code=2)
        return self.rasters[name]


def volumes(snapshot):
    """Of the bodies [m3]."""
    spheres = 4.0 / 3.0 * np.pi * snapshot.radius ** 3
    return spheres if snapshot.shapes is None else np.where(snapshot.is_sphere, spheres,
                                                            snapshot.shapes.volume[snapshot.shape])


def cells_about(ground, lower, upper, radius):
    """Borders of cells: about the nodes of the ground, or square ones over a rectangle, not smaller than bodies."""
    if ground is not None and ground.height is not None:
        return tuple(np.concatenate([nodes, [2 * nodes[-1] - nodes[-2]]]) - 0.5 * (nodes[1] - nodes[0])
                     for nodes in (ground.x, ground.y))
    size = max(upper[0] - lower[0], upper[1] - lower[1], 1e-9) / CELLS
    size = max(size, 4.0 * float(np.median(radius)))
    return tuple(np.arange(lower[k], upper[k] + size, size) for k in (0, 1))


def depth_of(snapshot, x, y, solid_fraction):
    """Flow depth of a snapshot on cells, bodies counted where their centre is."""
    depth, _, _ = np.histogram2d(snapshot.position[:, 1], snapshot.position[:, 0], bins=(y, x),
                                 weights=volumes(snapshot))
    return Raster(x, y, depth / ((x[1] - x[0]) * (y[1] - y[0]) * solid_fraction), "m", "flow depth")
