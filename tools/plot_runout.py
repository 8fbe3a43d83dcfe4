#!/usr/bin/python3
"""Draws how far a flow ran: a map of the deposit over the ground, and a profile before and after."""
import argparse
import pathlib

import numpy as np

from pictures import errors, runs
from pictures.errors import PictureError
from pictures.rasters import LABELS, Rasters, cells_about, depth_of
from pictures.runout import Map, Profile
from pictures.snapshots import Snapshot
from pictures.style import BLUE, BLACK, GREY, ORANGE, plt
from pictures.tracks import Line, Places, tracks_of, way_of_the_mass

MARGIN = 0.10  # around what flowed, over its size
WIDTH, LEFT = 9.8, 0.95  # inches


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", help="folder of the run")
    parser.add_argument("-o", "--output", metavar="PATH", help="the PNG (RUN/runout.png)")
    parser.add_argument("--raster", default="deposit", choices=sorted(LABELS), help="what the map shows (deposit)")
    parser.add_argument("--above", type=float, metavar="VALUE", help="show cells above this only (rasters.covered)")
    parser.add_argument("--line", metavar="X,Y X,Y ...", nargs="+",
                        help="corners of the profile's line (from the crest to the toe, along the middle of the bodies)")
    parser.add_argument("--tracks", type=int, metavar="N", help="at most so many trajectories (all)")
    options = parser.parse_args()
    if options.line is not None:
        try:
            options.line = [tuple(float(part) for part in corner.split(",")) for corner in options.line]
        except ValueError:
            parser.error("--line: places X,Y were expected")
        if len(options.line) < 2 or any(len(corner) != 2 for corner in options.line):
            parser.error("--line: two or more places X,Y were expected")
        if any(a == b for a, b in zip(options.line, options.line[1:])):
            parser.error("--line: two corners after one another are the same")
    return options


class Data:
    """What the pictures are made of."""

    def __init__(self, options):
        run = runs.require_run(options.run)
        paths = runs.snapshot_paths([run])
        self.run, self.before, self.after = run, Snapshot(paths[0]), Snapshot(paths[-1])
        if len(self.before.radius) == 0:
            raise PictureError(f"{paths[0]} has no bodies: there is nothing that could have run out")
        self.ground = next((g for g in self.after.grounds if g.height is not None), None)
        self.rasters = Rasters(run)
        self.covered = self.rasters.covered if options.above is None else options.above
        both = np.concatenate([self.before.position, self.after.position])
        cells = cells_about(self.ground, both.min(axis=0) - 1e-9, both.max(axis=0) + 1e-9, self.before.radius)
        if options.raster == "deposit" and "deposit" not in self.rasters:
            self.shown = depth_of(self.after, *cells, 1.0)
            self.shown.label = "deposit (solid)"
        else:
            self.shown = self.rasters[options.raster]
        self.release = depth_of(self.before, self.shown.x, self.shown.y, self.rasters.solid_fraction)
        self.flowed = self.rasters["flow_depth_max"] if "flow_depth_max" in self.rasters else None
        places = Places(paths)
        self.tracks = tracks_of(run, places)[:options.tracks]
        self.crest, self.toe = self.ends()
        self.line = options.line or way_of_the_mass(self.crest, self.toe, places.middles)

    def ends(self):
        """Crest and toe as the summary has them, else from the first and the last snapshot."""
        figures = runs.read_summary(self.run).get("runout", {})
        if figures and np.isfinite(figures["toe"]).all():
            return np.array(figures["top"]), np.array(figures["toe"])
        top = np.argmax(self.before.position[:, 2] + self.before.radius)
        crest = self.before.position[top] + [0.0, 0.0, self.before.radius[top]]
        way = np.linalg.norm(self.after.position[:, :2] - crest[:2], axis=1)
        toe = self.after.position[np.argmax(way)].copy() if len(way) else np.full(3, np.nan)
        return crest, toe

    def bounds(self):
        points = [self.before.position[:, :2], self.crest[None, :2], self.toe[None, :2]]
        for raster in filter(None, (self.shown, self.flowed)):
            rows, columns = np.nonzero(raster.values > self.covered)
            x, y = raster.centres()
            points.append(np.column_stack([x[columns], y[rows]]))
        points = np.concatenate(points)
        points = points[np.isfinite(points).all(axis=1)]
        low, high = points.min(axis=0), points.max(axis=0)
        margin = MARGIN * max(high - low) + 2.0 * (self.shown.x[1] - self.shown.x[0])
        low, high = low - margin, high + margin
        size = np.maximum(high - low, 0.45 * max(high - low))  # no slivers
        middle = 0.5 * (low + high)
        low, high = middle - 0.5 * size, middle + 0.5 * size
        if self.ground is None:
            return low, high
        first, last = self.ground.extent()  # nothing beyond the ground
        return np.maximum(low, first[:2]), np.minimum(high, last[:2])


def facts(data):
    text = f"t = {data.after.time:.4g} s"
    figures = runs.read_summary(data.run).get("runout")
    if figures:
        text += (f"     volume {figures['released_volume']:.4g} m³     deposit {figures['deposit']['area']:.4g} m², "
                 f"up to {figures['deposit']['depth_max']:.3g} m     centre of mass "
                 f"{figures['centre_of_mass']['length']:.4g} m on, H/L {figures['centre_of_mass']['height_over_length']:.3f}")
    return text


def draw(data, options, target):
    low, high = data.bounds()
    map_width = WIDTH - LEFT - 1.35
    map_height = min(max(map_width * (high[1] - low[1]) / (high[0] - low[0]), 2.5), 9.0)
    height = map_height + 5.4
    figure = plt.figure(figsize=(WIDTH, height))
    axes = figure.add_axes([LEFT / WIDTH, 4.25 / height, map_width / WIDTH, map_height / height])
    plan = Map(axes, (low, high), data.ground)
    plan.draw_ground()
    plan.draw_raster(data.shown, data.covered)
    plan.draw_outline(data.release, 0.0, "released", colors=ORANGE, linewidths=1.4)
    if data.flowed is not None:
        plan.draw_outline(data.flowed, data.covered, "flowed over", colors=GREY, linewidths=0.9, linestyles="--")
    plan.draw_tracks(data.tracks)
    line = Line(data.line)
    plan.draw_line(line)
    plan.draw_scale()
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize=8)
    below = figure.add_axes([LEFT / WIDTH, 1.75 / height, (WIDTH - LEFT - 0.2) / WIDTH, 1.95 / height])
    depths = figure.add_axes([LEFT / WIDTH, 0.5 / height, (WIDTH - LEFT - 0.2) / WIDTH, 1.05 / height], sharex=below)
    below.tick_params(labelbottom=False)
    depths.set(xlabel="Distance along A–A′ [m]", ylabel="Depth [m]")
    profile = Profile(below, line, data.ground, data.shown.x[1] - data.shown.x[0], data.rasters.solid_fraction,
                      data.before.position)
    profile.draw_depth(data.before, "before", ORANGE, depths)
    profile.draw_depth(data.after, "after", BLUE, depths)
    depths.set_ylim(bottom=0.0)
    profile.finish(data.crest, data.toe)
    figure.text(0.02, 1 - 0.2 / height, data.after.title or data.run.name, fontsize=14, fontweight="bold", va="top",
                color=BLACK)
    figure.text(0.02, 1 - 0.52 / height, facts(data), fontsize=8.8, color=GREY, va="top")
    try:
        figure.savefig(target, dpi=130)
    except OSError as error:
        raise PictureError(f"{target} cannot be written ({error.strerror or error})") from error


def main():
    options = arguments()
    data = Data(options)
    if options.line is None and not np.linalg.norm(data.crest[:2] - data.toe[:2]) > 0.0:
        raise PictureError("there is no runout: crest and toe are one place, or nothing is left; give a --line")
    target = pathlib.Path(options.output) if options.output else data.run / "runout.png"
    draw(data, options, target)
    print(target)
    return 0


if __name__ == "__main__":
    errors.run(main)
