"""A sheet of panels under a title and a line of facts."""
from .errors import PictureError
from .style import GREY, plt

COLUMNS = 3
HEAD = 0.62  # inches for title and facts


def draw(panels, title, facts, target, size):
    """Calls each panel with its axes and writes the picture; `size`: width and height of a panel [inches]."""
    columns = min(COLUMNS, len(panels))
    rows = -(-len(panels) // columns)
    height = size[1] * rows + 0.8
    figure, grid = plt.subplots(rows, columns, figsize=(size[0] * columns, height), squeeze=False,
                                layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.12, rect=(0, 0, 1, 1 - HEAD / height))
    for axes, panel in zip(grid.flat, panels):
        panel(axes)
    for axes in list(grid.flat)[len(panels):]:
        axes.set_visible(False)
    figure.text(0.012, 1 - 0.16 / height, title, fontsize=14, fontweight="bold", va="top")
    figure.text(0.012, 1 - 0.45 / height, facts, fontsize=9.5, color=GREY, va="top")
    try:
        figure.savefig(target, dpi=110)
    except OSError as error:
        raise PictureError(f"{target} cannot be written ({error.strerror or error})") from error
