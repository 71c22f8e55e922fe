"""Depth around the structure: mean, P50 and a high percentile with its interval, seen from above with north up.

The wall is the grey disc; depth counts outwards from it, so that the figure reads like a plan of the worn structure.
Arrows outside show where the current comes from, each with its share of time."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle

from style import AMBER, BLUE, CURRENT, INK, VERMILION, WALL, compass, depth_unit, subtitle

HOLE = 0.55  # radius of the wall as a share of the depth axis


def goes_round(bearings):
    """Do the points go all the way round? (No gap is wider than twice the usual one.)"""
    if len(bearings) < 3:
        return False
    gaps = np.diff(np.append(np.sort(bearings), np.sort(bearings)[0] + 360.0))
    return gaps.max() < 2.0 * np.median(gaps)


def closed(values, is_closed):
    return np.append(values, values[0]) if is_closed else values


def on_rim(bearing, radius):
    """Axes coordinates of a bearing [deg] at so many radii of the outer circle."""
    angle = np.radians(bearing)
    return 0.5 + 0.5 * radius * np.sin(angle), 0.5 + 0.5 * radius * np.cos(angle)


def quietest_bearing(rows, is_round):
    """Where depth labels hide nothing: at the least worn point, or opposite to points that go part of the way only."""
    if is_round:
        return float(rows["bearing_deg"][int(np.argmin(np.nan_to_num(rows["depth_mm"])))])
    angles = np.radians(rows["bearing_deg"])
    return float(np.degrees(np.arctan2(np.sin(angles).sum(), np.cos(angles).sum())) + 180.0)


def draw(results):
    high = results.shown_percentile()
    rows = results.percentile(high)
    median = results.percentile(50.0) if 50.0 in results.available_percentiles() and high != 50.0 else None
    mean = results.points["mean_mm"][np.argsort(results.points["point"])]

    everything = np.concatenate([rows["depth_mm"], rows["high_mm"], mean])
    everything = everything[np.isfinite(everything)]
    scale, unit = depth_unit(everything.max() if everything.size else 0.0)
    top = 1.06 * scale * everything.max() if everything.size and everything.max() > 0.0 else 1.0

    figure = plt.figure(figsize=(8, 9))
    axes = figure.add_axes((0.165, 0.165, 0.67, 0.5956), projection="polar")
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_ylim(0.0, top)
    axes.set_rorigin(-HOLE * top)
    axes.spines["polar"].set_visible(False)

    # Points that do not go all round may still pass north: unwrapped, so that the line does not take the long way.
    round_trip = goes_round(rows["bearing_deg"])
    theta = np.unwrap(np.radians(rows["bearing_deg"]))
    line = np.append(theta, theta[0] + 2.0 * np.pi) if round_trip else theta

    def plot(values, **look):
        axes.plot(line, closed(values * scale, round_trip), **look)

    axes.fill_between(line, closed(rows["low_mm"] * scale, round_trip), closed(rows["high_mm"] * scale, round_trip),
                      color=VERMILION, alpha=0.22, linewidth=0)
    has_band = bool(np.any(np.isfinite(rows["low_mm"]) & np.isfinite(rows["high_mm"])))
    plot(rows["depth_mm"], color=VERMILION, marker="o", markersize=4.5,
         label=f"P{high:g}, its interval shaded" if has_band else f"P{high:g} (no finite interval)")
    plot(mean, color=BLUE, linestyle="--", marker="s", markersize=3.5, label="mean")
    if median is not None:
        plot(median["depth_mm"], color=AMBER, linestyle="-.", marker="^", markersize=4, label="P50")

    hole = 0.5 * HOLE / (1.0 + HOLE)
    axes.add_patch(Circle((0.5, 0.5), hole, transform=axes.transAxes, facecolor=WALL, edgecolor=INK, linewidth=1.0,
                          clip_on=False, zorder=1.4))
    axes.text(0.5, 0.5, "structure", transform=axes.transAxes, ha="center", va="center", color="white", fontsize=13,
              fontweight="bold")

    axes.set_thetagrids(np.arange(0, 360, 45), "N NE E SE S SW W NW".split(), fontsize=12, fontweight="bold")
    axes.tick_params(axis="x", pad=1)
    axes.set_rlabel_position(quietest_bearing(rows, round_trip) + 7.5)
    axes.yaxis.set_major_locator(plt.MaxNLocator(4, prune="lower"))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g} {unit}")
    axes.tick_params(axis="y", labelsize=10)

    draw_current(axes, results.directions)
    at = int(np.flatnonzero(rows["point"] == results.governing_point())[0])
    bearing, depth = rows["bearing_deg"][at], rows["depth_mm"][at] * scale
    figure.text(0.5, 0.957, "Abrasion depth of one window, all round", ha="center", fontsize=15, fontweight="bold")
    figure.text(0.5, 0.925, subtitle(results), ha="center", fontsize=11.5)
    figure.text(0.5, 0.897, f"largest P{high:g}: {depth:.3g} {unit} at point {rows['point'][at]}, bearing {bearing:g}° "
                f"({compass(bearing)})", ha="center", fontsize=11.5)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, bbox_to_anchor=(0.5, 0.03))
    if results.directions:
        figure.text(0.5, 0.017, "arrows: where the current comes from, thicker for a larger share of time", ha="center",
                    fontsize=10, color="#555555")
    return figure


def draw_current(axes, directions):
    """Arrows outside the rim, pointing with the current: from the bearing opposite to the one it flows to."""
    if not directions:
        return
    largest = max(share for _, share in directions)
    for flows_to, share in directions:
        origin = (flows_to + 180.0) % 360.0
        axes.annotate("", xy=on_rim(origin, 1.15), xytext=on_rim(origin, 1.29), xycoords="axes fraction",
                      textcoords="axes fraction", annotation_clip=False, zorder=5,
                      arrowprops={"arrowstyle": "simple,head_length=0.7,head_width=0.9,tail_width=0.35",
                                  "color": CURRENT, "mutation_scale": 9.0 + 15.0 * share / largest, "linewidth": 0,
                                  "shrinkA": 0, "shrinkB": 0})
        if len(directions) <= 8:
            # Beside the arrow's tail, on the clockwise side, clear of the wind rose's letters.
            label = f"current\n{100.0 * share:.3g} %" if len(directions) > 1 else "current"
            axes.text(*on_rim(origin + 9.0, 1.25), label, transform=axes.transAxes, ha="center", va="center",
                      fontsize=10, color=CURRENT, linespacing=1.1)
