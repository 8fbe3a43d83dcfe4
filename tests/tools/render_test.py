"""render.py draws the bodies where they are, in the colours that they have, and says what is wrong with its input."""
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

from helpers import picture, share_coloured, tool, write_run, write_snapshot

from pictures.camera import Camera
from pictures.snapshots import Snapshot
from pictures.spheres import DepthBuffer, draw_spheres


class Rendering(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_last_picture_is_the_default_and_not_blank(self):
        run = write_run(self.folder / "a run")  # with a space in its name
        code, out, err = tool("render.py", run, "--pixels", 300)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(out.strip(), str(run / "render.png"))
        self.assertGreater(share_coloured(picture(run / "render.png")), 0.1)

    def test_all_draws_one_picture_a_snapshot(self):
        run = write_run(self.folder, 3)
        self.assertEqual(tool("render.py", run, "--all", "--pixels", 120)[0], 0)
        self.assertEqual(sorted(path.name for path in (run / "frames").iterdir()),
                         ["000000.png", "000001.png", "000002.png"])

    def test_views_differ(self):
        run = write_run(self.folder, 1)
        pictures = []
        for view in ("front", "top", "perspective", "120,-30"):
            code, _, err = tool("render.py", run, f"--view={view}", "-o", self.folder / "v.png", "--pixels", 200)
            self.assertEqual(code, 0, err)
            pictures.append(picture(self.folder / "v.png"))
        for i, first in enumerate(pictures):
            for second in pictures[i + 1:]:
                self.assertTrue(first.shape != second.shape or abs(first - second).max() > 0.2)

    def test_film(self):
        run = write_run(self.folder, 3)
        film = self.folder / "film.mp4"
        if shutil.which("ffmpeg"):
            code, _, err = tool("render.py", run, "--film", film, "--pixels", 120)
            self.assertEqual(code, 0, err)
            self.assertGreater(film.stat().st_size, 1000)
        code, _, err = tool("render.py", run, "--film", film, environment={"PATH": "/nonexistent"})
        self.assertEqual(code, 2)
        self.assertIn("needs ffmpeg", err)

    def test_snapshot_without_bodies_or_walls(self):
        write_snapshot(self.folder / "000000.h5", position=np.zeros((0, 3)), radius=[],
                       fields={"velocity": (np.zeros((0, 3)), "m/s")}, walls=[])
        self.assertEqual(tool("render.py", self.folder / "000000.h5", "-o", self.folder / "x.png")[0], 0)

    def test_colour_range_is_the_same_in_all_frames(self):
        for i, speed in enumerate((0.1, 1.0)):
            write_snapshot(self.folder / "snapshots" / f"{i:06d}.h5", i, i, position=[[0, 0, 0]], radius=[0.01],
                           fields={"velocity": ([[speed, 0, 0]], "m/s")}, walls=[])
        self.assertEqual(tool("render.py", self.folder, "--all", "--pixels", 200)[0], 0)
        slow, fast = (picture(self.folder / "frames" / f"00000{i}.png") for i in (0, 1))
        middle = (slice(slow.shape[0] // 2 - 20, slow.shape[0] // 2 + 20),
                  slice(slow.shape[1] // 2 - 20, slow.shape[1] // 2 + 20))
        self.assertGreater(abs(slow[middle].mean(axis=(0, 1)) - fast[middle].mean(axis=(0, 1))).max(), 0.2)


class Errors(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def expect(self, code, message, *arguments):
        got, out, err = tool("render.py", *arguments)
        self.assertEqual(got, code, err)
        self.assertIn(message, err)
        self.assertNotIn("Traceback", err)
        self.assertEqual(out, "")

    def test_missing_file(self):
        self.expect(4, "no file or folder", self.folder / "nothing.h5")

    def test_folder_without_snapshots(self):
        self.expect(4, "no snapshot in", self.folder)

    def test_not_hdf5(self):
        (self.folder / "a.h5").write_text("text")
        self.expect(4, "cannot be read as HDF5", self.folder / "a.h5")

    def test_truncated_file(self):
        write_snapshot(self.folder / "a.h5")
        whole = (self.folder / "a.h5").read_bytes()
        (self.folder / "a.h5").write_bytes(whole[:len(whole) // 2])
        self.expect(4, "cannot be read", self.folder / "a.h5")

    def test_unknown_field_lists_the_fields(self):
        write_run(self.folder, 1)
        self.expect(2, "There are: speed, velocity_x", self.folder, "--field", "colour")

    def test_field_that_was_not_written_names_the_key(self):
        write_run(self.folder, 1)
        self.expect(2, "add it to output.fields", self.folder, "--field", "spin")

    def test_frame_that_is_not_there(self):
        write_run(self.folder, 2)
        self.expect(2, "there are 2", self.folder, "--frame", 2)

    def test_unknown_view(self):
        write_run(self.folder, 1)
        self.expect(2, "no view 'below'", self.folder, "--view", "below")

    def test_unwritable_output(self):
        write_run(self.folder, 1)
        self.expect(4, "cannot be written", self.folder, "-o", self.folder / "none" / "x.png")


class Raster(unittest.TestCase):
    """The depth buffer against a slow loop over pixels."""

    def test_equals_brute_force(self):
        random = np.random.default_rng(4)
        n, width, height = 60, 90, 70
        # apart in depth by more than their sizes, so that which is nearest does not hang on rounding
        x, y, z = random.uniform(-5, 95, n), random.uniform(-5, 75, n), random.permutation(n) * 30.0
        radius = np.where(np.arange(n) % 7 == 0, 25.0, random.uniform(0.8, 6.0, n))
        buffer = DepthBuffer(width, height)
        draw_spheres(buffer, x, y, z, np.ones(n), radius)
        nearest = np.full((height, width), -1)
        depth = np.full((height, width), -np.inf)
        for row in range(height):
            for column in range(width):
                square = radius ** 2 - (column + 0.5 - x) ** 2 - (row + 0.5 - y) ** 2
                surface = np.where(square > 0, z + np.sqrt(np.maximum(square, 0)), -np.inf)
                if np.isfinite(surface.max()):
                    nearest[row, column], depth[row, column] = surface.argmax(), surface.max()
        np.testing.assert_array_equal(buffer.index, nearest)
        np.testing.assert_allclose(buffer.depth, depth, rtol=1e-12)

    def test_hidden_spheres_are_left_out_without_a_trace(self):
        random = np.random.default_rng(5)
        n = 6000  # enough for several slabs
        x, y, z = random.uniform(0, 100, n), random.uniform(0, 100, n), random.permutation(n) * 10.0
        radius = np.full(n, 4.0)
        whole = DepthBuffer(100, 100)
        draw_spheres(whole, x, y, z, np.ones(n), radius)
        front = np.flatnonzero(z > 0.5 * z.max())  # half of them cover everything
        part = DepthBuffer(100, 100)
        draw_spheres(part, x[front], y[front], z[front], np.ones(len(front)), radius[front])
        np.testing.assert_array_equal(whole.depth, part.depth)

    def test_camera_puts_axes_where_the_view_says(self):
        low, high = np.full(3, -1.0), np.full(3, 1.0)
        for view, right, up in (("front", 0, 2), ("side", 1, 2), ("top", 0, 1)):
            camera = Camera(view, low, high, 100)
            x, y, _, scale = camera.project(np.vstack([np.zeros(3), np.eye(3)[right], np.eye(3)[up]]))
            np.testing.assert_allclose([x[1] - x[0], y[1] - y[0]], [scale[0], 0.0], atol=1e-9)
            np.testing.assert_allclose([x[2] - x[0], y[2] - y[0]], [0.0, -scale[0]], atol=1e-9)

    def test_fields(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.h5"
            write_snapshot(path, position=[[1, 2, 3]], radius=[0.5], fields={"velocity": ([[3, 0, -4]], "m/s")})
            snapshot = Snapshot(path)
            self.assertEqual(snapshot.field("speed").values.tolist(), [5.0])
            self.assertEqual(snapshot.field("velocity_z").values.tolist(), [-4.0])
            self.assertEqual(snapshot.field("y").values.tolist(), [2.0])
            self.assertEqual(snapshot.field("speed").unit, "m/s")
            self.assertNotIn("spin", snapshot.available_fields())


if __name__ == "__main__":
    unittest.main()
