"""Reads what a run left behind: history.h5, summary.yaml and the list of snapshots."""
import pathlib

import h5py
import numpy as np
import yaml

from .errors import PictureError


class Column:
    """One column of the history: values (rows, or rows x width) with unit and description."""

    def __init__(self, name, values, unit, description):
        self.name, self.values, self.unit, self.description = name, values, unit, description


def text_of(value):
    """An HDF5 attribute or string as str."""
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.reshape(-1)[0]
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def open_hdf5(path):
    path = pathlib.Path(path)
    if not path.exists():
        raise PictureError(f"no file {path}")
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise PictureError(f"{path} cannot be read as HDF5 ({error})") from error


class History:
    """The columns of history.h5, all cut to the same number of rows (a killed run may have a last row half written)."""

    def __init__(self, path):
        with open_hdf5(path) as file:
            if "history" not in file:
                raise PictureError(f"{path} has no group /history: it is not the history of a run")
            self.columns = {}
            for name, item in file["history"].items():
                if isinstance(item, h5py.Dataset) and item.ndim >= 1:
                    self.columns[name] = Column(name, item[...], text_of(item.attrs.get("unit", "")),
                                                text_of(item.attrs.get("description", "")))
            self.attributes = {key: value for key, value in file.attrs.items()}
        if "time" not in self.columns:
            raise PictureError(f"{path} has no column /history/time")
        rows = min(len(column.values) for column in self.columns.values())
        if rows == 0:
            raise PictureError(f"{path} has no rows: the run ended before its first step")
        for column in self.columns.values():
            column.values = column.values[:rows]
        self.time = self.columns["time"].values

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        return self.columns[name]

    def ending(self, suffix):
        """The columns "<measure>.<suffix>", by measure."""
        return {name[:-len(suffix) - 1]: column for name, column in self.columns.items()
                if name.endswith("." + suffix)}


def read_summary(run):
    """summary.yaml as a dictionary; empty while the run has not ended."""
    path = pathlib.Path(run) / "summary.yaml"
    if not path.exists():
        return {}
    try:
        with open(path, encoding="utf-8") as file:
            summary = yaml.safe_load(file)
    except (OSError, yaml.YAMLError) as error:
        raise PictureError(f"{path} cannot be read: {error}") from error
    if not isinstance(summary, dict):
        raise PictureError(f"{path} is not a summary: a map of names and values was expected")
    return summary


def require_run(folder):
    folder = pathlib.Path(folder)
    if not folder.exists():
        raise PictureError(f"no folder {folder}")
    if not folder.is_dir():
        raise PictureError(f"{folder} is a file; the folder of a run was expected")
    return folder


def snapshot_paths(sources):
    """The snapshots that the arguments name, in order: a folder stands for all of its run's."""
    paths = []
    for source in map(pathlib.Path, sources):
        if source.is_dir():
            inside = source / "snapshots" if (source / "snapshots").is_dir() else source
            found = sorted((path for path in inside.glob("*.h5") if path.stem.isdigit()),
                           key=lambda path: int(path.stem))
            if not found:
                raise PictureError(f"no snapshot in {inside}: files like 000120.h5 were expected")
            paths += found
        elif source.exists():
            paths.append(source)
        else:
            raise PictureError(f"no file or folder {source}")
    return paths
