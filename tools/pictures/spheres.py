"""Spheres into a depth buffer, vectorised over the spheres.

For every pixel: the depth of the nearest surface [m] and the index of its sphere. Spheres of about the same size are
drawn together, one array operation for each pixel of their common stamp; large ones each by themselves. They come from
front to back in slabs, and a sphere that lies behind what is there already is left out, so that a deep bed costs little
more than its surface.
"""
import numpy as np

SLABS = 10
TILE = 8  # pixels, edge of the tiles of the coarse depth buffer


class DepthBuffer:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.depth = np.full((height, width), -np.inf)
        self.index = np.full((height, width), -1, dtype=np.int32)

    def coarse(self):
        """The farthest depth in each tile."""
        rows, columns = -(-self.height // TILE), -(-self.width // TILE)
        padded = np.full((rows * TILE, columns * TILE), np.inf)  # what lies outside hides nothing and needs no hiding
        padded[:self.height, :self.width] = self.depth
        return padded.reshape(rows, TILE, columns, TILE).min(axis=(1, 3))


def draw_spheres(buffer, x, y, z, scale, radius):
    """Centres in pixels (x, y) and metres (z), `scale` in pixels per metre, radius in metres."""
    r = np.maximum(radius * scale, 0.5)  # what is smaller than a pixel is still a dot
    seen = (x + r > 0) & (x - r < buffer.width) & (y + r > 0) & (y - r < buffer.height) & np.isfinite(x + y + z)
    order = np.flatnonzero(seen)
    order = order[np.argsort(-(z + radius)[order], kind="stable")]
    for slab in np.array_split(order, SLABS if len(order) > 2000 else 1):
        if len(slab) == 0:
            continue
        if slab[0] != order[0]:
            slab = slab[~hidden(buffer, x[slab], y[slab], (z + radius)[slab], r[slab])]
        draw_slab(buffer, slab[::-1], x, y, z, scale, r)  # back to front: the last one written is the nearest


def hidden(buffer, x, y, front, r):
    """Spheres whose front lies behind all tiles that they touch; spheres over more than 3 x 3 tiles count as seen."""
    coarse = buffer.coarse()
    rows, columns = coarse.shape
    result = 2.0 * r < 2 * TILE
    low_x, low_y = ((x - r) // TILE).astype(int), ((y - r) // TILE).astype(int)
    for i in range(3):
        for j in range(3):
            row, column = np.clip(low_y + i, 0, rows - 1), np.clip(low_x + j, 0, columns - 1)
            result &= coarse[row, column] > front
    return result


def draw_slab(buffer, spheres, x, y, z, scale, r):
    size = np.ceil(r[spheres]).astype(int)
    for s in np.unique(size):
        group = spheres[size == s]
        stamp = 4 * s * s
        # Costs in microseconds, measured with numpy 1.24: a pixel of the stamp for a whole group, a sphere by itself.
        if stamp * (23.0 + 0.03 * len(group)) < len(group) * (23.0 + 0.007 * stamp):
            draw_group(buffer, group, x, y, z, scale, r, s)
        else:
            for sphere in group:
                draw_one(buffer, sphere, x, y, z, scale, r)


def draw_group(buffer, group, x, y, z, scale, r, s):
    cx, cy, cz, square, inverse = x[group], y[group], z[group], r[group] ** 2, 1.0 / scale[group]
    column, row = np.floor(cx).astype(int), np.floor(cy).astype(int)
    depth, index = buffer.depth.reshape(-1), buffer.index.reshape(-1)
    for dy in range(-s, s + 1):
        py = row + dy
        rest = square - (py + 0.5 - cy) ** 2
        inside_row = (rest > 0) & (py >= 0) & (py < buffer.height)
        for dx in range(-s, s + 1):
            px = column + dx
            height = rest - (px + 0.5 - cx) ** 2
            ok = np.flatnonzero(inside_row & (height > 0) & (px >= 0) & (px < buffer.width))
            if len(ok) == 0:
                continue
            surface = cz[ok] + np.sqrt(height[ok]) * inverse[ok]
            pixel = py[ok] * buffer.width + px[ok]
            nearer = surface > depth[pixel]
            depth[pixel[nearer]] = surface[nearer]
            index[pixel[nearer]] = group[ok[nearer]]


def draw_one(buffer, i, x, y, z, scale, r):
    x0, x1 = max(int(x[i] - r[i]), 0), min(int(x[i] + r[i]) + 2, buffer.width)
    y0, y1 = max(int(y[i] - r[i]), 0), min(int(y[i] + r[i]) + 2, buffer.height)
    if x0 >= x1 or y0 >= y1:
        return
    across, down = np.arange(x0, x1)[None, :] + 0.5 - x[i], np.arange(y0, y1)[:, None] + 0.5 - y[i]
    height = r[i] ** 2 - down ** 2 - across ** 2
    surface = np.where(height > 0, z[i] + np.sqrt(np.maximum(height, 0.0)) / scale[i], -np.inf)
    depth, index = buffer.depth[y0:y1, x0:x1], buffer.index[y0:y1, x0:x1]
    nearer = surface > depth
    depth[nearer] = surface[nearer]
    index[nearer] = i
