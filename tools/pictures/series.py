"""Lines over time that stay readable when a history has one row a step."""
import numpy as np

from .style import GREY


def binned(time, values, bins):
    """Mean, least and largest value in equal bins of time; bins without rows are left out."""
    edges = np.linspace(time[0], time[-1], bins + 1)
    index = np.clip(np.searchsorted(edges, time, side="right") - 1, 0, bins - 1)
    good = np.isfinite(values)
    index, kept = index[good], values[good]
    count = np.bincount(index, minlength=bins)
    used = count > 0
    mean = np.bincount(index, weights=kept, minlength=bins)[used] / count[used]
    low, high = np.full(bins, np.inf), np.full(bins, -np.inf)
    np.minimum.at(low, index, kept)
    np.maximum.at(high, index, kept)
    middle = 0.5 * (edges[1:] + edges[:-1])
    return middle[used], mean, low[used], high[used]


def line(axes, time, values, colour, label=None, **style):
    """Few rows are marked, so that one alone can be seen."""
    axes.plot(time, values, color=colour, label=label, marker="o" if len(time) < 12 else None, markersize=3.5, **style)


def draw(axes, time, values, colour, label=None, bins=300, band=True):
    """A line; with many rows the mean of bins, in a band from the least to the largest value."""
    values = np.asarray(values, dtype=float)
    if len(time) <= 2 * bins or time[-1] <= time[0]:
        line(axes, time, values, colour, label)
        return
    middle, mean, low, high = binned(time, values, bins)
    if band:
        axes.fill_between(middle, low, high, color=colour, alpha=0.18, linewidth=0)
    axes.plot(middle, mean, color=colour, label=label)


def smooth(axes, time, values, colour, label=None, bins=60):
    """A line of means over 1/60 of the run: for what jumps from step to step (flow through a surface, wall force).
    Returns the width of a bin [s], None if the rows were drawn as they are."""
    values = np.asarray(values, dtype=float)
    if len(time) <= bins or time[-1] <= time[0]:
        line(axes, time, values, colour, label)
        return None
    middle, mean, _, _ = binned(time, values, bins)
    axes.plot(middle, mean, color=colour, label=label)
    return (time[-1] - time[0]) / bins


def note(axes, text, y=0.98, ha="right"):
    """A remark in the panel's upper corner."""
    axes.text(0.99 if ha == "right" else 0.01, y, text, transform=axes.transAxes, ha=ha, va="top", fontsize=7.5,
              color=GREY)
