"""The lines that stand for a wall lie on it, and end where the picture ends."""
import unittest

import numpy as np

from helpers import WALLS  # first: it makes tools/ importable

from pictures.camera import Camera
from pictures.snapshots import Wall
from pictures.walls import MAKERS, extent_of, lines_of

LOWER, UPPER = np.full(3, -0.06), np.full(3, 0.11)
CAMERA = Camera("30,20", LOWER, UPPER, 400)


def distance(shape, p, x):
    """From points to the wall's surface, by its definition (plane, box, cylinder, cone, disc, floors at z = const)."""
    r, z = np.hypot(x[:, 0], x[:, 1]), x[:, 2]
    if shape == "plane":
        return abs(z - p["point"][2])
    if shape == "box":
        low, high = np.array(p["lower"]), np.array(p["upper"])
        return np.minimum(abs(x - low), abs(x - high)).min(axis=1)
    if shape == "cylinder":
        return abs(r - p["radius"])
    if shape == "cone":
        return abs(r - p["radius_base"] - z / p["length"] * (p["radius_end"] - p["radius_base"]))
    if shape == "disc":
        return abs(z - p["centre"][2]) + np.maximum(r - p["radius"], 0.0)
    if shape == "orifice_floor":
        return abs(z - p["centre"][2]) + np.maximum(p["hole_radius"] - r, 0.0)
    return abs(z - p["centre"][2]) + np.maximum(0.5 * p["width"] - abs(x[:, 1]), 0.0)  # a slot along x without ends


class Lines(unittest.TestCase):
    def test_every_shape_is_known(self):
        self.assertEqual(sorted(MAKERS), sorted(wall[1] for wall in WALLS))

    def test_lines_lie_on_the_wall_and_inside_the_picture(self):
        for name, shape, parameters in WALLS:
            with self.subTest(shape=shape):
                wall = Wall(name, shape, parameters, np.eye(3), np.zeros(3))
                points = np.concatenate([line for line, _ in lines_of(wall, (LOWER, UPPER), CAMERA)])
                points = points[np.isfinite(points).all(axis=1)]
                self.assertGreater(len(points), 100)
                self.assertLess(distance(shape, parameters, points).max(), 1e-9)
                grown = 0.02 * np.linalg.norm(UPPER - LOWER) + 1e-12
                self.assertTrue(((points > LOWER - grown) & (points < UPPER + grown)).all())

    def test_moved_wall(self):
        quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # x -> y
        wall = Wall("d", "disc", {"centre": [0.02, 0, 0], "normal": [1, 0, 0], "radius": 0.01}, quarter,
                    np.array([0.0, 0.0, 0.03]))
        low, high = extent_of(wall, 1.0)
        np.testing.assert_allclose([low[1], high[1]], [0.02, 0.02], atol=1e-12)
        np.testing.assert_allclose([low[2], high[2]], [0.02, 0.04], atol=1e-5)

    def test_endless_walls_have_no_extent(self):
        for name, shape, parameters in WALLS:
            bounded = shape in ("box", "cone", "disc", "cylinder")
            wall = Wall(name, shape, parameters, np.eye(3), np.zeros(3))
            self.assertEqual(extent_of(wall, 1.0) is not None, bounded, shape)
            if shape == "cylinder":  # about z, without ends
                low, high = extent_of(wall, 1.0)
                np.testing.assert_allclose([low[:2], high[:2]], [[-0.05] * 2, [0.05] * 2], atol=1e-5)
                self.assertEqual((low[2], high[2]), (np.inf, -np.inf))

    def test_border_of_a_slanting_plane(self):
        bounds = (np.zeros(3), np.ones(3))
        parameters = {"point": [0.5, 0.5, 0.5], "normal": [1.0, 1.0, 1.0]}
        wall = Wall("p", "plane", parameters, np.eye(3), np.zeros(3))
        edges = [line for line, is_edge in lines_of(wall, bounds, CAMERA) if is_edge]
        self.assertEqual(len(edges), 6)  # a cube cut through its middle, across its diagonal: a regular hexagon
        lengths = [np.linalg.norm(line[-1] - line[0]) for line in edges]
        np.testing.assert_allclose(lengths, (1.0 + 0.04 * 3 ** 0.5) / 2 ** 0.5, rtol=1e-9)
        far = Wall("p", "plane", {"point": [0, 0, 5], "normal": [0, 0, 1]}, np.eye(3), np.zeros(3))
        self.assertEqual(lines_of(far, bounds, CAMERA), [])

    def test_contour_of_a_cone_is_at_right_angles_to_the_sight(self):
        front = Camera("front", LOWER, UPPER, 400)
        name, shape, parameters = next(wall for wall in WALLS if wall[1] == "cone")
        wall = Wall(name, shape, parameters, np.eye(3), np.zeros(3))
        lines = [line for line, _ in lines_of(wall, (LOWER, UPPER), front)]
        straight = [line for line in lines if np.ptp(line[:, 2]) > 0.04]
        self.assertEqual(len(straight), 2)
        for line in straight:  # seen along y, a cone about z has its contour in the plane y = 0
            np.testing.assert_allclose(line[:, 1], 0.0, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
