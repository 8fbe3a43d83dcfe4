"""One snapshot: bodies, the fields that can colour them, the walls and the ground. Layout: io/results/snapshot.hpp."""
import json
import pathlib

import numpy as np

from .errors import PictureError
from .ground import Ground
from .polyhedra import Shapes
from .runs import open_hdf5, text_of


class Wall:
    """A wall that is present; a point of it is at rotation @ local + translation."""

    def __init__(self, name, shape, parameters, rotation, translation, row=0):
        self.row, self.name, self.shape, self.parameters = row, name, shape, parameters
        self.rotation, self.translation = rotation, translation

    def to_world(self, local):
        return np.asarray(local) @ self.rotation.T + self.translation


class Field:
    """Numbers to colour bodies with. `signed`: the sign matters, so that zero sits in the middle of the colours;
    `names`: what the whole numbers stand for (materials)."""

    def __init__(self, name, values, unit, label, signed=False, names=None):
        self.name, self.values, self.unit, self.label = name, values, unit, label
        self.signed, self.names = signed, names


# name of a field -> (dataset, component or "norm", label, signed)
FIELDS = {
    "speed": ("velocity", "norm", "speed", False),
    "velocity_x": ("velocity", 0, "velocity along x", True),
    "velocity_y": ("velocity", 1, "velocity along y", True),
    "velocity_z": ("velocity", 2, "velocity along z", True),
    "spin": ("spin", "norm", "spin", False),
    "spin_x": ("spin", 0, "spin about x", True),
    "spin_y": ("spin", 1, "spin about y", True),
    "spin_z": ("spin", 2, "spin about z", True),
    "radius": ("radius", None, "radius", False),
    "mass": ("mass", None, "mass", False),
    "material": ("material", None, "material", False),
    "id": ("id", None, "id", False),
    "x": ("position", 0, "x", False),
    "y": ("position", 1, "y", False),
    "z": ("position", 2, "z", False),
}


class Snapshot:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        with open_hdf5(path) as file:
            if "bodies" not in file or "position" not in file["bodies"] or "radius" not in file["bodies"]:
                raise PictureError(f"{path} has no /bodies/position and /bodies/radius: it is no snapshot")
            self.bodies = {name: item[...] for name, item in file["bodies"].items()}
            self.units = {name: text_of(item.attrs.get("unit", "")) for name, item in file["bodies"].items()}
            self.time = float(file.attrs.get("time", np.nan))
            self.title = text_of(file.attrs.get("title", ""))
            self.materials = []
            if "materials" in file and "name" in file["materials"]:
                self.materials = [text_of(name) for name in file["materials/name"][...]]
            self.walls = read_walls(file["walls"], path) if "walls" in file else []
            self.shapes = Shapes(linked(file, "shapes", path)) if "shape" in self.bodies else None
            self.grounds = read_grounds(file, self.walls, path)
        self.position = np.asarray(self.bodies["position"], dtype=float).reshape(-1, 3)
        self.radius = np.asarray(self.bodies["radius"], dtype=float)
        self.shape = np.asarray(self.bodies.get("shape", np.full(len(self.radius), -1)), dtype=int)
        self.is_sphere = self.shape < 0
        self.orientation = np.asarray(self.bodies.get("orientation", np.zeros((0, 4))), dtype=float)

    def available_fields(self):
        return [name for name, (dataset, *_) in FIELDS.items() if dataset in self.bodies]

    def field(self, name):
        available = self.available_fields()
        if name not in available:
            hint = ""
            if name in FIELDS:
                hint = f"; '{FIELDS[name][0]}' was not written: add it to output.fields of the scenario"
            raise PictureError(f"{self.path} has no field '{name}'{hint}. There are: {', '.join(available)}", code=2)
        dataset, component, label, signed = FIELDS[name]
        values = np.asarray(self.bodies[dataset], dtype=float)
        if component == "norm":
            values = np.linalg.norm(values.reshape(-1, 3), axis=1)
        elif component is not None:
            values = values.reshape(-1, 3)[:, component]
        names = self.materials if name == "material" and self.materials else None
        return Field(name, values, self.units.get(dataset, ""), label, signed, names)


def linked(file, name, path):
    """A group that lies in a file of its own beside the snapshots."""
    try:
        return file[name]
    except KeyError as error:
        raise PictureError(f"{path} needs {name}.h5 beside it, which is not there") from error


def read_grounds(file, walls, path):
    """One for each terrain wall that is present."""
    return [Ground(linked(file, "terrain", path)[str(wall.row)]) for wall in walls if wall.shape == "terrain"]


def read_walls(group, path):
    """The walls that are present at the snapshot's time."""
    try:
        count = len(group["name"])
        present = group["present"][...].astype(bool) if "present" in group else np.ones(count, dtype=bool)
        return [Wall(text_of(group["name"][i]), text_of(group["shape"][i]), json.loads(text_of(group["parameters"][i])),
                     np.asarray(group["rotation"][i], dtype=float).reshape(3, 3),
                     np.asarray(group["translation"][i], dtype=float), i)
                for i in range(count) if present[i]]
    except (KeyError, ValueError) as error:
        raise PictureError(f"{path}: the walls cannot be read ({error})") from error
