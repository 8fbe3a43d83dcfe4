"""The runout of a flow: a map with the deposit over the hill-shaded ground, and a profile before and after."""
import matplotlib.patheffects as effects
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LightSource, Normalize
from mpl_toolkits.axes_grid1.inset_locator import inset_axes

from .frame import length_text, nice_length
from .rasters import volumes
from .shading import box_blur
from .style import BLACK, BLUE, GREY, quantity_label

DEEP = LinearSegmentedColormap.from_list("deep", ["#fff3c4", "#fdc65b", "#f2873a", "#c8442e", "#7c1d3f", "#3a0f3d"])
HALO = [effects.withStroke(linewidth=2.4, foreground="white")]
CONTOURS = 14  # about so many over the heights of the map
BINS = 160  # of the profile
BAND = 0.06  # width of the profile's band over its length, at least three cells


def nice_step(span, count):
    return nice_length(max(span / count, 1e-9) * 1.5)


class Map:
    """Seen from above, x to the right and y upwards."""

    def __init__(self, axes, bounds, ground):
        self.axes, self.bounds, self.ground = axes, bounds, ground
        (x0, y0), (x1, y1) = bounds
        axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", xlabel="x [m]", ylabel="y [m]")
        axes.grid(False)
        axes.ticklabel_format(useOffset=False, style="plain")
        axes.locator_params(nbins=6)
        for side in axes.spines.values():
            side.set_visible(True)

    def draw_ground(self):
        if self.ground is None or self.ground.height is None:
            return
        (x0, y0), (x1, y1) = self.bounds
        columns = slice(max(np.searchsorted(self.ground.x, x0) - 2, 0), np.searchsorted(self.ground.x, x1) + 2)
        rows = slice(max(np.searchsorted(self.ground.y, y0) - 2, 0), np.searchsorted(self.ground.y, y1) + 2)
        x, y, z = self.ground.x[columns], self.ground.y[rows], self.ground.height[rows, columns]
        if min(z.shape) < 2 or not np.isfinite(z).any():
            return
        dx, dy = x[1] - x[0], y[1] - y[0]
        filled = np.where(np.isfinite(z), z, np.nanmean(z))
        shade = LightSource(azdeg=315, altdeg=45).hillshade(filled[::-1], vert_exag=1.0, dx=dx, dy=dy)[::-1]
        shade = np.where(np.isfinite(z), 0.62 + 0.38 * shade, 1.0)
        self.axes.imshow(np.repeat(shade[:, :, None], 3, axis=2), origin="lower", interpolation="bilinear",
                         extent=(x[0] - dx / 2, x[-1] + dx / 2, y[0] - dy / 2, y[-1] + dy / 2), zorder=0)
        step = nice_step(np.nanmax(z) - np.nanmin(z), CONTOURS)
        levels = np.arange(np.floor(np.nanmin(z) / step), np.ceil(np.nanmax(z) / step) + 1) * step
        strong = np.isclose(np.mod(levels / step + 0.5, 5.0), 0.5)
        lines = self.axes.contour(x, y, z, levels=levels, colors="#5a5348", alpha=0.75, zorder=3,
                                  linewidths=np.where(strong, 0.8, 0.35))
        labels = self.axes.clabel(lines, levels=levels[strong] if strong.any() else levels[::3], fontsize=6.5,
                                  fmt="%g", colors="#3f3a31")
        for label in labels:
            label.set_path_effects(HALO)
        self.axes.set(xlim=(x0, x1), ylim=(y0, y1))

    def draw_raster(self, raster, above):
        shown = np.ma.masked_where(~(raster.values > above), raster.values)
        norm = Normalize(0.0, float(np.percentile(shown.compressed(), 99.5)) if shown.count() else 1.0)
        self.axes.pcolormesh(raster.x, raster.y, shown, cmap=DEEP, norm=norm, alpha=0.88, zorder=2, linewidth=0,
                             rasterized=True)
        bar_axes = inset_axes(self.axes, width=0.11, height="46%", loc="lower left",
                              bbox_to_anchor=(1.02, 0.0, 1, 1), bbox_transform=self.axes.transAxes, borderpad=0)
        bar = self.axes.figure.colorbar(ScalarMappable(norm, DEEP), cax=bar_axes,
                                        extend="max" if shown.count() and shown.max() > norm.vmax else "neither")
        bar.outline.set_linewidth(0.5)
        bar.set_label(quantity_label(raster.label, raster.unit), fontsize=8.5)
        bar_axes.tick_params(labelsize=7.5, length=2.5, width=0.6)
        bar_axes.grid(False)

    def draw_outline(self, raster, above, label, **style):
        # A cell counts if it and its neighbours mostly do: no island for each gap between bodies.
        covered = (box_blur((raster.values > above).astype(float), 1) > 0.4).astype(float)
        if covered.any():
            x, y = raster.centres()
            # a frame of nothing, so that the outline closes
            x = np.concatenate([[2 * x[0] - x[1]] if len(x) > 1 else [x[0] - 1], x,
                                [2 * x[-1] - x[-2]] if len(x) > 1 else [x[0] + 1]])
            y = np.concatenate([[2 * y[0] - y[1]] if len(y) > 1 else [y[0] - 1], y,
                                [2 * y[-1] - y[-2]] if len(y) > 1 else [y[0] + 1]])
            self.axes.contour(x, y, np.pad(covered, 1), levels=[0.5], zorder=4, **style)
            self.axes.plot([], [], label=label, color=style["colors"], linestyle=style.get("linestyles", "-"),
                           linewidth=style["linewidths"])

    def draw_tracks(self, tracks):
        for k, way in enumerate(tracks):
            self.axes.plot(way[:, 0], way[:, 1], color=BLUE, linewidth=0.6, alpha=0.75, zorder=5,
                           label="trajectories" if k == 0 else None)

    def draw_line(self, line):
        self.axes.plot(*line.corners.T, color=BLACK, linewidth=1.1, linestyle=(0, (5, 3)), zorder=6,
                       path_effects=HALO)
        for name, place in (("A", line.corners[0]), ("A′", line.corners[-1])):
            self.axes.plot(*place, "o", color=BLACK, markersize=3.5, zorder=7)
            self.axes.annotate(name, place, xytext=(5, 5), textcoords="offset points", fontsize=9.5,
                               fontweight="bold", path_effects=HALO, zorder=7)

    def draw_scale(self):
        (x0, y0), (x1, y1) = self.bounds
        length = nice_length(0.25 * (x1 - x0))
        x, y = x0 + 0.04 * (x1 - x0), y0 + 0.05 * (y1 - y0)
        self.axes.plot([x, x + length], [y, y], color=BLACK, linewidth=3.5, solid_capstyle="butt", zorder=8,
                       path_effects=HALO)
        self.axes.annotate(length_text(length), (x, y), xytext=(0, 5), textcoords="offset points", fontsize=8.5,
                           path_effects=HALO, zorder=8)


class Profile:
    """Heights along a line; depths are means over a band about it."""

    def __init__(self, axes, line, ground, cell, solid_fraction, shown):
        """`shown` (n, 3): places that it must not cut off."""
        self.axes, self.line, self.ground, self.solid_fraction = axes, line, ground, solid_fraction
        margin = 0.04 * line.length
        self.width = max(BAND * line.length, 3.0 * cell)
        along, beside = line.place_of(shown[:, :2])
        behind = along[beside < 0.5 * self.width].min(initial=0.0)
        self.borders = np.linspace(min(behind, 0.0) - margin, line.length + margin, BINS + 1)
        self.s = 0.5 * (self.borders[1:] + self.borders[:-1])
        axes.set(ylabel="Height [m]", xlim=(self.borders[0], self.borders[-1]))
        if ground is not None and ground.height is not None:
            self.base = ground.height_at(*line.at(self.s).T)
            axes.fill_between(self.s, self.base, np.nanmin(self.base) - 1e6, color="#cfc8bb", linewidth=0, zorder=1)
            axes.plot(self.s, self.base, color="#5a5348", linewidth=1.0, zorder=3)
        else:
            self.base = np.zeros(BINS)
            axes.axhline(0.0, color="#5a5348", linewidth=1.0)
        self.low, self.high = float(np.nanmin(self.base)), float(np.nanmax(self.base))

    def depth(self, snapshot):
        along, beside = self.line.place_of(snapshot.position[:, :2])
        near = beside < 0.5 * self.width
        volume, _ = np.histogram(along[near], bins=self.borders, weights=volumes(snapshot)[near])
        return volume / (self.width * (self.borders[1] - self.borders[0]) * self.solid_fraction)

    def draw_depth(self, snapshot, label, colour, depths):
        """In the profile, and by itself in the axes `depths`."""
        depth = self.depth(snapshot)
        depths.fill_between(self.s, 0.0, depth, color=colour, alpha=0.3, linewidth=0)
        depths.plot(self.s, depth, color=colour, linewidth=1.1)
        top = self.base + depth
        self.axes.fill_between(self.s, self.base, top, color=colour, alpha=0.75, linewidth=0.6, zorder=2, label=label)
        self.high = max(self.high, float(np.nanmax(top)))

    def finish(self, crest, toe):
        if crest is not None and np.isfinite(toe).all():
            along, _ = self.line.place_of(np.array([crest[:2], toe[:2]]))
            height, length = crest[2] - toe[2], np.linalg.norm(np.subtract(crest[:2], toe[:2]))
            self.axes.plot(along, [crest[2], toe[2]], color=GREY, linewidth=0.9, linestyle=(0, (5, 3)), zorder=4,
                           label=f"H/L = {height / length:.3f} ({np.degrees(np.arctan2(height, length)):.1f}°), "
                                 f"H = {height:.4g} m, L = {length:.4g} m")
            self.high = max(self.high, crest[2])
        span = max(self.high - self.low, 1e-9)
        self.axes.set_ylim(self.low - 0.06 * span, self.high + 0.12 * span)
        self.axes.legend(loc="upper right")
        box = self.axes.get_position()
        figure = self.axes.figure.get_size_inches()
        ratio = (box.height * figure[1] / (1.18 * span)) / (box.width * figure[0] / np.ptp(self.borders))
        self.axes.text(0.01, 0.03, f"heights × {ratio:.2g}; depths are means over {length_text(self.width)} across",
                       transform=self.axes.transAxes, fontsize=7.5, color=BLACK, path_effects=HALO, zorder=6)
