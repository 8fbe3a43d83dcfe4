"""render.py draws the bodies where they are, in the colours that they have, and says what is wrong with its input."""
import pathlib
import shutil
import tempfile
import unittest

import h5py
import numpy as np

from helpers import add_terrain, picture, share_coloured, tool, write_cubes, write_run, write_snapshot

from pictures.camera import Camera
from pictures.polyhedra import Faces
from pictures.snapshots import Snapshot
from pictures.spheres import DepthBuffer, draw_spheres
from pictures.survey import Survey
from pictures.triangles import draw_triangles, linear_over


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


class Triangles(unittest.TestCase):
    """The rasteriser against a test of each pixel by itself."""

    def test_any_triangles(self):
        random = np.random.default_rng(3)
        width, height = 90, 70
        for size in (0.6, 3.0, 20.0, 200.0):
            centre = random.uniform([[[0.0, 0.0]]], [[[width, height]]], (60, 1, 2))
            corner = centre + random.uniform(-size, size, (60, 3, 2))
            z = random.uniform(0.0, 1.0, (60, 3))
            buffer = DepthBuffer(width, height)
            draw_triangles(buffer, corner[:, :, 0], corner[:, :, 1], z, np.arange(60, dtype=np.int32))
            depth, index = np.full((height, width), -np.inf), np.full((height, width), -1)
            x, y = np.arange(width)[None, :] + 0.5, np.arange(height)[:, None] + 0.5
            for i in range(60):
                (ax, ay), (bx, by), (cx, cy) = corner[i]
                doubled = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
                w0 = ((bx - x) * (cy - y) - (cx - x) * (by - y)) / doubled
                w1 = ((cx - x) * (ay - y) - (ax - x) * (cy - y)) / doubled
                here = w0 * z[i, 0] + w1 * z[i, 1] + (1.0 - w0 - w1) * z[i, 2]
                inside = (w0 >= 0) & (w1 >= 0) & (1.0 - w0 - w1 >= 0) & (here > depth)
                depth[inside], index[inside] = here[inside], i
            # pixels whose centre lies on an edge to round-off may go either way
            self.assertLess(np.mean(index != buffer.index), 2e-3)
            same = (index == buffer.index) & (index >= 0)
            self.assertLess(abs(depth[same] - buffer.depth[same]).max(), 1e-9)


    def test_numbers_between_corners(self):
        random = np.random.default_rng(7)
        x, y, values = random.uniform(0, 9, (5, 3)), random.uniform(0, 9, (5, 3)), random.uniform(0, 1, (5, 3, 2))
        value, a, b = linear_over(x, y, values)
        for k in range(3):
            np.testing.assert_allclose(value + a * x[:, k:k + 1] + b * y[:, k:k + 1], values[:, k], atol=1e-9)


class Polyhedra(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.path = self.folder / "000000.h5"

    def test_cubes_lie_where_they_are(self):
        """Seen from above, a cube is a square of its side; turned by 45 degrees it is as wide as its diagonal."""
        half = np.sqrt(0.5)
        turned = [np.cos(np.pi / 8), 0.0, 0.0, np.sin(np.pi / 8)]
        write_cubes(self.path, [[0, 0, 0], [0.1, 0, 0], [0.05, 0.06, 0]], [[1, 0, 0, 0], turned, [1, 0, 0, 0]], 0.02)
        snapshot = Snapshot(self.path)
        camera = Camera("top", np.array([-0.02, -0.02, -0.02]), np.array([0.12, 0.08, 0.02]), 700)
        faces = Faces(snapshot, np.array([0, 1]), camera)
        buffer = DepthBuffer(camera.width, camera.height)
        x, y, z, _ = camera.project(faces.corner.reshape(-1, 3))
        draw_triangles(buffer, *(v.reshape(-1, 3) for v in (x, y, z)), faces.body.astype(np.int32))
        for body, wide in ((0, 0.02), (1, 0.04 * half)):
            columns = np.nonzero((buffer.index == body).any(axis=0))[0]
            self.assertAlmostEqual(np.ptp(columns) + 1, wide * camera.pixels_per_metre, delta=2.5)
            area = np.sum(buffer.index == body) / camera.pixels_per_metre ** 2
            self.assertAlmostEqual(area, 4e-4, delta=1e-5)

    def test_volume_of_the_faces(self):
        """All faces from two opposite sides enclose the bodies: corners go round as the normals say."""
        random = np.random.default_rng(5)
        quaternion = random.normal(size=(6, 4))
        quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
        write_cubes(self.path, random.uniform(-1, 1, (6, 3)), quaternion, 0.02)
        snapshot = Snapshot(self.path)
        bounds = np.full(3, -1.0), np.full(3, 1.0)
        volume = 0.0
        for view in ("40,30", "220,-30"):
            camera = Camera(view, *bounds, 100)
            camera.distance = None  # parallel: each face is seen from exactly one of the two sides
            faces = Faces(snapshot, np.arange(5), camera)
            corner = faces.corner - snapshot.position[faces.body][:, None, :]
            volume += np.einsum("ij,ij->i", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])).sum() / 6.0
        self.assertAlmostEqual(volume, 5 * 0.02 ** 3, delta=1e-12)

    def test_pictures_of_cubes_on_ground(self):
        grid = np.linspace(0.2, 0.8, 5)
        position = np.stack(np.meshgrid(grid, grid, [0.1]), axis=-1).reshape(-1, 3)
        write_cubes(self.path, position, side=0.1)
        add_terrain(self.path, np.outer(np.ones(21), np.linspace(0.0, -0.2, 21)), spacing=0.05)
        for view in ("top", "perspective"):
            code, _, err = tool("render.py", self.path, f"--view={view}", "-o", self.folder / "v.png", "--pixels", 300)
            self.assertEqual((code, err), (0, ""))
            image = picture(self.folder / "v.png")
            self.assertGreater(share_coloured(image), 0.05)
            stone = abs(image - image.mean(axis=2, keepdims=True)).max(axis=2) < 0.06
            self.assertGreater(np.mean(stone & (image.mean(axis=2) < 0.95)), 0.1)  # the ground

    def test_ground_of_a_mesh_looks_like_that_of_a_grid(self):
        x = np.linspace(0.0, 1.0, 11)
        height = np.add.outer(0.1 * x, -0.2 * x)
        pictures = []
        for mesh in (False, True):
            write_cubes(self.path, [[0.4, 0.4, 0.3], [0.6, 0.5, 0.3]], side=0.1)
            add_terrain(self.path, height, spacing=0.1)
            if mesh:
                corner = np.array([[x[i], x[j], height[j, i]] for j in range(11) for i in range(11)])
                cell = np.array([11 * j + i for j in range(10) for i in range(10)])[:, None]
                with h5py.File(self.path, "a") as file:
                    del file["terrain"]
                    file["terrain/0/vertex"] = corner
                    file["terrain/0/triangle"] = np.concatenate([cell + [0, 1, 12], cell + [0, 12, 11]])
            code, _, err = tool("render.py", self.path, "--view=30,40", "-o", self.folder / "v.png", "--pixels", 200)
            self.assertEqual((code, err), (0, ""))
            pictures.append(picture(self.folder / "v.png"))
        self.assertLess(abs(pictures[0] - pictures[1]).mean(), 2e-3)

    def test_without_its_shapes_says_which_file(self):
        write_cubes(self.path, [[0, 0, 0], [1, 0, 0]])
        with h5py.File(self.path, "a") as file:
            del file["shapes"]
            file["shapes"] = h5py.ExternalLink("shapes.h5", "/shapes")
        code, _, err = tool("render.py", self.path, "-o", self.folder / "v.png")
        self.assertNotEqual(code, 0)
        self.assertIn("needs shapes.h5 beside it", err)

    def test_bodies_that_fell_off_do_not_make_the_rest_small(self):
        write_cubes(self.path, [[0.4, 0.4, 0.1], [0.5, 0.5, 0.1], [9.0, 0.5, -5000.0]], side=0.1)
        add_terrain(self.path, np.zeros((11, 11)), spacing=0.1)
        survey = Survey([self.path], "speed")
        self.assertGreater(survey.lower[2], -1.0)
        self.assertLess(survey.upper[0], 2.0)


if __name__ == "__main__":
    unittest.main()
