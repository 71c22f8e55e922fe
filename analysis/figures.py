#!/usr/bin/python3
"""Draw the figures of a floewear campaign from its results file or its accuracy study.

usage: figures.py RESULTS.h5 [-o FOLDER] [--points 1,6] [--formats svg,png]

Writes NAME-polar, NAME-exceedance and, of a service life, NAME-life-fan and NAME-life-map (NAME: the results file's), or of
NAME.accuracy.h5 NAME-work-precision and NAME-budget, beside the file or into FOLDER, and prints their paths. Needs Debian's python3-h5py and python3-matplotlib. The same results file gives the same bytes of SVG.
"""
import argparse
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")

import accuracy  # noqa: E402  (the backend is chosen before pyplot is loaded)
import exceedance  # noqa: E402
import life  # noqa: E402
import polar  # noqa: E402
from results import Results  # noqa: E402
from style import apply_style  # noqa: E402


def stable_ids(svg):
    """Number the clip paths in order of appearance: matplotlib 3.6 hashes their memory addresses, salt or not."""
    ids = {old: f"clip{i}" for i, old in enumerate(dict.fromkeys(re.findall(r'<clipPath id="(p[0-9a-f]+)"', svg)))}
    return re.sub(r'(id="|url\(#)(p[0-9a-f]+)(?=["\)])', lambda m: m.group(1) + ids.get(m.group(2), m.group(2)), svg)


def save(figure, folder, stem, formats):
    # No dates and no version strings: two runs on the same results differ in nothing.
    metadata = {"svg": {"Date": None, "Creator": None}, "png": {"Software": None}, "pdf": {"CreationDate": None}}
    paths = []
    for name in formats:
        path = folder / f"{stem}.{name}"
        figure.savefig(path, metadata=metadata.get(name))
        if name == "svg":
            path.write_text(stable_ids(path.read_text(encoding="utf-8")), encoding="utf-8")
        paths.append(path)
    return paths


def campaign_figures(options):
    results = Results(options.results)
    points = [int(p) for p in options.points.split(",")] if options.points else None
    figures = [("polar", polar.draw(results)), ("exceedance", exceedance.draw(results, points))]
    if life.has_fan(results):
        figures.append(("life-fan", life.draw_fan(results)))
    if life.has_map(results):
        figures.append(("life-map", life.draw_map(results)))
    return figures


def accuracy_figures(options):
    study = accuracy.Study(options.results)
    return ("work-precision", accuracy.draw_work_precision(study)), ("budget", accuracy.draw_budget(study))


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("results", type=pathlib.Path, help="NAME.h5 of floewear run, or NAME.accuracy.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder for figures (default: beside the results)")
    parser.add_argument("--points", help="points of the exceedance figure, such as 1,6 (default: chosen by depth)")
    parser.add_argument("--formats", default="svg,png", help="comma-separated: svg, png, pdf (default: %(default)s)")
    options = parser.parse_args(arguments)

    folder = options.output or options.results.parent
    try:
        apply_style()
        figures = accuracy_figures(options) if accuracy.is_study(options.results) else campaign_figures(options)
        folder.mkdir(parents=True, exist_ok=True)
        for kind, figure in figures:
            for path in save(figure, folder, f"{options.results.stem.removesuffix('.accuracy')}-{kind}", options.formats.split(",")):
                print(f"figure: {path}")
    except (OSError, ValueError) as error:
        # h5py does not always say which file.
        about = "" if str(options.results) in str(error) else f"{options.results}: "
        print(f"figures.py: {about}{error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
