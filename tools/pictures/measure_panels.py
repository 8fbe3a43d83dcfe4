"""The panels of the measures that a scenario asks for. Columns: solvers/measure_columns.cpp."""
import re

import numpy as np

from . import series
from .style import BLUE, CYCLE, ORANGE, quantity_label

# quantity -> (title, label of the axis); measures that share a quantity share a panel
SHARED = {
    "mass_rate": ("Flow rate", "mass rate"),
    "passed_mass": ("Mass that has passed", "mass"),
    "mass": ("Mass in a region", "mass"),
    "value": ("Packing fraction", "packing fraction"),
    "mean": ("Contacts with an impulse, a body", "contacts"),
    "force_z": ("Force on walls, z", "force"),
    "force_x": ("Force on walls, x", "force"),
    "force_y": ("Force on walls, y", "force"),
}
EXTENT = {"highest": "highest", "centre_of_mass": "centre of mass", "lowest": "lowest"}
# Jump from step to step, and so are drawn as means over short times.
JUMPY = {"mass_rate", "force_x", "force_y", "force_z"}
# In the file, but rarely what one looks for first.
QUIET = {"number_rate", "passed_number", "number", "contacts", "rattlers", "solid_volume", "torque_x", "torque_y",
         "torque_z", "volume_per_length"}
SMALL_FORCE = 0.05  # of the largest component: below it, the other components get no panel


def number(value):
    """A number of the summary; YAML 1.1 takes 1e-05 for a text."""
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def window_mean(summary, column):
    """(mean, from, until) of a column in the summary, None if it is not there."""
    entry = (summary.get("measures") or {}).get(column.name)
    if not isinstance(entry, dict) or len(entry.get("window", ())) != 2:
        return None
    mean = entry.get("mean")
    mean = np.array([number(item) for item in mean], float) if isinstance(mean, list) else number(mean)
    start, end = map(number, entry["window"])
    return None if mean is None or start is None or end is None else (mean, start, end)


def finish(axes, title, unit, text, width=None):
    """Title and labels. `width`: [s] over which the lines are means."""
    axes.set_title(title)
    axes.set_ylabel(quantity_label(text, unit))
    axes.set_xlabel("Time [s]" if width is None else f"Time [s];  means over {width * 1e3:.3g} ms")
    axes.margins(x=0.01, y=0.1)
    if len(axes.get_legend_handles_labels()[0]) > 1:
        legend(axes)


def legend(axes, columns=3):
    """In a strip of its own above the lines; where it fits if the axis is logarithmic."""
    if axes.get_yscale() == "log":
        axes.legend(loc="best")
        return
    rows = -(-len(axes.get_legend_handles_labels()[0]) // columns)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + (0.06 + 0.12 * rows) * (high - low))
    axes.legend(loc="upper left", ncols=columns, columnspacing=1.2)


def lines(axes, history, summary, entries, jumpy):
    """One line for each (label, column), with its mean over the summary's window. Returns the time [s] over which each
    point is a mean, None if it is none."""
    width = None
    for (label, column), colour in zip(entries, CYCLE * (1 + len(entries) // len(CYCLE))):
        if jumpy:
            width = series.smooth(axes, history.time, column.values, colour, label)
        else:
            series.draw(axes, history.time, column.values, colour, label, band=False)
        mean = window_mean(summary, column)
        if mean is not None:
            value, start, end = mean
            start, end = max(start, history.time[0]), min(end, history.time[-1])
            if end - start > 0.95 * (history.time[-1] - history.time[0]):
                continue  # nobody chose a window: the mean over filling and flow says little
            axes.plot([start, end], [value, value], color=colour, linestyle=(0, (3, 1.5)), linewidth=1.3)
            size = float(np.nanmax(np.abs(column.values)))
            text = "0" if abs(value) < 1e-5 * size else f"{value:.4g}"
            axes.annotate(text, (end, value), xytext=(2, 4), textcoords="offset points", fontsize=8,
                          ha="right" if end > 0.5 * history.time[-1] else "left", va="bottom", color=colour,
                          bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6})
    return width


def shared(quantity, entries):
    title, label = SHARED.get(quantity, (quantity.replace("_", " ").capitalize(), quantity.replace("_", " ")))
    if len(entries) == 1:
        title += f": {entries[0][0]}"

    def panel(axes, history, summary):
        width = lines(axes, history, summary, entries, quantity in JUMPY)
        finish(axes, title, entries[0][1].unit, label, width)
    return panel


def extent(measure, columns):
    def panel(axes, history, summary):
        lines(axes, history, summary, [(EXTENT[name], columns[name]) for name in EXTENT if name in columns], False)
        finish(axes, f"Extent: {measure}", "m", "coordinate")
    return panel


def profile(measure, quantity, columns):
    """Profiles along an axis, at the end and as the mean of the window. `columns`: [(label, column)]."""
    first = columns[0][1]
    bins = first.values.shape[1]
    match = re.search(r"bins from (\S+) m to (\S+) m along \(([^)]*)\)", first.description)
    low, high = (float(match[1]), float(match[2])) if match else (0.0, float(bins))
    place = low + (np.arange(bins) + 0.5) * (high - low) / bins

    def panel(axes, history, summary):
        for (label, column), colour in zip(columns, [BLUE, ORANGE] + CYCLE[2:]):
            mean = window_mean(summary, column)
            axes.plot(column.values[-1], place, color=colour, linewidth=0.9 if mean else 1.4,
                      linestyle=(0, (1, 1)) if mean else "-", label=f"{label} at the end".strip())
            if mean is not None:
                axes.plot(mean[0], place, color=colour, label=f"{label} mean {mean[1]:.4g}–{mean[2]:.4g} s".strip())
        axes.set_title(f"Profile: {measure}")
        axes.set_xlabel(quantity_label(quantity.replace("_", " "), first.unit))
        axes.set_ylabel(f"Along ({match[3]}) [m]" if match else "Bin")
        axes.legend(loc="best")
    return panel


def wanted_forces(groups):
    """The components of wall forces that matter beside the largest."""
    sizes = {name: max(np.abs(np.nanmean(column.values)) if len(column.values) else 0.0 for _, column in groups[name])
             for name in ("force_x", "force_y", "force_z") if name in groups}
    return {name for name, size in sizes.items() if size >= SMALL_FORCE * max(sizes.values())}


def choose(history):
    """The panels of the measures that this run has, in order."""
    groups, extents, profiles = {}, {}, {}
    for name, column in history.columns.items():
        measure, _, quantity = name.rpartition(".")
        if not measure or measure == "work" or quantity in QUIET:
            continue
        if column.values.ndim > 1 and column.values.shape[1] > 1:
            kind, label = ("velocity", quantity[-1]) if quantity.startswith("velocity_") else (quantity, "")
            profiles.setdefault((measure, kind), []).append((label, column))
        elif quantity in EXTENT:
            extents.setdefault(measure, {})[quantity] = column
        else:
            groups.setdefault(quantity, []).append((measure, column))
    forces = wanted_forces(groups)
    order = [*SHARED, *sorted(set(groups) - set(SHARED))]
    panels = [shared(quantity, groups[quantity]) for quantity in order
              if quantity in groups and (not quantity.startswith("force_") or quantity in forces)]
    panels += [extent(measure, columns) for measure, columns in extents.items()]
    return panels, [profile(measure, kind, columns) for (measure, kind), columns in profiles.items()]
