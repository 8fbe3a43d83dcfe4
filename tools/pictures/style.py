"""One look for all pictures. Colours: Okabe and Ito (2008), distinguishable with every kind of colour vision."""
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

BLUE, ORANGE, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
SKY, YELLOW, BLACK = "#56B4E9", "#E69F00", "#333333"
CYCLE = [BLUE, ORANGE, GREEN, PURPLE, SKY, YELLOW, BLACK]
GREY, PALE = "#6b6b6b", "#d9d9d9"

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 9,
    "axes.titlesize": 10, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.labelsize": 9, "axes.labelcolor": BLACK, "axes.edgecolor": GREY, "axes.linewidth": 0.7,
    "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#ebebeb", "grid.linewidth": 0.7, "axes.axisbelow": True,
    "axes.prop_cycle": matplotlib.cycler(color=CYCLE),
    "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": BLACK, "ytick.labelcolor": BLACK,
    "lines.linewidth": 1.4, "legend.frameon": False, "legend.fontsize": 8, "legend.handlelength": 1.4,
    "figure.facecolor": "white", "savefig.facecolor": "white",
})


def unit_label(unit):
    """The unit as people write it: kg/m3 -> kg/m³."""
    return unit.replace("m2", "m²").replace("m3", "m³").replace("s2", "s²")


def quantity_label(text, unit):
    text = text[:1].upper() + text[1:]
    return f"{text} [{unit_label(unit)}]" if unit and unit != "1" else text
