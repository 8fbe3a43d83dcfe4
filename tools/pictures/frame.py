"""One picture: bodies and ground by the rasteriser, walls as lines over them, a colour bar, a length and the time."""
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap, Normalize

from . import ground, polyhedra, shading, spheres, triangles, walls
from .style import BLACK, CYCLE, plt, quantity_label

SUPERSAMPLING = 2
DOTS_PER_INCH = 100
# Lightness rises evenly, as for viridis, but from slate instead of near black: shading needs room below.
RISING = LinearSegmentedColormap.from_list("rising", ["#66799a", "#4b8db3", "#3fa39b", "#82c377", "#d3db55", "#fff06a"])
BOTH_WAYS = LinearSegmentedColormap.from_list("both ways", ["#1f5fa8", "#7db3d8", "#f2f2f0", "#f0a37a", "#b5302f"])


class Colours:
    """From numbers to colours, the same for all pictures of a run."""

    def __init__(self, field, low, high):
        self.label = quantity_label(field.label, field.unit)
        self.names = field.names
        if field.names:
            count = max(len(field.names), 1)
            self.map = ListedColormap([CYCLE[i % len(CYCLE)] for i in range(count)])
            self.norm = BoundaryNorm(np.arange(count + 1) - 0.5, count)
        else:
            if not high > low:  # one value only, or none
                low, high = (low - 0.5 * abs(low), low + 0.5 * abs(low)) if low else (0.0, 1.0)
            self.map = BOTH_WAYS if field.signed else RISING
            self.norm = Normalize(low, high)

    def of(self, values):
        return self.map(self.norm(values))[:, :3]


def raster(snapshot, camera, rgb, bounds):
    """The picture of the bodies and of the ground, and its depth buffer, at the camera's resolution."""
    buffer = spheres.DepthBuffer(camera.width, camera.height)
    x, y, z, scale = camera.project(snapshot.position)
    ball = snapshot.is_sphere
    spheres.draw_spheres(buffer, np.where(ball, x, np.nan), y, z, scale, snapshot.radius)
    count = len(snapshot.radius)
    flats = shading.Flats(np.zeros((0, 3)), np.zeros((0, 3)))
    if not ball.all():
        faces = polyhedra.Faces(snapshot, np.flatnonzero(~ball), camera)
        draw_corners(buffer, camera, faces.corner, count + faces.face)
        one = np.unique(faces.face, return_index=True)[1]
        flats = shading.Flats(rgb[faces.body[one]], faces.normal[one] @ camera.axes.T)
    slopes, last = [], count + len(flats.normals)
    for terrain in snapshot.grounds:
        corners, normal = terrain.triangles(bounds, camera.pixels_per_metre / SUPERSAMPLING)
        at_x, at_y = draw_corners(buffer, camera, corners, last + np.arange(len(corners)))
        slopes.append(triangles.linear_over(at_x, at_y, normal @ camera.axes.T))
        last += len(corners)
    slopes = [np.concatenate(parts) for parts in zip(*slopes)] or [np.zeros((0, 3))] * 3
    radius = (float(np.median(snapshot.radius * scale)), float(np.median(snapshot.radius))) if count else (1.0, 1.0)
    balls = shading.Balls(rgb, x, y, scale, snapshot.radius)
    return shading.shade(buffer, balls, flats, shading.Slopes(ground.STONE, *slopes), radius), buffer


def draw_corners(buffer, camera, corners, index):
    """Where they are in the picture."""
    x, y, z, _ = (values.reshape(-1, 3) for values in camera.project(corners.reshape(-1, 3)))
    triangles.draw_triangles(buffer, x, y, z, index)
    return x, y


def draw_walls(axes, snapshot, camera, bounds, buffer):
    """Strong where they are in front, faint where bodies hide them."""
    tolerance = 0.25 * float(np.median(snapshot.radius)) if len(snapshot.radius) else 0.0
    for wall in snapshot.walls:
        for points, is_edge in walls.lines_of(wall, bounds, camera):
            x, y, z, _ = camera.project(points)
            known = np.isfinite(x + y)
            column = np.clip(np.where(known, x, 0.0), 0, camera.width - 1).astype(int)
            row = np.clip(np.where(known, y, 0.0), 0, camera.height - 1).astype(int)
            behind = z < buffer.depth[row, column] - tolerance
            # 0: not drawn, 1: in front, 2: behind bodies; each run of one kind is a line of its own
            kind = np.where(known, np.where(behind, 2, 1), 0)
            for value, alpha in ((1, 0.85 if is_edge else 0.28), (2, 0.22 if is_edge else 0.0)):
                runs = list(pieces(np.column_stack([x, y]), kind, value)) if alpha > 0.0 else []
                if runs:
                    axes.add_collection(LineCollection(runs, colors=BLACK, alpha=alpha, capstyle="butt",
                                                       linewidths=1.1 if is_edge else 0.6))


def pieces(points, kind, value):
    """The parts of a line where `kind` has the value; each begins at the point before, so that no gap is left."""
    for part in np.split(np.arange(len(kind)), np.flatnonzero(np.diff(kind)) + 1):
        if kind[part[0]] == value:
            before = part[0] - 1
            yield points[before if before >= 0 and kind[before] else part[0]:part[-1] + 1]


def nice_length(longest):
    """The largest of 1, 2, 5 times a power of ten that is at most `longest`."""
    power = 10.0 ** np.floor(np.log10(longest))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= longest * (1.0 + 1e-9))


def length_text(length):
    for size, unit in ((1e3, "km"), (1.0, "m"), (1e-2, "cm"), (1e-3, "mm"), (1e-6, "µm")):
        if length >= size * (1.0 - 1e-9):
            return f"{length / size:.4g} {unit}"
    return f"{length:.3g} m"


def time_text(time):
    return f"{time:.3f} s" if time == 0.0 or abs(time) >= 0.01 else f"{time:.4g} s"


def draw_frame(snapshot, field, colours, camera, bounds, path):
    """Writes one PNG. The camera's pixels are SUPERSAMPLING times finer than the picture's."""
    image, buffer = raster(snapshot, camera, colours.of(field.values), bounds)
    image = shading.shrink(image, SUPERSAMPLING)
    height, width = image.shape[:2]
    left, right, above, below = 24, 116, 52, 56  # pixels around the picture
    full_width = max(left + width + right, 420)
    left += (full_width - left - width - right) // 2
    total = (full_width, above + height + below)
    figure = plt.figure(figsize=(total[0] / DOTS_PER_INCH, total[1] / DOTS_PER_INCH), dpi=DOTS_PER_INCH)
    place = [left / total[0], 1.0 - (above + height) / total[1], width / total[0], height / total[1]]
    axes = figure.add_axes(place)
    axes.imshow(image, interpolation="nearest", extent=(0, camera.width, camera.height, 0), aspect="auto")
    axes.set_xlim(0, camera.width)
    axes.set_ylim(camera.height, 0)
    axes.axis("off")
    draw_walls(axes, snapshot, camera, bounds, buffer)

    def text(x, y, what, **style):
        figure.text(x / total[0], 1.0 - y / total[1], what, color=BLACK, **style)

    title = shorten(snapshot.title or snapshot.path.stem, full_width)
    count = f"{len(snapshot.radius):,}".replace(",", "\u2009") + (" body" if len(snapshot.radius) == 1 else " bodies")
    text(left, 20, title, fontsize=11, fontweight="bold", va="center")
    text(left, 39, f"t = {time_text(snapshot.time)}     {count}", fontsize=9, va="center")
    metre = camera.pixels_per_metre / SUPERSAMPLING
    length = nice_length(0.3 * width / metre)
    bar = figure.add_axes([left / total[0], (below - 26) / total[1], length * metre / total[0], 4 / total[1]])
    bar.set_facecolor(BLACK)
    bar.set(xticks=[], yticks=[])
    bar.grid(False)
    text(left, above + height + 40, length_text(length) + ("" if camera.parallel else " at the middle"), fontsize=8.5,
         va="center")
    beside = [(left + width + 18) / total[0], place[1] + 0.15 * place[3], 12 / total[0], 0.7 * place[3]]
    colour_bar(figure, colours, beside, field.values)
    figure.savefig(path, dpi=DOTS_PER_INCH)
    plt.close(figure)


def shorten(title, pixels):
    most = int(pixels / 8.5)
    return title if len(title) <= most else title[:most - 1].rstrip() + "…"


def colour_bar(figure, colours, place, values):
    axes = figure.add_axes(place)
    extend = "neither"
    if not colours.names and len(values):
        over, under = values.max() > colours.norm.vmax, values.min() < colours.norm.vmin
        extend = "both" if over and under else "max" if over else "min" if under else "neither"
    bar = figure.colorbar(ScalarMappable(colours.norm, colours.map), cax=axes, extend=extend, extendfrac=0.03)
    bar.outline.set_linewidth(0.5)
    bar.set_label(colours.label, fontsize=9)
    axes.tick_params(labelsize=8, length=2.5, width=0.6)
    axes.grid(False)
    if colours.names:
        bar.set_ticks(range(len(colours.names)), labels=colours.names)
