"""Figures of a service life: depth over the years with the allowance, and depth over bearing and height.

The fan shows the point that governs the life. Its bands lie between percentiles of all lives; below it stands in which year the allowance is
used up, where it is. The map needs statistics of the water level in the campaign."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, MaxNLocator

from polar import goes_round
from style import AMBER, BLUE, CURRENT, INK, VERMILION, compass, depth_unit

LINES = {50.0: "-", 90.0: "--", 95.0: "-.", 99.0: (0, (1, 1))}


def has_fan(results):
    return bool(results.life.get("life_fan")) and np.nanmax(results.life["life_fan"]["depth_mm"]) > 0.0


def has_map(results):
    rows = results.life.get("life_map")
    return bool(rows) and len(np.unique(rows["bearing_deg"])) > 2 and np.nanmax(rows["depth_mm"]) > 0.0


def governing_point(results):
    """The point with the largest life depth at the largest percentile."""
    fan = results.life["life_fan"]
    last = (fan["year"] == fan["year"].max()) & (fan["percentile"] == fan["percentile"].max())
    return int(fan["point"][last][int(np.argmax(fan["depth_mm"][last]))])


def fan_of(results, point, column="depth_mm"):
    """(years, {percentile: depths [mm]}), year 0 included."""
    fan = results.life["life_fan"]
    at = fan["point"] == point
    years = np.unique(fan["year"][at])
    curves = {}
    for p in np.unique(fan["percentile"][at]):
        rows = at & (fan["percentile"] == p)
        curves[float(p)] = np.append(0.0, fan[column][rows][np.argsort(fan["year"][rows])])
    return np.append(0.0, years), curves


def life_subtitle(results):
    life = results.life["service_life"]
    return f"{results.name}: {life['assumption'][0]}"


def draw_fan(results):
    point = governing_point(results)
    years, curves = fan_of(results, point)
    _, with_law = fan_of(results, point, "with_law_depth_mm")
    has_law = np.isfinite(with_law[max(with_law)][-1])
    summary = {key: column[results.life["life_points"]["point"] == point][0] for key, column in results.life["life_points"].items()}
    allowance, never = summary["allowance_mm"], summary["never"]
    top = max(curves[max(curves)][-1], with_law[max(with_law)][-1] if has_law else 0.0)
    is_near = np.isfinite(allowance) and allowance < 1.6 * top
    scale, unit = depth_unit(max(top, allowance if is_near else 0.0))

    rows = "allowance_year" in results.life and is_near and min(never, summary["with_law_never"] if has_law else 1.0) < 0.9995
    figure, panels = plt.subplots(2 if rows else 1, 1, figsize=(8, 7.6 if rows else 6.2), sharex=True, squeeze=False,
                                  gridspec_kw={"height_ratios": [3.2, 1.0] if rows else [1.0], "hspace": 0.12})
    figure.subplots_adjust(left=0.105, right=0.865, bottom=0.1, top=0.86 if rows else 0.83)
    axes = panels[0, 0]
    draw_bands(axes, years, {p: scale * c for p, c in curves.items()}, {p: scale * c for p, c in with_law.items()} if has_law else None)
    if is_near:
        axes.axhline(scale * allowance, color=INK, linewidth=1.4, linestyle=(0, (6, 3)), zorder=4)
        axes.annotate(f"allowance {allowance:g} mm", xy=(0.015, scale * allowance), xycoords=("axes fraction", "data"), xytext=(0, 5),
                      textcoords="offset points", fontsize=10.5, color=INK)
    axes.set_xlim(0.0, years[-1])
    axes.set_ylim(0.0, scale * max(1.06 * top, 1.1 * allowance if is_near else 0.0))
    axes.set_ylabel(f"depth worn off [{unit}]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.93 if is_near else 1.0))
    if rows:
        draw_allowance(panels[1, 0], results, point, has_law)
    panels[-1, 0].set_xlabel("years in service")

    bearing = float(summary["bearing_deg"])
    middle = 0.485
    figure.text(middle, 0.955, f"Service life at point {point}, bearing {bearing:g}° ({compass(bearing)})", ha="center", fontsize=15, fontweight="bold")
    figure.text(middle, 0.918, life_subtitle(results), ha="center", fontsize=11.5)
    remarks = [sampling_remark(results, point, scale, unit) + f"coefficient of variation of a life {100.0 * summary['cv']:.2g} %"]
    if np.isfinite(allowance) and not is_near:
        times = allowance / top
        remarks.append(f"the allowance of {allowance:g} mm is {times:.{0 if times >= 10.0 else 1}f} times the largest depth shown")
    figure.text(middle, 0.902, "\n".join(remarks), ha="center", va="top", fontsize=10, color="#555555", linespacing=1.35)
    return figure


def sampling_remark(results, point, scale, unit):
    """The life's percentile with its interval: bands are lives of one law of windows, which the windows computed know only so well."""
    life = results.life["service_life"]
    shown = 90.0 if 90.0 in life["percentile"] else life["percentile"].max()
    row = np.flatnonzero((life["point"] == point) & (life["percentile"] == shown))
    if not row.size or not np.isfinite(life["low_mm"][row[0]] + life["high_mm"][row[0]]):
        return ""
    depth, low, high = (scale * life[key][row[0]] for key in ("depth_mm", "low_mm", "high_mm"))
    return f"P{shown:g} at the end {depth:.3g} {unit}, interval of the sampling [{low:.3g}, {high:.3g}] {unit}; "


def draw_bands(axes, years, curves, with_law):
    percentiles = sorted(curves)
    if with_law:
        axes.fill_between(years, with_law[percentiles[0]], with_law[percentiles[-1]], color=AMBER, alpha=0.22, linewidth=0,
                          label=f"P{percentiles[0]:g} to P{percentiles[-1]:g} with what is not known of the law")
    for i, (low, high) in enumerate(zip(percentiles, percentiles[1:])):
        axes.fill_between(years, curves[low], curves[high], color=BLUE, alpha=0.34 - 0.06 * i, linewidth=0)
    axes.fill_between([], [], [], color=BLUE, alpha=0.28, linewidth=0, label=f"P{percentiles[0]:g} to P{percentiles[-1]:g}")
    ends = []
    for p in percentiles:
        axes.plot(years, curves[p], color=VERMILION if p == 50.0 else BLUE, linewidth=2.2 if p == 50.0 else 1.2, linestyle=LINES.get(p, "-"))
        ends.append((curves[p][-1], f"P{p:g}", VERMILION if p == 50.0 else BLUE))
    if with_law:
        ends.append((with_law[percentiles[-1]][-1], f"P{percentiles[-1]:g},\nlaw too", "#8A6200"))
    label_ends(axes, ends)


def label_ends(axes, ends):
    """Names at the right end, moved apart where they would lie on one another."""
    top = max(end for end, _, _ in ends)
    at = -np.inf
    for end, name, colour in sorted(ends):
        at = max(end, at + 0.042 * top)
        axes.annotate(name, xy=(1.0, end), xycoords=("axes fraction", "data"), xytext=(1.02, at), textcoords=("axes fraction", "data"),
                      va="center", fontsize=10.5, color=colour, annotation_clip=False)


def draw_allowance(axes, results, point, has_law):
    rows = results.life["allowance_year"]
    at = rows["point"] == point
    year = rows["year"][at]
    axes.bar(year - 0.5, rows["probability"][at], width=0.8, color=VERMILION, label="allowance used up in this year")
    if has_law:
        axes.step(np.append(year - 1.0, year[-1]), np.append(rows["with_law_probability"][at], rows["with_law_probability"][at][-1]), where="post",
                  color="#8A6200", linewidth=1.4, label="with what is not known of the law")
    axes.set_ylabel("probability")
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100.0 * value:g} %"))
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="upper left", fontsize=9.5)


def map_grid(results):
    """(bearings, heights [m], depths [mm] (heights x bearings)), a full circle closed and bearings in steps that do not fall."""
    rows = results.life["life_map"]
    points = np.unique(rows["point"])
    heights = np.unique(rows["height_m"])
    bearings = np.array([rows["bearing_deg"][rows["point"] == p][0] for p in points])
    depth = np.array([rows["depth_mm"][rows["point"] == p][np.argsort(rows["height_m"][rows["point"] == p])] for p in points]).T
    is_round = goes_round(bearings)
    bearings = np.unwrap(bearings, period=360.0)
    if is_round:
        order = np.argsort(bearings % 360.0)
        bearings, depth = bearings[order] % 360.0, depth[:, order]
        bearings, depth = np.append(bearings, bearings[0] + 360.0), np.column_stack([depth, depth[:, 0]])
    return bearings, heights, depth


def draw_map(results):
    bearings, heights, depth = map_grid(results)
    scale, unit = depth_unit(depth.max())
    figure, axes = plt.subplots(figsize=(8, 5.8))
    figure.subplots_adjust(left=0.1, right=0.985, bottom=0.115, top=0.84)
    levels = MaxNLocator(nbins=12, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, scale * depth.max())
    filled = axes.contourf(bearings, heights, scale * depth, levels=levels, cmap="YlOrBr")
    for collection in getattr(filled, "collections", [filled]):
        collection.set_edgecolor("face")  # no hairlines between the bands in SVG
    axes.contour(bearings, heights, scale * depth, levels=levels[1:-1:2], colors=INK, linewidths=0.5, alpha=0.5)
    row, column = np.unravel_index(int(np.argmax(depth)), depth.shape)
    axes.plot(bearings[column], heights[row], marker="+", color="white", markersize=11, markeredgewidth=2.0)
    halo = [withStroke(linewidth=2.5, foreground="#5A2000")]
    axes.annotate(f"{scale * depth.max():.3g} {unit}", xy=(bearings[column], heights[row]), xytext=(0, -17), textcoords="offset points",
                  ha="center", color="white", fontsize=10.5, fontweight="bold", path_effects=halo)
    axes.axhline(0.0, color=CURRENT, linewidth=1.3, linestyle=(0, (6, 3)))
    axes.annotate("mean water level", xy=(bearings[0], 0.0), xytext=(5, 4), textcoords="offset points", fontsize=10, color=CURRENT,
                  path_effects=[withStroke(linewidth=3.0, foreground="white", alpha=0.8)])
    worn = heights[(depth > 0.002 * depth.max()).any(axis=1)]
    axes.set_ylim(worn.min(), worn.max())
    ticks = np.arange(np.ceil(bearings[0] / 45.0), np.floor(bearings[-1] / 45.0) + 1.0) * 45.0
    if len(ticks) > 2:
        axes.set_xticks(ticks, [f"{compass(t % 360.0)}\n{t % 360.0:g}°" for t in ticks])
    axes.set_xlabel("bearing of the wall")
    axes.set_ylabel("height above the mean water level [m]")
    bar = figure.colorbar(filled, ax=axes, pad=0.02, format=FuncFormatter(lambda value, _: f"{value:g}"))
    bar.set_label(f"depth [{unit}]")
    percentile = results.life["life_map"]["percentile"][0]
    figure.text(0.5, 0.945, f"Depth of a service life over the wall, P{percentile:g}", ha="center", fontsize=15, fontweight="bold")
    figure.text(0.5, 0.9, life_subtitle(results), ha="center", fontsize=11.5)
    figure.text(0.5, 0.864, "at each bearing the percentile of its own lives, spread over height by the law of the water level", ha="center", fontsize=10,
                color="#555555")
    return figure
