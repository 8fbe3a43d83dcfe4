"""The panels of plot_ranks.py: how the work of a run was shared by its ranks, and what each rank did."""
import json
import pathlib

import numpy as np

from . import series
from .errors import PictureError
from .measure_panels import finish, legend
from .style import BLUE, CYCLE, GREEN, GREY, ORANGE, PALE

IN_STEPS = ("detection", "setup", "solve", "integration", "correction")
MOST_NAMED = 16  # ranks with a tick each


def read_records(run):
    """The records {"kind": "ranks"} of run.jsonl in order of time; a resumed run repeats what came after a checkpoint."""
    path = pathlib.Path(run) / "run.jsonl"
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise PictureError(f"{path} cannot be read ({error.strerror or error})") from error
    records = []
    for line in lines:
        try:
            record = json.loads(line)
        except ValueError:  # the half line of a killed run
            continue
        if record.get("kind") != "ranks":
            continue
        while records and records[-1]["time"] >= record["time"]:
            records.pop()
        records.append(record)
    return records


def column(records, name, part):
    return np.array([record[name][part] for record in records], float)


def imbalance(axes, records, section):
    time = np.array([record["time"] for record in records])
    series.line(axes, time, np.array([record["imbalance"] for record in records]), BLUE, "work")
    bodies = column(records, "bodies", "max") / np.maximum(column(records, "bodies", "mean"), 1e-300)
    series.line(axes, time, bodies, ORANGE, "bodies")
    axes.axhline(1.0, color=GREY, linewidth=0.6)
    finish(axes, "Imbalance: largest over mean", "", "imbalance")
    axes.set_ylim(bottom=min(0.98, axes.get_ylim()[0]))


def waiting(axes, records, section):
    """Of the time in steps, the share that was spent waiting for other ranks: mean, and from the least to the most."""
    time = np.array([record["time"] for record in records])
    work, wait = column(records, "work", "mean"), column(records, "wait", "mean")
    total = np.maximum(work + wait, 1e-300)
    series.line(axes, time, 100.0 * wait / total, BLUE)
    axes.fill_between(time, 100.0 * column(records, "wait", "min") / total,
                      np.minimum(100.0 * column(records, "wait", "max") / total, 100.0), color=BLUE, alpha=0.18,
                      linewidth=0)
    axes.set_ylim(bottom=0)
    finish(axes, "Waiting for other ranks", "% of the time in steps", "waiting")


def held(axes, records, section):
    time = np.array([record["time"] for record in records])
    for name, colour in (("bodies", BLUE), ("ghosts", ORANGE), ("contacts", GREEN)):
        series.line(axes, time, column(records, name, "mean"), colour, name)
        axes.fill_between(time, column(records, name, "min"), column(records, name, "max"), color=colour, alpha=0.18,
                          linewidth=0)
    axes.set_ylim(bottom=0)
    finish(axes, "Held by a rank: mean, least to most", "", "number")


def bars(axes, count, stacks):
    """One bar a rank; `stacks`: (label, colour, values)."""
    base = np.zeros(count)
    width = 0.75 if count <= MOST_NAMED else 1.0
    for label, colour, values in stacks:
        axes.bar(np.arange(count), values, width, bottom=base, color=colour, label=label)
        base += values
    if count <= MOST_NAMED:
        axes.set_xticks(np.arange(count))
    axes.set_xlabel("Rank")
    axes.grid(axis="x", visible=False)
    axes.margins(x=0.02, y=0.1)
    legend(axes)


def times(axes, records, section):
    each, count = section["each"], section["number"]
    names = [name for name in section["time_by_phase"] if sum(each[name]) > 0.0]
    colours = dict(zip(names, CYCLE))
    # Waiting is a part of the phases in steps; it is drawn apart, and taken from them in proportion.
    wait = np.array(each["wait"], float)
    steps = np.maximum(sum(np.array(each[name], float) for name in IN_STEPS), 1e-300)
    stacks = []
    for name in names:
        seconds = np.array(each[name], float)
        stacks.append((name, colours[name], seconds * (1.0 - wait / steps) if name in IN_STEPS else seconds))
    bars(axes, count, stacks + [("waiting", PALE, wait)])
    axes.set_title("Time by phase")
    axes.set_ylabel("Wall time [s]")


def parts(axes, records, section):
    each = section["each"]
    bars(axes, section["number"], [("own bodies", BLUE, np.array(each["bodies"], float)),
                                   ("copies of others", ORANGE, np.array(each["ghosts"], float))])
    axes.set_title("Bodies at the end")
    axes.set_ylabel("Bodies")


def choose(records, section):
    panels = [imbalance, waiting, held] if records else []
    return panels + ([times, parts] if section else [])
