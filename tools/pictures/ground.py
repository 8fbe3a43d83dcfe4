"""Terrain: what the snapshots' /terrain holds (io/results/terrain_file.hpp), as triangles to draw and as heights to
map."""
import numpy as np

FINEST = 1.5  # pixels: smaller cells are drawn as larger ones
STONE = np.array([0.86, 0.84, 0.80])


class Ground:
    """Triangles (vertex, triangle), and of a grid its nodes: x (columns), y (rows), height (rows, columns)."""

    def __init__(self, group):
        self.height = None
        if "height" in group:
            self.height = group["height"][...]
            rows, columns = self.height.shape
            self.x = group.attrs["x"] + group.attrs["dx"] * np.arange(columns)
            self.y = group.attrs["y"] + group.attrs["dy"] * np.arange(rows)
        else:
            self.vertex, self.triangle = group["vertex"][...], group["triangle"][...].astype(int)

    def extent(self):
        if self.height is None:
            return self.vertex.min(axis=0), self.vertex.max(axis=0)
        return (np.array([self.x[0], self.y[0], np.nanmin(self.height)]),
                np.array([self.x[-1], self.y[-1], np.nanmax(self.height)]))

    def triangles(self, bounds, pixels_per_metre):
        """Corners (n, 3, 3) inside the bounds, no finer than the picture, and unit normals there: of a grid smooth."""
        if self.height is None:
            corners = self.vertex[self.triangle]
            inside = ((corners[:, :, :2].max(axis=1) >= bounds[0][:2]) &
                      (corners[:, :, :2].min(axis=1) <= bounds[1][:2])).all(axis=1)
            return corners[inside], normals_of(corners[inside])
        columns, rows = (part_of(nodes, bounds[0][k], bounds[1][k], pixels_per_metre)
                         for k, nodes in enumerate((self.x, self.y)))
        z = self.height[np.ix_(rows, columns)]
        x, y = np.meshgrid(self.x[columns], self.y[rows])
        if min(z.shape) < 2:
            return np.zeros((0, 3, 3)), np.zeros((0, 3, 3))
        along_y, along_x = np.gradient(z, y[:, 0], x[0])
        node = np.stack([x, y, z, -along_x, -along_y], axis=-1)
        a, b, c, d = node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]
        # As core/terrain.hpp: along the diagonal whose ends differ less in height.
        first = (abs(a[..., 2] - c[..., 2]) <= abs(b[..., 2] - d[..., 2]))[..., None]
        corners = np.stack([np.stack([a, b, np.where(first, c, d)], axis=-2),
                            np.stack([np.where(first, a, b), c, d], axis=-2)], axis=2).reshape(-1, 3, 5)
        corners = corners[np.isfinite(corners[:, :, :3]).all(axis=(1, 2))]
        slope = corners[:, :, 3:]
        normal = np.concatenate([slope, np.ones_like(slope[:, :, :1])], axis=2)
        normal /= np.linalg.norm(normal, axis=2, keepdims=True)
        corners = corners[:, :, :3]
        rough = ~np.isfinite(normal).all(axis=(1, 2))  # beside holes
        normal[rough] = normals_of(corners[rough])
        return corners, normal

    def height_at(self, x, y):
        """Bilinear between the nodes; NaN outside and where there is no data. Of a grid only."""
        i = (np.asarray(x, float) - self.x[0]) / (self.x[1] - self.x[0])
        j = (np.asarray(y, float) - self.y[0]) / (self.y[1] - self.y[0])
        rows, columns = self.height.shape
        outside = ~((i >= 0) & (i <= columns - 1) & (j >= 0) & (j <= rows - 1))
        i, j = np.where(outside, 0.0, i), np.where(outside, 0.0, j)
        i0, j0 = np.minimum(i.astype(int), columns - 2), np.minimum(j.astype(int), rows - 2)
        u, v = i - i0, j - j0
        z = self.height
        south = (1 - u) * z[j0, i0] + u * z[j0, i0 + 1]
        north = (1 - u) * z[j0 + 1, i0] + u * z[j0 + 1, i0 + 1]
        return np.where(outside, np.nan, (1 - v) * south + v * north)


def part_of(nodes, low, high, pixels_per_metre):
    """Indices of the nodes to draw: those inside [low, high] and one beyond, every k-th if cells would be tiny."""
    first = max(int(np.searchsorted(nodes, low)) - 1, 0)
    last = min(int(np.searchsorted(nodes, high)) + 1, len(nodes))
    step = max(int(FINEST / max((nodes[1] - nodes[0]) * pixels_per_metre, 1e-9)), 1)
    return np.arange(first, last, step)


def normals_of(corners):
    """Of each triangle, at each of its corners (n, 3, 3)."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    return np.repeat(normal[:, None, :], 3, axis=1)
