"""The panels of plot_run.py that every run has. A panel is a function of (axes, history, summary)."""
import numpy as np

from . import measure_panels, series
from .measure_panels import finish, legend, number
from .style import BLACK, BLUE, CYCLE, GREEN, GREY, ORANGE, quantity_label


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
    axes.set_title("Energy since the start")
    axes.set_ylabel(quantity_label("energy", history["kinetic_energy"].unit or "J"))
    axes.set_xlabel("Time [s]")
    axes.margins(x=0.01)
    legend(axes, columns=2)


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
    times = sorted(phase_times(summary), key=lambda item: item[1])
    total = sum(value for _, value in times)
    axes.barh([name for name, _ in times], [value for _, value in times], color=BLUE, height=0.65)
    for i, (_, value) in enumerate(times):
        axes.text(value, i, f"  {100.0 * value / total:.1f} %", va="center", fontsize=8, color=GREY)
    axes.set_xlim(right=1.18 * max(value for _, value in times))
    axes.grid(axis="y", visible=False)
    axes.set_title(f"Wall time by phase, {total:.3g} s in all")
    axes.set_xlabel("Wall time [s]")


def logarithmic(axes, time, lines):
    """Lines on a logarithmic axis. Zeros are left out, and a few tiny values do not set the range."""
    lowest, highest = np.inf, 0.0
    for values, colour, label in lines:
        values = np.where(values > 0.0, values, np.nan)
        if np.isfinite(values).any():
            series.draw(axes, time, values, colour, label)
            lowest = min(lowest, max(0.5 * np.nanmin(values), 0.03 * np.nanpercentile(values, 5)))
            highest = max(highest, 2.0 * np.nanmax(values))
    if axes.lines:
        axes.set_yscale("log")
        axes.set_ylim(lowest, highest)


def thin(time, values, most=2000):
    step = max(len(time) // most, 1)
    return time[::step], values[::step]


def energy_range(history):
    ranges = [np.ptp(history[name].values) for name in ("kinetic_energy", "potential_energy") if name in history]
    return max(max(ranges, default=0.0), 1e-300)


def phase_times(summary):
    phases = summary.get("time_by_phase")
    times = [(name, number(value)) for name, value in phases.items()] if isinstance(phases, dict) else []
    return [(name, value) for name, value in times if value]


def choose(history, summary):
    """The panels that this run has data for, in order."""
    chosen, profiles = measure_panels.choose(history)
    for names, panel in ((("kinetic_energy",), energy), (("energy_imbalance", "kinetic_energy"), imbalance),
                         (("residual_rms",), residual), (("sweeps",), sweeps), (("penetration_max",), penetration),
                         (("contacts",), counts)):
        if all(name in history for name in names):
            chosen.append(panel)
    if phase_times(summary):
        chosen.append(phases)
    return chosen + profiles
