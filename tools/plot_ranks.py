#!/usr/bin/python3
"""Draws how the work of a run was shared by its ranks: imbalance and waiting over time, time by phase of each rank."""
import argparse
import pathlib

from pictures import errors, rank_panels, runs
from pictures.errors import PictureError
from pictures.style import GREY, plt

COLUMNS = 3


def facts_of(section):
    if not section:
        return "no summary yet: the run has not ended"
    def count(value):
        return f"{value:,.0f}".replace(",", "\u2009")

    return (f"{count(section['number'])} ranks     imbalance {section['imbalance']:.3f}     "
            f"{100.0 * section['communication_share']:.1f} % of the time in steps waiting     "
            f"{count(section['messages'])} messages, {count(section['bytes'] / 1e6)} MB     "
            f"shared out anew {section['repartitions']} times")


def draw(run, target):
    summary = runs.read_summary(run)
    section = summary.get("ranks") or {}
    records = rank_panels.read_records(run)
    if section.get("number", 2) < 2 and not records:
        raise PictureError(f"the run in {run} had one rank: there is nothing to share")
    panels = rank_panels.choose(records, section)
    if not panels:
        raise PictureError(f"{run} says nothing about ranks yet")
    columns = min(COLUMNS, len(panels))
    rows = -(-len(panels) // columns)
    height = 3.2 * rows + 0.8
    figure, grid = plt.subplots(rows, columns, figsize=(5.2 * columns, height), squeeze=False, layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.12, rect=(0, 0, 1, 1 - 0.62 / height))
    for axes, panel in zip(grid.flat, panels):
        panel(axes, records, section)
    for axes in list(grid.flat)[len(panels):]:
        axes.set_visible(False)
    figure.text(0.012, 1 - 0.16 / height, f"{summary.get('title') or 'Run'}: ranks", fontsize=14, fontweight="bold",
                va="top")
    figure.text(0.012, 1 - 0.45 / height, facts_of(section), fontsize=9.5, color=GREY, va="top")
    try:
        figure.savefig(target, dpi=110)
    except OSError as error:
        raise PictureError(f"{target} cannot be written ({error.strerror or error})") from error


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", metavar="RUN", help="folder of a run on several ranks")
    parser.add_argument("-o", "--output", metavar="FILE.png", help="picture to write (RUN/ranks.png)")
    options = parser.parse_args()
    run = runs.require_run(options.run)
    target = pathlib.Path(options.output) if options.output else run / "ranks.png"
    draw(run, target)
    print(target)
    return 0


if __name__ == "__main__":
    errors.run(main)
