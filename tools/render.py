#!/usr/bin/python3
"""Draws the bodies and walls of a run, from its snapshots alone: one picture, all of them, or a film."""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

from pictures import errors, runs
from pictures.camera import Camera, parse_view
from pictures.errors import PictureError
from pictures.frame import SUPERSAMPLING, Colours, draw_frame
from pictures.snapshots import FIELDS, Snapshot
from pictures.survey import Survey


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, epilog="Fields: " + ", ".join(FIELDS) + ", those of them that the snapshots hold.")
    parser.add_argument("source", nargs="+", metavar="RUN|SNAPSHOT", help="folder of a run, or snapshot files")
    parser.add_argument("--field", help="what colours the bodies (speed; radius if there are no velocities)")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"),
                        help="ends of the colours, in SI (from all pictures drawn)")
    parser.add_argument("--view", default="front",
                        help="front, side, top, perspective, or AZIMUTH,ELEVATION of the eye in degrees (front)")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--last", action="store_true", help="the last snapshot (the default)")
    which.add_argument("--frame", type=int, metavar="N", help="the Nth snapshot, from 0; -1 is the last")
    which.add_argument("--all", action="store_true", help="all snapshots")
    parser.add_argument("-o", "--output", metavar="PATH",
                        help="the PNG; with --all a folder (beside the snapshots: render.png, frames/)")
    parser.add_argument("--film", metavar="FILE.mp4", help="a film of all snapshots; needs ffmpeg")
    parser.add_argument("--rate", type=float, default=25.0, help="pictures a second in the film (25)")
    parser.add_argument("--pixels", type=int, default=900, help="longer side of the picture (900)")
    options = parser.parse_args()
    if not 50 <= options.pixels <= 8000:
        parser.error("--pixels: 50 to 8000 was expected")
    if options.rate <= 0.0:
        parser.error("--rate: a number above 0 was expected")
    parse_view(options.view)  # fails now rather than after all files have been read
    return options


def chosen(options):
    """The snapshot files to draw."""
    paths = runs.snapshot_paths(options.source)
    if options.all or options.film:
        return paths
    if options.frame is None:
        return paths[-1:] if options.last or pathlib.Path(options.source[0]).is_dir() else paths
    if not -len(paths) <= options.frame < len(paths):
        raise PictureError(f"no snapshot {options.frame}: there are {len(paths)}, numbered from 0", code=2)
    return [paths[options.frame]]


def output_paths(options, paths, scratch):
    if options.film:
        return [pathlib.Path(scratch) / f"{i:06d}.png" for i in range(len(paths))]
    source = pathlib.Path(options.source[0])
    home = source if source.is_dir() else source.parent
    if len(paths) == 1 and not options.all:
        return [pathlib.Path(options.output) if options.output else home / "render.png"]
    folder = pathlib.Path(options.output) if options.output else home / "frames"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise PictureError(f"the folder {folder} cannot be made ({error.strerror})") from error
    return [folder / f"{path.stem}.png" for path in paths]


def make_film(options, scratch):
    command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", str(options.rate), "-i", f"{scratch}/%06d.png",
               "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2",  # the coding of colours needs even numbers of pixels
               "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", options.film]
    result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if result.returncode:
        raise PictureError(f"ffmpeg could not write {options.film}: {result.stderr.strip()}")


def main():
    options = arguments()
    if options.film and not shutil.which("ffmpeg"):
        raise PictureError("--film needs ffmpeg (apt-get install ffmpeg); --all draws the pictures alone", code=2)
    paths = chosen(options)
    survey = Survey(paths, options.field)
    low, high = options.range or (survey.low, survey.high)
    bounds = (survey.lower, survey.upper)
    camera = Camera(options.view, *bounds, SUPERSAMPLING * options.pixels)
    with tempfile.TemporaryDirectory(prefix="scree-film-") as scratch:
        targets = output_paths(options, paths, scratch)
        for i, (path, target) in enumerate(zip(paths, targets)):
            snapshot = Snapshot(path)
            field = snapshot.field(survey.field_name)
            try:
                draw_frame(snapshot, field, Colours(field, low, high), camera, bounds, target)
            except OSError as error:
                raise PictureError(f"{target} cannot be written ({error.strerror or error})") from error
            if len(targets) > 1 and sys.stderr.isatty():
                print(f"\r{i + 1} of {len(targets)}", end="\n" if i + 1 == len(targets) else "", file=sys.stderr)
        if options.film:
            make_film(options, scratch)
    if options.film:
        print(options.film)
    else:
        print(targets[0] if len(targets) == 1 else f"{len(targets)} pictures in {targets[0].parent}")
    return 0


if __name__ == "__main__":
    errors.run(main)
