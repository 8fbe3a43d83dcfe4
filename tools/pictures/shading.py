"""From the depth buffer to a picture: light on spheres, faces and ground, darker gaps between bodies."""
import numpy as np

LIGHT = np.array([-0.45, 0.60, 0.66])  # towards the light, camera coordinates, unit to 1e-3
AMBIENT, DIFFUSE, GLOSS = 0.52, 0.66, 0.16
BACKGROUND = np.array([1.0, 1.0, 1.0])
SHADOW = 0.35  # of the light, that ground beside bodies lacks
EDGE = 0.78  # of the light, on the edges of polyhedra


class Balls:
    """Spheres in the picture: colours (n, 3), centres and scale in pixels, radius [m]."""

    def __init__(self, colours, x, y, scale, radius):
        self.colours, self.x, self.y, self.r = colours, x, y, np.maximum(radius * scale, 0.5)


class Flats:
    """Faces of bodies, whose indices in the buffer come after those of all balls: colours and unit normals (n, 3) in
    camera coordinates."""

    def __init__(self, colours, normals):
        self.colours, self.normals = colours, normals


class Slopes:
    """Triangles of the ground, whose indices come last: one colour, and normals that change over the picture,
    value + a x + b y (n, 3), so that neighbours meet without a break."""

    def __init__(self, colour, value, a, b):
        self.colour, self.value, self.a, self.b = colour, value, a, b

    def normals(self, index, rows, columns):
        normal = self.value[index] + self.a[index] * (columns + 0.5)[:, None] + self.b[index] * (rows + 0.5)[:, None]
        return normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)


def shade(buffer, balls, flats, slopes, radius):
    """RGB image (height, width, 3). `radius`: a usual one of the bodies, in pixels and in metres."""
    image = np.broadcast_to(BACKGROUND, (buffer.height, buffer.width, 3)).copy()
    rows, columns = np.nonzero(buffer.index >= 0)
    if len(rows) == 0:
        return image
    index, count = buffer.index[rows, columns], len(balls.r)
    ground = count + len(flats.normals)
    normal, colour = np.empty((len(index), 3)), np.empty((len(index), 3))
    ball = np.flatnonzero(index < count)
    of = index[ball]
    nx = np.clip((columns[ball] + 0.5 - balls.x[of]) / balls.r[of], -1.0, 1.0)
    ny = np.clip(-(rows[ball] + 0.5 - balls.y[of]) / balls.r[of], -1.0, 1.0)
    normal[ball] = np.column_stack([nx, ny, np.sqrt(np.maximum(1.0 - nx * nx - ny * ny, 0.0))])
    colour[ball] = balls.colours[of]
    flat = np.flatnonzero((index >= count) & (index < ground))
    normal[flat], colour[flat] = flats.normals[index[flat] - count], flats.colours[index[flat] - count]
    slope = np.flatnonzero(index >= ground)
    normal[slope], colour[slope] = slopes.normals(index[slope] - ground, rows[slope], columns[slope]), slopes.colour
    # half-way vector between light and eye, for a soft spot of gloss
    half = (LIGHT + np.array([0.0, 0.0, 1.0])) / np.linalg.norm(LIGHT + np.array([0.0, 0.0, 1.0]))
    gloss = GLOSS * np.maximum(normal @ half, 0.0) ** 24
    gloss[slope] = 0.0
    light = (AMBIENT + DIFFUSE * np.maximum(normal @ LIGHT, 0.0)) * (0.72 + 0.28 * np.maximum(normal[:, 2], 0.0))
    body = np.flatnonzero(index < ground)
    light[body] *= (openness(buffer, *radius) * edges(buffer, count, ground))[rows[body], columns[body]]
    light[slope] *= shadow(buffer, ground, radius[0])[rows[slope], columns[slope]]
    image[rows, columns] = np.clip(colour * light[:, None] + gloss[:, None], 0.0, 1.0)
    return image


def edges(buffer, first, last):
    """1, but EDGE where two faces of bodies, or a face and something else, meet."""
    index = buffer.index
    face = (index >= first) & (index < last)
    result = np.ones(index.shape)
    if face.any():
        for here, there in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:, 1:], np.s_[:, :-1]),
                            (np.s_[:-1, :], np.s_[1:, :]), (np.s_[1:, :], np.s_[:-1, :])):
            result[here][face[here] & (index[here] != index[there])] = EDGE
    return result


def shadow(buffer, ground, pixels):
    """1 on open ground, less beside bodies."""
    bodies = (buffer.index >= 0) & (buffer.index < ground)
    return 1.0 - SHADOW * np.minimum(2.0 * box_blur(bodies.astype(float), max(int(pixels), 2)), 1.0)


def openness(buffer, pixels, radius):
    """1 in the open, down to 0.55 in a hollow: how far a pixel lies behind the mean depth around it."""
    covered = buffer.index >= 0
    depth = np.where(covered, buffer.depth, 0.0)
    width = max(int(1.5 * pixels), 2)
    weight = box_blur(covered.astype(float), width)
    mean = box_blur(depth, width) / np.maximum(weight, 1e-9)
    behind = np.where(covered, (mean - depth) / max(radius, 1e-300), 0.0)
    return 1.0 - 0.45 * np.clip(behind / 1.6, 0.0, 1.0)


def box_blur(image, half):
    """Mean over squares of 2 half + 1 pixels, by running sums."""
    for axis in (0, 1):
        n = image.shape[axis]
        total = np.concatenate([np.zeros_like(np.take(image, [0], axis)), np.cumsum(image, axis=axis)], axis=axis)
        low = np.clip(np.arange(n) - half, 0, n)
        high = np.clip(np.arange(n) + half + 1, 0, n)
        image = (np.take(total, high, axis) - np.take(total, low, axis)) / (2 * half + 1)
    return image


def shrink(image, factor):
    """Means over factor x factor pixels: smooth edges."""
    height, width = image.shape[0] // factor * factor, image.shape[1] // factor * factor
    image = image[:height, :width]
    return image.reshape(height // factor, factor, width // factor, factor, -1).mean(axis=(1, 3))
