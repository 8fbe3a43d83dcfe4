#!/usr/bin/python3
"""Draws how the work of a run was shared by its ranks: imbalance and waiting over time, time by phase of each rank."""
import argparse
import functools
import pathlib

from pictures import errors, rank_panels, runs, sheet
from pictures.errors import PictureError


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
    title = f"{summary.get('title') or 'Run'}: ranks"
    sheet.draw([functools.partial(panel, records=records, section=section) for panel in panels], title,
               facts_of(section), target, size=(5.2, 3.2))


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
