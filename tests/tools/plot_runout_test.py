"""plot_runout.py: a map and a profile of what a run left, and what is wrong with its input."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from helpers import add_terrain, picture, share_coloured, tool, write_snapshot

from pictures.ground import Ground
from pictures.rasters import depth_of, volumes
from pictures.snapshots import Snapshot
from pictures.tracks import Line, Places, tracks_of, way_of_the_mass


def write_flow(run, count=200):
    """Spheres that went 60 m down a slope of 1 in 4, over two snapshots."""
    random = np.random.default_rng(1)
    place = random.uniform([5.0, 20.0, 0.0], [15.0, 30.0, 1.0], (count, 3))
    for number, way in enumerate((0.0, 30.0, 60.0)):
        position = place + [way, 0.0, 0.0]
        position[:, 2] = 25.0 - 0.25 * position[:, 0] + 0.5
        path = run / "snapshots" / f"{number:06d}.h5"
        write_snapshot(path, number, 5.0 * number, position, np.full(count, 0.5), walls=[])
        add_terrain(path, np.tile(25.0 - 0.25 * np.arange(0.0, 101.0, 5.0), (11, 1)), spacing=5.0)
    return run


def write_rasters(run):
    deposit = np.zeros((11, 21))
    deposit[4:7, 13:16] = 2.0
    (run / "rasters").mkdir()
    with h5py.File(run / "rasters" / "rasters.h5", "w") as file:
        for name, unit in (("deposit", "m"), ("flow_depth_max", "m"), ("speed_max", "m/s"), ("arrival_time", "s")):
            file[f"rasters/{name}"] = deposit if name == "deposit" else deposit + (np.arange(21) > 1)
            file[f"rasters/{name}"].attrs["unit"] = unit
        file["rasters"].attrs.update({"x": -2.5, "y": -2.5, "dx": 5.0, "dy": 5.0, "solid_fraction": 0.6,
                                      "covered": 0.1})


class Runout(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def draw(self, *arguments):
        return tool("plot_runout.py", self.folder, *arguments)

    def test_from_snapshots_alone(self):
        write_flow(self.folder)
        code, out, err = self.draw()
        self.assertEqual((code, err, out.strip()), (0, "", str(self.folder / "runout.png")))
        self.assertGreater(share_coloured(picture(self.folder / "runout.png")), 0.01)

    def test_rasters_change_the_map(self):
        write_flow(self.folder)
        self.draw("-o", self.folder / "without.png")
        write_rasters(self.folder)
        pictures = [picture(self.folder / "without.png")]
        for raster in ("deposit", "speed_max", "arrival_time"):
            code, _, err = self.draw("--raster", raster, "-o", self.folder / "x.png")
            self.assertEqual((code, err), (0, ""))
            pictures.append(picture(self.folder / "x.png"))
        for i, first in enumerate(pictures):
            for second in pictures[i + 1:]:
                self.assertTrue(first.shape != second.shape or abs(first - second).max() > 0.2)

    def test_faults_are_told(self):
        write_flow(self.folder)
        code, _, err = self.draw("--raster", "speed_max")
        self.assertEqual(code, 2)
        self.assertIn("the scenario has no `rasters`", err)
        for line in (["1,2"], ["1,2", "x,3"], ["1,2", "1,2"]):
            self.assertEqual(self.draw("--line", *line)[0], 2, line)
        self.assertEqual(self.draw("--line", "5,25", "95,25")[0], 0)
        self.assertNotEqual(tool("plot_runout.py", self.folder / "none")[0], 0)

    def test_ways_from_snapshots(self):
        write_flow(self.folder)
        places = Places(sorted((self.folder / "snapshots").iterdir()))
        np.testing.assert_allclose([middle[0] for middle in places.middles], [10.0, 40.0, 70.0], atol=1.0)
        tracks = tracks_of(self.folder, places)
        self.assertEqual(len(tracks), 40)
        for way in tracks:
            np.testing.assert_allclose(way[:, 0] - way[0, 0], [0.0, 30.0, 60.0], atol=1e-9)
        corners = way_of_the_mass([10.0, 25.0], [75.0, 25.0], places.middles)
        self.assertEqual(len(corners), 3)  # the first and the last middle are crest and toe nearly

    def test_depth_times_area_is_the_volume(self):
        write_flow(self.folder)
        snapshot = Snapshot(self.folder / "snapshots" / "000002.h5")
        x, y = np.arange(-2.5, 110.0, 5.0), np.arange(-2.5, 60.0, 5.0)
        depth = depth_of(snapshot, x, y, 0.6)
        self.assertAlmostEqual(depth.values.sum() * 25.0 * 0.6, volumes(snapshot).sum(), places=9)
        row, column = np.unravel_index(depth.values.argmax(), depth.values.shape)
        self.assertTrue(65.0 <= depth.centres()[0][column] <= 75.0 and 20.0 <= depth.centres()[1][row] <= 30.0)

    def test_heights_between_nodes(self):
        write_flow(self.folder)
        with h5py.File(self.folder / "snapshots" / "000000.h5") as file:
            ground = Ground(file["terrain/0"])
        random = np.random.default_rng(2)
        x, y = random.uniform(0.0, 100.0, 50), random.uniform(0.0, 50.0, 50)
        self.assertLess(abs(ground.height_at(x, y) - (25.0 - 0.25 * x)).max(), 1e-12)
        self.assertTrue(np.isnan(ground.height_at([-1.0, 50.0], [10.0, 51.0])).all())

    def test_places_along_a_bent_line(self):
        line = Line([[0.0, 0.0], [10.0, 0.0], [10.0, 20.0]])
        along, beside = line.place_of(np.array([[4.0, 1.0], [11.0, 7.0], [-3.0, 0.0], [10.0, 25.0]]))
        np.testing.assert_allclose(along, [4.0, 17.0, -3.0, 35.0])
        np.testing.assert_allclose(beside, [1.0, 1.0, 0.0, 0.0])
        np.testing.assert_allclose(line.at([4.0, 17.0, 30.0]), [[4.0, 0.0], [10.0, 7.0], [10.0, 20.0]])


if __name__ == "__main__":
    unittest.main()
