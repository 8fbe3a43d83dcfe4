#!/usr/bin/python3
"""Draws the history of a run on one page: flow rates, energies, residual, penetration, forces, time by phase."""
import argparse
import functools
import pathlib

from pictures import errors, runs, sheet
from pictures.errors import PictureError
from pictures.measure_panels import number
from pictures.panels import choose


def headline(history, summary):
    """Title and a line of facts."""
    title = summary.get("title") or runs.text_of(history.attributes.get("title", "")) or "Run"
    facts = []
    for key, words in (("bodies", "bodies at the end: {:,.0f}"), ("steps", "{:,.0f} steps"),
                       ("simulated_time", "{:.4g} s simulated"), ("wall_time", "{:.4g} s of wall time")):
        value = number(summary.get(key))
        if value is not None:
            facts.append(words.format(value).replace(",", "\u2009"))
    if not summary:
        facts.append("no summary yet: the run has not ended")
    elif summary.get("status", "complete") != "complete":
        facts.append(f"status: {summary['status']}")
    return title, "     ".join(facts)


def draw(run, target):
    history = runs.History(run / "history.h5")
    summary = runs.read_summary(run)
    panels = choose(history, summary)
    if not panels:
        raise PictureError(f"{run / 'history.h5'} has only the columns {', '.join(history.columns)}: nothing to draw")
    sheet.draw([functools.partial(panel, history=history, summary=summary) for panel in panels],
               *headline(history, summary), target, size=(4.6, 2.9))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", metavar="RUN", help="folder of a run")
    parser.add_argument("-o", "--output", metavar="FILE.png", help="picture to write (RUN/run.png)")
    options = parser.parse_args()
    run = runs.require_run(options.run)
    target = pathlib.Path(options.output) if options.output else run / "run.png"
    draw(run, target)
    print(target)
    return 0


if __name__ == "__main__":
    errors.run(main)
