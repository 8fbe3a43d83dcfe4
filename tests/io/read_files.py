"""Reads a run folder as a user would; any failed assertion is exit 1. Called by python_reads_test.cpp."""
import glob
import os
import sys
import xml.etree.ElementTree

import h5py
import numpy

KINDS = {("Float", 8): "f8", ("Float", 4): "f4", ("Int", 8): "i8", ("UInt", 8): "u8", ("Int", 4): "i4", ("UInt", 4): "u4",
         ("UInt", 2): "u2", ("UChar", 1): "u1"}


def check_provenance(file):
    group = file["provenance"]
    assert group.attrs["creator"].startswith("scree ")
    assert group.attrs["seed"] == 42
    assert group["scenario_text"][()].decode() == "title: box\n"
    assert list(file.attrs["format_version"]) == [1, 0]


def check_descriptions(file):
    def check(name, item):
        if isinstance(item, h5py.Dataset):
            assert item.attrs["description"], name
            assert item.dtype.kind == "S" or "unit" in item.attrs, name
            assert isinstance(item.attrs.get("unit", ""), str), name
    file.visititems(check)


def check_snapshot(path):
    with h5py.File(path, "r") as file:
        check_provenance(file)
        check_descriptions(file)
        assert file.attrs["format"] == "scree snapshot"
        bodies = file["bodies"]
        n = len(bodies["id"])
        assert numpy.all(numpy.diff(bodies["id"][:]) > 0)
        assert bodies["position"].shape == (n, 3) and bodies["orientation"].shape == (n, 4)
        assert bodies["position"].attrs["unit"] == "m" and bodies["position"].attrs["frame"] == "world"
        assert [name.decode() for name in file["walls/name"]] == ["floor", "drum"]
        assert file["walls/rotation"].shape == (2, 3, 3)
        if n:
            assert bodies["position"][n - 1].tolist() == [100.0 + 49, 200.0 + 98, 300.5]
            assert bodies["position"].compression == "gzip" and bodies["position"].shuffle
            assert file["contacts/id_b"][:].tolist() == [2, -2]


def check_history(path):
    with h5py.File(path, "r") as file:
        check_provenance(file)
        check_descriptions(file)
        assert file["history/time"].shape == (3000,)
        assert numpy.array_equal(file["history/time"][:], 0.5 * numpy.arange(3000))
        assert numpy.array_equal(file["history/bed.profile"][:], numpy.tile([1.0, 2.0, 3.0], (3000, 1)))
        assert [name.decode() for name in file["columns"]] == ["time", "bed.profile"]


def check_xdmf(folder):
    root = xml.etree.ElementTree.parse(os.path.join(folder, "run.xdmf")).getroot()
    assert root.tag == "Xdmf" and root.get("Version") == "2.0"
    run = root.find("Domain/Grid")
    assert run.get("CollectionType") == "Temporal"
    assert [float(t.get("Value")) for t in run.findall("Grid/Time")] == [0.25, 0.5]
    for time in run.findall("Grid"):
        assert time.get("CollectionType") == "Spatial"
        spheres = time.find("Grid")
        n = int(spheres.find("Topology").get("NumberOfElements"))
        assert spheres.find("Topology").get("TopologyType") == "Polyvertex"
        assert {a.get("Name") for a in spheres.findall("Attribute")} == {
            "id", "radius", "velocity", "spin", "mass", "material"}
        for item in spheres.iter("DataItem"):
            name, dataset = item.text.split(":")
            with h5py.File(os.path.join(folder, name), "r") as file:
                data = file[dataset]
                assert data.shape == tuple(int(x) for x in item.get("Dimensions").split()), dataset
                assert data.shape[0] == n
                kind = KINDS[item.get("NumberType"), int(item.get("Precision"))]
                assert data.dtype == numpy.dtype("<" + kind), dataset


def turned(q, v):
    w, u = q[0], q[1:]
    return v + 2.0 * w * numpy.cross(u, v) + 2.0 * numpy.cross(u, numpy.cross(u, v))


def check_shapes(folder):
    """A user places the vertices of bodies; ParaView looks fields up by mesh/body."""
    with h5py.File(os.path.join(folder, "snapshots", "000000.h5"), "r") as file:
        check_descriptions(file)
        shape, shapes, bodies, mesh = file["bodies/shape"][:], file["shapes"], file["bodies"], file["mesh"]
        first = numpy.cumsum(shapes["vertices"]) - shapes["vertices"][:]
        places = []
        for i, s in enumerate(shape):
            if s < 0:
                continue
            own = shapes["vertex"][first[s]:first[s] + shapes["vertices"][s]]
            places += [bodies["position"][i] + turned(bodies["orientation"][i], v) for v in own]
        assert numpy.abs(numpy.array(places) - mesh["points"]).max() < 1e-4
        faces = shapes["faces"][:][shape[shape >= 0]]
        assert mesh["body"][:].tolist() == numpy.repeat(numpy.flatnonzero(shape >= 0), faces).tolist()
    run = xml.etree.ElementTree.parse(os.path.join(folder, "run.xdmf")).getroot().find("Domain/Grid")
    grids = {grid.get("Name"): grid for grid in run.find("Grid").findall("Grid")}
    assert set(grids) == {"centres", "polyhedra"}
    assert int(grids["polyhedra"].find("Topology").get("NumberOfElements")) == faces.sum()
    fields = {a.get("Name"): a for a in grids["polyhedra"].findall("Attribute")}
    assert set(fields) == {"id", "radius", "velocity", "spin", "mass", "material", "shape"}
    assert all(a.get("Center") == "Cell" for a in fields.values())
    assert fields["mass"].find("DataItem").get("Function") == "$0[$1]"
    for item in grids["polyhedra"].iter("DataItem"):
        if item.get("Format") == "HDF":
            name, dataset = item.text.split(":")
            with h5py.File(os.path.join(folder, name), "r") as file:
                assert file[dataset].shape == tuple(int(x) for x in item.get("Dimensions").split()), dataset
                kind = KINDS[item.get("NumberType"), int(item.get("Precision"))]
                assert file[dataset].dtype == numpy.dtype("<" + kind), dataset


def main(folder):
    snapshots = sorted(glob.glob(os.path.join(folder, "snapshots", "*.h5")))
    assert len(snapshots) == 2
    for path in snapshots:
        check_snapshot(path)
    check_history(os.path.join(folder, "history.h5"))
    check_xdmf(folder)
    check_shapes(os.path.join(folder, "rocks"))
    for path in glob.glob(os.path.join(folder, "checkpoint", "*.h5")):
        with h5py.File(path, "r") as file:
            check_provenance(file)
            check_descriptions(file)
            assert file["bodies/position"].shape == (50, 3)
            assert file["time"][0] == 0.25


main(sys.argv[1])
