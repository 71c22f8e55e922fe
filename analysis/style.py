"""One look for every figure: sizes readable at 800 px, Okabe-Ito colours (safe for colour-blind readers), units."""
import matplotlib
import numpy as np

BLUE, VERMILION, GREEN, AMBER, PURPLE, SKY = "#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9"
INK, PALE, WALL, CURRENT = "#222222", "#D8D8D8", "#A3AAB2", "#3F6175"


def apply_style():
    matplotlib.rcParams.update({
        "figure.dpi": 100, "savefig.dpi": 200, "figure.facecolor": "white",
        "font.size": 11, "font.family": "DejaVu Sans", "axes.labelsize": 12, "legend.fontsize": 10.5,
        "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": "#888888", "xtick.color": INK, "ytick.color": INK,
        "axes.grid": True, "grid.color": PALE, "grid.linewidth": 0.7, "axes.axisbelow": True,
        "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "lines.linewidth": 2.0,
        "svg.hashsalt": "floewear", "svg.fonttype": "path"})


def depth_unit(largest_mm):
    """(factor from mm, unit) that keeps an axis' numbers between 1 and 1000: windows wear nanometres to millimetres."""
    for factor, unit in ((1.0, "mm"), (1e3, "µm"), (1e6, "nm")):
        if largest_mm * factor >= 1.0:
            return factor, unit
    return 1e6, "nm"


def compass(bearing):
    """The nearest of the sixteen names of a bearing in degrees."""
    names = "N NNE NE ENE E ESE SE SSE S SSW SW WSW W WNW NW NNW".split()
    return names[int(np.round(bearing / 22.5)) % 16]


def duration(seconds):
    for size, unit in ((3600.0, "h"), (60.0, "min")):
        if seconds >= size and seconds != 60.0:
            return f"{seconds / size:g} {unit}"
    return f"{seconds:g} s"


def subtitle(results):
    window = f" of {duration(results.window)}" if results.window else ""
    failed = f", {results.n_failed} failed" if results.n_failed else ""
    return f"{results.name}: {results.n} windows{window}{failed}"
