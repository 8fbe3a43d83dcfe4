"""The panels of plot_run.py. Each function takes (axes, history, summary) and fills one panel, or belongs to an entry
of `choose` that says when it is there."""
import numpy as np

from . import series
from .style import BLACK, BLUE, CYCLE, GREEN, GREY, ORANGE, quantity_label

# Measures whose columns jump from step to step, and so are drawn as means over short times.
JUMPY = ("mass_rate", "number_rate", "force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z")


def finish(axes, title, unit, text, time=True, legend=True):
    axes.set_title(title)
    axes.set_ylabel(quantity_label(text, unit))
    if time:
        axes.set_xlabel("Time [s]")
        axes.margins(x=0.01)
    if legend and len(axes.get_legend_handles_labels()[0]) > 1:
        axes.legend(loc="best")


def window_means(summary):
    """{column: (value, from, until, unit)} of the scalar means in the summary's measures, however they are nested."""
    found = {}

    def visit(node, name):
        if isinstance(node, list):
            for item in node:
                visit(item, name)
        elif isinstance(node, dict):
            name = node.get("column") or node.get("name") or name
            value = node.get("mean", node.get("value"))
            if isinstance(value, list) and len(value) == 1:
                value = value[0]
            if isinstance(value, (int, float)) and "from" in node and name:
                found[name] = (float(value), node["from"], node.get("until", np.inf), str(node.get("unit", "")))
            for key, item in node.items():
                if isinstance(item, (dict, list)):
                    visit(item, f"{name}.{key}" if name and not node.get("column") else key)

    visit(summary.get("measures") or {}, "")
    return found


def quantity(columns, title):
    """A panel for columns of one kind: [(measure, column)]."""
    def panel(axes, history, summary):
        means = window_means(summary)
        jumpy = columns[0][1].name.rsplit(".", 1)[-1] in JUMPY
        width = None
        for (measure, column), colour in zip(columns, CYCLE * (len(columns) // len(CYCLE) + 1)):
            if jumpy:
                width = series.smooth(axes, history.time, column.values, colour, measure)
            else:
                series.draw(axes, history.time, column.values, colour, measure, band=False)
            if column.name in means:
                value, start, end, unit = means[column.name]
                start, end = max(float(start), history.time[0]), min(float(end), history.time[-1])
                axes.plot([start, end], [value, value], color=colour, linestyle=(0, (4, 2)), linewidth=1.1)
                axes.annotate(f"mean {value:.4g}", (end, value), xytext=(-2, 3), textcoords="offset points", fontsize=8,
                              ha="right", va="bottom", color=colour,
                              bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8})
        if width is not None:
            series.note(axes, f"means over {width * 1e3:.3g} ms")
        column = columns[0][1]
        finish(axes, title, column.unit, column.name.rsplit(".", 1)[-1].replace("_", " "))
    return panel


def energy(axes, history, summary):
    """Changes since the start: what the potential energy gives goes into motion and into the work of each law."""
    def draw(values, colour, label, **style):
        series.line(axes, *thin(history.time, values), colour, label, **style)

    draw(history["kinetic_energy"].values, BLUE, "kinetic")
    if "potential_energy" in history:
        potential = history["potential_energy"].values
        draw(potential - potential[0], BLACK, "potential, change")
    laws = [(name[5:], column.values) for name, column in history.columns.items()
            if name.startswith("work.") and np.any(column.values != 0.0)]
    for (law, values), colour in zip(laws, [ORANGE, GREEN] + CYCLE[3:6] + CYCLE):
        draw(values, colour, f"work of {law}", linestyle=(0, (5, 1.5)))
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.4 * (high - low))  # room for the legend
    finish(axes, "Energy since the start", history["kinetic_energy"].unit or "J", "energy", legend=False)
    axes.legend(loc="upper left", ncols=2, columnspacing=1.2)


def imbalance(axes, history, summary):
    scale = energy_range(history)
    size = np.abs(history["energy_imbalance"].values) / scale
    logarithmic(axes, history.time, [(size, BLUE, None)])
    finish(axes, "Energy that the ledger does not explain", "", "share of the energy range")
    if not np.any(size > 0):
        series.note(axes, "exactly 0 throughout")


def residual(axes, history, summary):
    lines = [(history["residual_rms"].values, BLUE, "rms")]
    if "residual_max" in history:
        lines.insert(0, (history["residual_max"].values, ORANGE, "largest contact"))
    logarithmic(axes, history.time, lines)
    finish(axes, "Residual of the contact problem", "", "scaled residual")


def sweeps(axes, history, summary):
    series.draw(axes, history.time, history["sweeps"].values, BLUE)
    axes.set_ylim(bottom=0)
    finish(axes, "Sweeps a step", "", "sweeps")


def penetration(axes, history, summary):
    relative = "penetration_max_relative" in history
    suffix, factor, unit = ("_relative", 100.0, "% of d") if relative else ("", 1.0, history["penetration_max"].unit)
    lines = [(factor * history["penetration_max" + suffix].values, ORANGE, "largest")]
    if "penetration_mean" + suffix in history:
        lines.append((factor * history["penetration_mean" + suffix].values, BLUE, "mean"))
    logarithmic(axes, history.time, lines)
    finish(axes, "Penetration", unit, "depth")


def counts(axes, history, summary):
    for name, colour in (("contacts", ORANGE), ("bodies", BLUE)):
        if name in history:
            series.draw(axes, history.time, history[name].values, colour, name)
    axes.set_ylim(bottom=0)
    finish(axes, "Size of the problem", "", "number")


def phases(axes, history, summary):
    """Wall time by phase, as bars with their shares."""
    times = [(name, float(value)) for name, value in phase_times(summary)]
    times.sort(key=lambda item: item[1])
    total = sum(value for _, value in times)
    axes.barh([name for name, _ in times], [value for _, value in times], color=BLUE, height=0.65)
    for i, (_, value) in enumerate(times):
        axes.text(value, i, f"  {100.0 * value / total:.1f} %", va="center", fontsize=8, color=GREY)
    axes.set_xlim(right=1.18 * max(value for _, value in times))
    axes.grid(axis="y", visible=False)
    axes.set_title(f"Wall time by phase, {total:.3g} s in all")
    axes.set_xlabel("Wall time [s]")


def profile(measure, column):
    """A profile along an axis: its mean over the rows of the history's last half, and its last row."""
    def panel(axes, history, summary):
        late = history.time >= 0.5 * (history.time[0] + history.time[-1])
        with np.errstate(all="ignore"):
            mean = np.nanmean(column.values[late], axis=0)
        place = np.arange(column.values.shape[1]) + 0.5
        axes.plot(column.values[-1], place, color=ORANGE, linewidth=0.9, label="at the end")
        axes.plot(mean, place, color=BLUE, label="mean of the last half")
        axes.set_title(f"Profile: {measure}")
        axes.set_xlabel(quantity_label(column.name.rsplit(".", 1)[-1].replace("_", " "), column.unit))
        axes.set_ylabel("Bin along the axis")
        axes.legend(loc="best")
    return panel


def logarithmic(axes, time, lines):
    """Lines on a logarithmic axis; zeros are left out."""
    for values, colour, label in lines:
        values = np.where(values > 0.0, values, np.nan)
        if np.isfinite(values).any():
            series.draw(axes, time, values, colour, label)
    if axes.lines:
        axes.set_yscale("log")


def thin(time, values, most=2000):
    step = max(len(time) // most, 1)
    return time[::step], values[::step]


def energy_range(history):
    ranges = [np.ptp(history[name].values) for name in ("kinetic_energy", "potential_energy") if name in history]
    return max(max(ranges, default=0.0), 1e-300)


def phase_times(summary):
    phases = summary.get("time_by_phase")
    if not isinstance(phases, dict):
        return []
    return [(name, value) for name, value in phases.items() if isinstance(value, (int, float)) and value > 0.0]


def choose(history, summary):
    """The panels that this run has data for, in order."""
    chosen = []
    groups = {}
    profiles = []
    for name, column in history.columns.items():
        measure, _, kind = name.rpartition(".")
        if not measure or measure == "work":
            continue
        if column.values.ndim > 1 and column.values.shape[1] > 1:
            profiles.append(profile(measure, column))
        else:
            groups.setdefault((kind, column.unit), []).append((measure, column))
    titles = {"mass_rate": "Flow rate", "force_z": "Force on walls, vertical", "force_x": "Force on walls, along x",
              "force_y": "Force on walls, along y"}
    order = ["mass_rate", "passed_mass", "mass", "force_z"]
    quiet = ("number_rate", "torque_x", "torque_y", "torque_z")  # in the file, but rarely what one looks for first
    for kind, unit in sorted(groups, key=lambda key: (order.index(key[0]) if key[0] in order else len(order), key[0])):
        if kind not in quiet:
            title = titles.get(kind, kind.replace("_", " ").capitalize())
            chosen.append(quantity(groups[kind, unit], title))
    for names, panel in ((("kinetic_energy",), energy), (("energy_imbalance", "kinetic_energy"), imbalance),
                         (("residual_rms",), residual), (("sweeps",), sweeps), (("penetration_max",), penetration),
                         (("contacts",), counts)):
        if all(name in history for name in names):
            chosen.append(panel)
    if phase_times(summary):
        chosen.append(phases)
    return chosen + profiles
