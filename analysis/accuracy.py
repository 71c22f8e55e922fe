"""Figures of an accuracy study (NAME.accuracy.h5 of `floewear accuracy`): error against CPU time for every method, and how a CPU
budget is best split between finer steps and more windows."""
import re

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from results import read_table, read_text
from style import AMBER, BLUE, GREEN, INK, PURPLE, SKY, VERMILION

FILETYPE = "floewear accuracy"

# The lines of the diagram, from the kernel's own to the plainest: (pattern of the method in the file, what the reader calls it,
# colour, mark, line). A study has its wear rules at one order, 3.
METHODS = (
    (r"events, hermite", "events, as built in", VERMILION, "o", "-"),
    (r"events 2, hermite", "events, order 2", "#B5651D", "<", "-"),
    (r"events 3, hermite", "events, order 3", AMBER, "s", "-"),
    (r"events 4, hermite", "events, order 4", PURPLE, "D", "-"),
    (r"events (\d), singular", r"events, order \1, singular wear", "#8C6D31", "d", "-."),
    (r"events (\d), naive", r"events, order \1, naive wear", "#7A3B00", "p", ":"),
    (r"every floe, rk4, hermite", "every floe, RK4", GREEN, "^", "--"),
    (r"every floe, verlet, hermite", "every floe, Verlet", SKY, "v", "--"),
    (r"every floe, euler, hermite", "every floe, Euler", BLUE, "P", "--"),
    (r"every floe, euler, naive", "every floe, Euler, naive wear", INK, "X", ":"),
)


class Study:
    """Tables of the file as dictionaries of columns, and its one-row summary."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.path = path
            if read_text(file.attrs.get("filetype", "")) != FILETYPE:
                raise ValueError(f"{path}: no accuracy study of floewear")
            self.name = read_text(file.attrs["name"])
            self.steps = read_table(file["work_precision"])
            self.budget = read_table(file["budget_cpu"])
            self.summary = {key: column[0] for key, column in read_table(file["summary"]).items()}
        if not np.any(self.steps["is_chosen"] > 0):
            raise ValueError(f"{path}: /work_precision has no chosen row")


def is_study(path):
    with h5py.File(path, "r") as file:
        return read_text(file.attrs.get("filetype", "")) == FILETYPE


def percent(value, _=None):
    return f"{100.0 * value:.3g} %"


def seconds(value, _=None):
    return f"{value:g} s" if value >= 1.0 else f"{1000.0 * value:g} ms"


def line_slope(x, y):
    """Slope of a straight line through log-log points; None below two."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0]) if len(x) > 1 else None


def draw_work_precision(study):
    steps, summary = study.steps, study.summary
    # Where every window is in a jam, coupled windows are none, and what is left is the r.m.s. over all of them.
    error = steps["coupled_rms"] if summary["n_coupled"] > 0 else steps["depth_rms"]
    figure, axes = plt.subplots(figsize=(10.4, 6.4))
    figure.subplots_adjust(left=0.095, right=0.655, bottom=0.105, top=0.835)
    for pattern, name, colour, mark, line in METHODS:
        found = [re.fullmatch(pattern, method) for method in steps["method"]]
        rows = np.array([match is not None for match in found]) & np.isfinite(error) & (error > 0.0)
        if not rows.any():
            continue
        name = found[int(np.flatnonzero(rows)[0])].expand(name)
        slope = line_slope(steps["cpu_s"][rows], error[rows])
        label = name if slope is None else f"{name}\nslope {slope:.1f}".replace("-", "−")
        axes.plot(steps["cpu_s"][rows], error[rows], color=colour, marker=mark, linestyle=line, markersize=6.5,
                  markeredgecolor="white", markeredgewidth=0.7, label=label, zorder=3 if "events" in name else 2)
    chosen = int(np.flatnonzero(steps["is_chosen"] > 0)[0])
    axes.plot(steps["cpu_s"][chosen], error[chosen], marker="o", markersize=17, markerfacecolor="none", markeredgecolor=INK,
              markeredgewidth=1.8, linestyle="none", label=f"chosen: {chosen_text(steps, chosen)}", zorder=4)
    axes.axhline(summary["accuracy"], color="#666666", linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    axes.annotate(f"wanted: {percent(summary['accuracy'])}", xy=(0.995, summary["accuracy"]), xycoords=("axes fraction", "data"),
                  xytext=(0, 4), textcoords="offset points", fontsize=10.5, color="#444444", ha="right")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_formatter(FuncFormatter(seconds))
    axes.yaxis.set_major_formatter(FuncFormatter(percent))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(base=10.0))
        axis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("CPU time of one window")
    axes.set_ylabel("error of its depth (r.m.s. of windows)")
    figure.legend(loc="center left", bbox_to_anchor=(0.665, 0.47), labelspacing=0.6, title="Hermite wear rule unless named",
                  alignment="left")
    figure.text(0.5, 0.945, "Work and precision: what an exact window costs", ha="center", fontsize=15, fontweight="bold")
    figure.text(0.5, 0.902, f"{study.name}: {summary['n_windows']:g} windows of {summary['way']:g} m of ice after "
                f"{summary['warm_up_way']:g} m, mean current {summary['mean_speed']:.2g} m/s, every method on the same ice",
                ha="center", fontsize=11.5)
    figure.text(0.5, 0.868, coupled_text(summary), ha="center", fontsize=10, color="#555555")
    return figure


def chosen_text(steps, row):
    method = steps["method"][row].replace("events, hermite", "as built in").replace("events ", "order ").replace(", hermite", "")
    return f"{method}\n{steps['setting'][row]}"


def coupled_text(summary):
    known = f"reference: finest events level, within {100.0 * summary['reference_hit_error']:.1g} % of independent solutions of single hits"
    jams = int(summary["n_windows"] - summary["n_coupled"])
    windows = f"{jams} window" if jams == 1 else f"{jams} windows"
    return known if jams == 0 else f"{known}; {windows} in a jam, where only means compare, left out"


def draw_budget(study):
    budget, summary = study.budget, study.summary
    if not budget["tolerance"].size:
        raise ValueError(f"{study.path}: /budget_cpu is empty: the percentile of the study's windows is 0")
    figure, axes = plt.subplots(figsize=(9.2, 6.4))
    figure.subplots_adjust(left=0.105, right=0.97, bottom=0.25, top=0.865)
    budgets = np.unique(budget["budget_cpu_s"])
    for value, colour, mark in zip(budgets, (BLUE, GREEN, VERMILION), ("s", "^", "o")):
        rows = budget["budget_cpu_s"] == value
        tolerance, total = budget["tolerance"][rows], budget["total_error"][rows]
        axes.plot(tolerance, budget["sampling_error"][rows], color=colour, linestyle=":", linewidth=1.6)
        axes.plot(tolerance, total, color=colour, marker=mark, markersize=6.5, markeredgecolor="white", markeredgewidth=0.7,
                  label=f"{cpu(value)}: {budget['n'][rows][np.argmax(budget['is_chosen'][rows])]:.0f} windows at the chosen step")
        best = int(np.argmin(total))
        axes.plot(tolerance[best], total[best], marker="*", markersize=19, color=colour, markeredgecolor="white", zorder=4)
    rows = budget["budget_cpu_s"] == budgets[0]
    axes.plot(budget["tolerance"][rows], budget["step_error"][rows], color=INK, linestyle="--", label="step error alone")
    axes.plot([], [], color="#777777", linestyle=":", linewidth=1.6, label="sampling error alone")
    axes.plot([], [], marker="*", markersize=14, color="#777777", linestyle="none", label="least total error")
    chosen = budget["tolerance"][budget["is_chosen"] > 0][0]
    axes.axvline(chosen, color="#666666", linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    axes.annotate("chosen", xy=(chosen, 1.0), xycoords=("data", "axes fraction"), xytext=(5, -4), textcoords="offset points",
                  fontsize=10.5, color="#444444", va="top")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.invert_xaxis()
    axes.yaxis.set_major_formatter(FuncFormatter(percent))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("step level (tolerance of the step control), finer to the right")
    axes.set_ylabel("error of the design percentile")
    figure.legend(loc="lower center", ncol=2, bbox_to_anchor=(0.53, 0.01), columnspacing=2.0)
    figure.text(0.53, 0.945, "A CPU budget split between finer steps and more windows", ha="center", fontsize=15, fontweight="bold")
    figure.text(0.53, 0.902, f"{study.name}: total error = sqrt(step² + sampling²); one window costs {summary['cpu_s_window']:.2g} CPU s "
                "at the chosen step", ha="center", fontsize=11.5)
    return figure


def cpu(value):
    for size, unit in ((86400.0, "CPU days"), (3600.0, "CPU hours"), (60.0, "CPU minutes")):
        if value >= size:
            return f"{value / size:.2g} {unit}"
    return f"{value:.2g} CPU s"
