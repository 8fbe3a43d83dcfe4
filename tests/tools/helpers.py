"""Small synthetic runs in the layout that io/snapshot.cpp and io/history.cpp write, and ways to look at pictures."""
import json
import os
import pathlib
import subprocess
import sys

import h5py
import matplotlib.image
import numpy as np

ROOT = pathlib.Path(os.environ.get("SCREE_ROOT", pathlib.Path(__file__).resolve().parents[2]))
TOOLS = ROOT / "tools"
PYTHON = "/usr/bin/python3"
sys.path.insert(0, str(TOOLS))

WALLS = [
    ("ground", "plane", {"point": [0, 0, -0.05], "normal": [0, 0, 1]}),
    ("silo", "box", {"lower": [-0.05, -0.05, 0], "upper": [0.05, 0.05, 0.1], "inside": True, "open_top": True,
                     "open_bottom": True}),
    ("pipe", "cylinder", {"base": [0, 0, 0], "axis": [0, 0, 1], "radius": 0.05, "length": None, "inside": True}),
    ("hopper", "cone", {"base": [0, 0, 0], "axis": [0, 0, 1], "radius_base": 0.02, "radius_end": 0.05, "length": 0.05,
                        "inside": True}),
    ("plug", "disc", {"centre": [0, 0, 0], "normal": [0, 0, 1], "radius": 0.02}),
    ("floor", "orifice_floor", {"centre": [0, 0, 0], "normal": [0, 0, 1], "hole_radius": 0.02}),
    ("slot", "slot_floor", {"centre": [0, 0, -0.02], "normal": [0, 0, 1], "along": [1, 0, 0], "width": 0.01,
                            "length": None}),
]


def write_snapshot(path, number=0, time=0.0, position=None, radius=None, fields=None, walls=WALLS, present=None):
    if position is None:
        grid = np.linspace(-0.04, 0.04, 6)
        position = np.stack(np.meshgrid(grid, grid, grid + 0.05), axis=-1).reshape(-1, 3)
    position = np.asarray(position, dtype=float).reshape(-1, 3)
    count = len(position)
    radius = np.full(count, 0.006) if radius is None else np.asarray(radius, dtype=float)
    if fields is None:
        fields = {"velocity": (np.outer(np.arange(count) / max(count, 1), [0.0, 0.0, -1.0]), "m/s")}
    text = h5py.string_dtype()
    path.parent.mkdir(parents=True, exist_ok=True)
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "scree snapshot", "number": number, "time": time, "title": "Synthetic"})
        data = {"id": (np.arange(count), "1"), "position": (position, "m"), "radius": (radius, "m"), **fields}
        for name, (values, unit) in data.items():
            file[f"bodies/{name}"] = values
            file[f"bodies/{name}"].attrs["unit"] = unit
        file["materials/name"] = np.array(["glass", "steel"], dtype=text)
        group = file.create_group("walls")
        group.create_dataset("name", data=np.array([wall[0] for wall in walls], dtype=text))
        group.create_dataset("shape", data=np.array([wall[1] for wall in walls], dtype=text))
        group.create_dataset("parameters", data=np.array([json.dumps(wall[2]) for wall in walls], dtype=text))
        group.create_dataset("present", data=np.array([1] * len(walls) if present is None else present, dtype="u1"))
        group.create_dataset("rotation", data=np.tile(np.eye(3), (len(walls), 1, 1)))
        group.create_dataset("translation", data=np.zeros((len(walls), 3)))


def write_cubes(path, position, quaternion=None, side=0.02):
    """A snapshot of cubes, the last one of the bodies a sphere."""
    position = np.asarray(position, dtype=float)
    count = len(position)
    quaternion = np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)) if quaternion is None else np.asarray(quaternion, float)
    shape = np.zeros(count, dtype="i4")
    shape[-1] = -1
    write_snapshot(path, position=position, radius=np.full(count, 0.5 * side), walls=[],
                   fields={"velocity": (position - position.mean(axis=0), "m/s"), "shape": (shape, "1"),
                           "orientation": (quaternion, "1")})
    corner = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]) * 0.5 * side
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    normal = [[0, 0, -1], [0, 0, 1], [0, -1, 0], [0, 1, 0], [-1, 0, 0], [1, 0, 0]]
    with h5py.File(path, "a") as file:
        for name, values in {"vertices": [8], "faces": [6], "corners": [24], "vertex": corner,
                             "face_normal": np.array(normal, float), "sides": [4] * 6, "corner": np.ravel(faces),
                             "volume": [side ** 3]}.items():
            file[f"shapes/{name}"] = np.asarray(values)


def add_terrain(path, height, x=0.0, y=0.0, spacing=1.0):
    """Puts a grid of heights under a snapshot without walls."""
    height = np.asarray(height, dtype=float)
    far = [x + spacing * (height.shape[1] - 1), y + spacing * (height.shape[0] - 1), float(np.nanmax(height))]
    text = h5py.string_dtype()
    with h5py.File(path, "a") as file:
        del file["walls"]
        walls = file.create_group("walls")
        walls.create_dataset("name", data=np.array(["ground"], dtype=text))
        walls.create_dataset("shape", data=np.array(["terrain"], dtype=text))
        walls.create_dataset("parameters", dtype=text, data=np.array([json.dumps(
            {"lower": [x, y, float(np.nanmin(height))], "upper": far})], dtype=text))
        walls["present"], walls["rotation"], walls["translation"] = [1], np.eye(3)[None], np.zeros((1, 3))
        file["terrain/0/height"] = height
        file["terrain/0"].attrs.update({"x": x, "y": y, "dx": spacing, "dy": spacing})


def write_run(folder, snapshots=3):
    for i in range(snapshots):
        write_snapshot(folder / "snapshots" / f"{i:06d}.h5", i, 0.1 * i)
    return folder


def write_history(path, columns, units=None):
    with h5py.File(path, "w") as file:
        for name, values in columns.items():
            file[f"history/{name}"] = np.asarray(values, dtype=float)
            file[f"history/{name}"].attrs["unit"] = (units or {}).get(name, "1")


def tool(name, *arguments, environment=None):
    """Runs a script of tools/ and gives (exit code, standard output, standard error)."""
    result = subprocess.run([PYTHON, TOOLS / name, *map(str, arguments)], capture_output=True, text=True,
                            stdin=subprocess.DEVNULL, env={**os.environ, **(environment or {})}, check=False)
    return result.returncode, result.stdout, result.stderr


def picture(path):
    """The PNG as an array (height, width, 3) from 0 to 1."""
    return matplotlib.image.imread(path)[:, :, :3]


def share_coloured(image):
    """Share of the pixels that are neither white nor grey."""
    return float(np.mean(image.max(axis=2) - image.min(axis=2) > 0.08))
