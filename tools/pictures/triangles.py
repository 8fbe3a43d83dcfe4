"""Triangles into a depth buffer, vectorised over the triangles.

Those of about the same size are drawn together, one array operation for each pixel of their common box; large ones each
by themselves. Inside: on the inner side of all three edges; depth is linear over the picture, which is exact for
parallel views and good for triangles much smaller than their distance.
"""
import numpy as np

LARGE = 48  # pixels, edge of the box from which a triangle is drawn by itself
AT_ONCE = 200_000  # triangles: bounds the memory


def draw_triangles(buffer, x, y, z, index):
    """x, y [pixels], z [m]: corners (n, 3); index (n): what the buffer keeps of each."""
    for first in range(0, len(x), AT_ONCE):
        part = slice(first, first + AT_ONCE)
        draw_part(buffer, x[part], y[part], z[part], index[part])


def draw_part(buffer, x, y, z, index):
    low_x, high_x, low_y, high_y = x.min(axis=1), x.max(axis=1), y.min(axis=1), y.max(axis=1)
    doubled = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    seen = (high_x > 0) & (low_x < buffer.width) & (high_y > 0) & (low_y < buffer.height) & (abs(doubled) > 1e-12)
    seen &= np.isfinite(x + y + z).all(axis=1)
    x, y, z, index, doubled = x[seen], y[seen], z[seen], index[seen], doubled[seen]
    column = np.floor(low_x[seen] - 0.5).astype(int)  # pixel centres lie at halves
    row = np.floor(low_y[seen] - 0.5).astype(int)
    size = np.maximum(np.ceil(high_x[seen] - 0.5).astype(int) - column, np.ceil(high_y[seen] - 0.5).astype(int) - row)
    planes = Planes(x, y, z, doubled, column + 0.5, row + 0.5)
    classes = np.where(size <= 4, size, 2 ** np.ceil(np.log2(np.maximum(size, 1))).astype(int))
    for edge in np.unique(classes[classes <= LARGE]):
        group = np.flatnonzero(classes == edge)
        draw_group(buffer, planes.of(group), column[group], row[group], index[group], int(edge))
    for i in np.flatnonzero(classes > LARGE):
        draw_one(buffer, planes.of(i), column[i], row[i], index[i], int(size[i]))


def linear_over(x, y, values):
    """value, a, b (n, m) so that value + a x + b y is values (n, 3, m) at the corners x, y (n, 3)."""
    doubled = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    doubled = np.where(abs(doubled) > 1e-12, doubled, np.inf)  # seen edge-on: never drawn
    a, b = np.zeros_like(values[:, 0]), np.zeros_like(values[:, 0])
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        a += ((y[:, i] - y[:, j]) / doubled)[:, None] * values[:, k]
        b += ((x[:, j] - x[:, i]) / doubled)[:, None] * values[:, k]
    return values[:, 0] - a * x[:, :1] - b * y[:, :1], a, b


class Planes:
    """Linear functions of the pixel, value + a dx + b dy: three that are positive inside, and the depth."""

    def __init__(self, x, y, z, doubled, x0, y0):
        self.value, self.a, self.b = [], [], []
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3  # the weight of corner k vanishes on the edge from i to j
            self.a.append((y[:, i] - y[:, j]) / doubled)
            self.b.append((x[:, j] - x[:, i]) / doubled)
            self.value.append(self.a[k] * (x0 - x[:, i]) + self.b[k] * (y0 - y[:, i]))
        for weights in (self.value, self.a, self.b):
            weights.append(sum(weights[k] * z[:, k] for k in range(3)))

    def of(self, which):
        part = object.__new__(Planes)
        part.value, part.a, part.b = ([numbers[which] for numbers in lists] for lists in (self.value, self.a, self.b))
        return part

    def at(self, k, dx, dy):
        return self.value[k] + (self.a[k] * dx + self.b[k] * dy)


def draw_group(buffer, planes, column, row, index, size):
    depths, indices = buffer.depth.reshape(-1), buffer.index.reshape(-1)
    for dy in range(size + 1):
        in_rows = (row + dy >= 0) & (row + dy < buffer.height)
        for dx in range(size + 1):
            inside = in_rows & (column + dx >= 0) & (column + dx < buffer.width)
            for k in range(3):
                inside &= planes.at(k, dx, dy) >= 0.0
            ok = np.flatnonzero(inside)
            if len(ok) == 0:
                continue
            depth = planes.at(3, dx, dy)[ok]
            pixel = (row[ok] + dy) * buffer.width + column[ok] + dx
            nearer = np.flatnonzero(depth > depths[pixel])
            nearer = nearer[np.argsort(depth[nearer], kind="stable")]  # the last one written is the nearest
            depths[pixel[nearer]] = depth[nearer]
            indices[pixel[nearer]] = index[ok[nearer]]


def draw_one(buffer, planes, column, row, index, size):
    x0, x1 = max(column, 0), min(column + size + 1, buffer.width)
    y0, y1 = max(row, 0), min(row + size + 1, buffer.height)
    if x0 >= x1 or y0 >= y1:
        return
    dx, dy = np.arange(x0, x1)[None, :] - column, np.arange(y0, y1)[:, None] - row
    depths, indices = buffer.depth[y0:y1, x0:x1], buffer.index[y0:y1, x0:x1]
    depth = planes.at(3, dx, dy)
    inside = (depth > depths) & (planes.at(0, dx, dy) >= 0.0) & (planes.at(1, dx, dy) >= 0.0)
    inside &= planes.at(2, dx, dy) >= 0.0
    depths[inside] = depth[inside]
    indices[inside] = index
