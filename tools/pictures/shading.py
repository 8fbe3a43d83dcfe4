"""From the depth buffer to a picture: light on the spheres, darker gaps between them."""
import numpy as np

LIGHT = np.array([-0.45, 0.60, 0.66])  # towards the light, camera coordinates, unit to 1e-3
AMBIENT, DIFFUSE, GLOSS = 0.52, 0.66, 0.16
BACKGROUND = np.array([1.0, 1.0, 1.0])


def shade(buffer, colours, x, y, scale, radius):
    """RGB image (height, width, 3) from the colours (n, 3) of the spheres."""
    image = np.broadcast_to(BACKGROUND, (buffer.height, buffer.width, 3)).copy()
    rows, columns = np.nonzero(buffer.index >= 0)
    if len(rows) == 0:
        return image
    sphere = buffer.index[rows, columns]
    r = np.maximum(radius * scale, 0.5)[sphere]
    nx = np.clip((columns + 0.5 - x[sphere]) / r, -1.0, 1.0)
    ny = np.clip(-(rows + 0.5 - y[sphere]) / r, -1.0, 1.0)
    nz = np.sqrt(np.maximum(1.0 - nx * nx - ny * ny, 0.0))
    facing = nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]
    # half-way vector between light and eye, for a soft spot of gloss
    half = (LIGHT + np.array([0.0, 0.0, 1.0])) / np.linalg.norm(LIGHT + np.array([0.0, 0.0, 1.0]))
    gloss = GLOSS * np.maximum(nx * half[0] + ny * half[1] + nz * half[2], 0.0) ** 24
    light = (AMBIENT + DIFFUSE * np.maximum(facing, 0.0)) * (0.72 + 0.28 * nz)
    light *= openness(buffer, float(np.median(r)), float(np.median(radius)))[rows, columns]
    image[rows, columns] = np.clip(colours[sphere] * light[:, None] + gloss[:, None], 0.0, 1.0)
    return image


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
