"""How often a window wears deeper than so much: exceedance curves of chosen measuring points, percentiles marked."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, NullLocator
from matplotlib.transforms import ScaledTranslation

import windows
from style import BLUE, GREEN, PURPLE, VERMILION, compass, depth_unit, subtitle

COLOURS = (VERMILION, BLUE, GREEN, PURPLE)
MARKS = ("o", "s", "^", "D")
LINES = ("-", "--", "-.", (0, (1, 1)))


def chosen_points(results):
    """The governing point, the one that wears least, and two between them."""
    rows = results.percentile(results.shown_percentile())
    order = np.argsort(-np.nan_to_num(rows["depth_mm"]), kind="stable")
    picks = np.unique(np.round(np.linspace(0, len(order) - 1, min(4, len(order)))).astype(int))
    return [int(rows["point"][order[i]]) for i in picks]


def curve(results, point):
    """(depth [mm], probability) in ascending depth: averaged over temperature and direction where that can be checked
    against the file's percentiles, else a line through these percentiles, which are what is known of the curve."""
    found = windows.exceedance(results, point)
    if found:
        return found
    rows = results.percentiles["point"] == point
    order = np.argsort(results.percentiles["percentile"][rows])
    return (results.percentiles["depth_mm"][rows][order],
            1.0 - results.percentiles["percentile"][rows][order] / 100.0)


def draw(results, points=None):
    known = set(int(p) for p in results.percentiles["point"])
    points = points or chosen_points(results)
    for point in points:
        if point not in known:
            raise ValueError(f"{results.path}: no point {point}; there are {min(known)} to {max(known)}")
    percentiles = results.available_percentiles()
    depths = results.percentiles["depth_mm"][np.isin(results.percentiles["point"], points)]
    positive = depths[np.isfinite(depths) & (depths > 0.0)]
    scale, unit = depth_unit(positive.max() if positive.size else 0.0)

    figure, axes = plt.subplots(figsize=(8, 6.4))
    figure.subplots_adjust(left=0.115, right=0.925, bottom=0.115, top=0.84)
    lowest = min(0.3 * (1.0 - percentiles[-1] / 100.0), 0.04)
    for i, point in enumerate(points):
        # Bars of neighbouring curves lie a few points apart, or they would hide each other.
        beside = ScaledTranslation(0.0, 3.5 * ((len(points) - 1) / 2.0 - i) / 72.0, figure.dpi_scale_trans)
        draw_point(axes, results, point, scale, (COLOURS[i % 4], MARKS[i % 4], LINES[i % 4]), beside)

    axes.set_yscale("log")
    axes.set_ylim(lowest, 1.0)
    if positive.size:
        axes.set_xscale("log")
        ends = results.percentiles["high_mm"][np.isin(results.percentiles["point"], points)]
        right = np.nanmax(np.append(positive, ends[np.isfinite(ends)])) * scale
        axes.set_xlim(max(positive.min() * scale / 3.0, right / 1e4), right * 1.7)
    axes.set_yticks([y for y in (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0) if y >= lowest])
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100.0 * value:g} %"))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_xlabel(f"abrasion depth of one window [{unit}]")
    axes.set_ylabel("share of windows that wear deeper")
    for p in percentiles:
        axes.axhline(1.0 - p / 100.0, color="#999999", linewidth=0.8, linestyle=":", zorder=0.5)
        axes.annotate(f"P{p:g}", xy=(1.0, 1.0 - p / 100.0), xycoords=("axes fraction", "data"), xytext=(6, 0),
                      textcoords="offset points", va="center", fontsize=10.5, annotation_clip=False)
    axes.legend(loc="lower left", title="measuring point", alignment="left")
    figure.text(0.52, 0.945, "How often a window wears deeper", ha="center", fontsize=15, fontweight="bold")
    figure.text(0.52, 0.902, subtitle(results), ha="center", fontsize=11.5)
    remark = "marks: design percentiles with their intervals"
    if missing_ends(results, points):
        remark += "; a mark without a bar has no finite interval"
    figure.text(0.52, 0.868, remark, ha="center", fontsize=10, color="#555555")
    return figure


def missing_ends(results, points):
    rows = np.isin(results.percentiles["point"], points)
    return not all(np.isfinite(results.percentiles[key][rows]).all() for key in ("low_mm", "high_mm"))


def draw_point(axes, results, point, scale, look, beside):
    colour, mark, line = look
    depth, probability = curve(results, point)
    seen = (depth > 0.0) & (probability > 0.0)
    axes.plot(depth[seen] * scale, probability[seen], color=colour, linestyle=line, zorder=2)
    rows = results.percentiles["point"] == point
    depth, low, high = (results.percentiles[key][rows] for key in ("depth_mm", "low_mm", "high_mm"))
    probability = 1.0 - results.percentiles["percentile"][rows] / 100.0
    has_bar = np.isfinite(low) & np.isfinite(high)
    axes.hlines(probability[has_bar], low[has_bar] * scale, high[has_bar] * scale, color=colour, linewidth=2.5,
                alpha=0.6, zorder=1.5, transform=axes.transData + beside)
    bearing = results.percentiles["bearing_deg"][rows][0]
    name = f"{point}, bearing {bearing:g}° ({compass(bearing)})"
    if point == results.governing_point():
        name += ", governing"
    axes.plot(depth * scale, probability, color=colour, marker=mark, linestyle="none", markersize=7,
              markeredgecolor="white", markeredgewidth=0.8, zorder=3)
    axes.plot([], [], color=colour, linestyle=line, marker=mark, markersize=7, label=name)
