"""Read a results file of floewear (NAME.h5) with h5py alone: tables as dictionaries of columns, and rings to depths."""
import h5py
import numpy as np


class Results:
    """What the figures need from one results file.

    name          the campaign's name
    n, n_failed   realisations in the file, and those of them that failed
    percentiles   {"point", "bearing_deg", "percentile", "depth_mm", "low_mm", "high_mm", ...}, one entry per row
    points        {"point", "bearing_deg", "mean_mm", ...}
    window        exposure of a realisation [s]
    directions    [(direction the current flows to [deg], share of time)] of a constant or a rose; [] for a continuous
                  law, a joint table, or without PyYAML: the figures then show no arrows
    temperatures  (smallest, largest) |T| [K] of a constant or uniform law, else None
    law           name of the first abrasion law
    life          {"service_life", "life_points", "life_fan", "allowance_year", "life_map"}: tables like the two above, those that the file has
    weights       (realisations) of each in an average, sum 1: those that floewear's own percentiles are made with
    load          its wear load (realisations x arcs), arc k facing [k, k+1) 360/arcs degrees clockwise of the current
    """

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.path = path
            self.name = read_text(file.attrs.get("name", ""))
            for needed in ("percentiles", "points", "realisations"):
                if needed not in file:
                    raise ValueError(f"{path}: no /{needed}: no results file of floewear, or of a run without results")
            self.percentiles = read_table(file["percentiles"])
            self.points = read_table(file["points"])
            status = file["realisations/status"][...]
            self.n = len(status)
            self.n_failed = int(np.count_nonzero(status != 0))
            window = file["realisations/window"][...] if "window" in file["realisations"] else np.zeros(0)
            self.window = float(np.nanmax(window)) if window.size else 0.0  # a failed run has none
            sets = [read_text(s) for s in np.atleast_1d(file.attrs.get("sets", []))]
            campaign = read_text(file.attrs.get("campaign", ""))
            self.directions = _directions(_law(campaign, sets, "current", "direction"))
            self.temperatures = _temperatures(_law(campaign, sets, "ice", "temperature"))
            load = file["realisations/wear_load"]
            tables = ("service_life", "life_points", "life_fan", "allowance_year", "life_map")
            self.life = {name: read_table(file[name]) for name in tables if name in file}
            self.weights = _weights(file)
            self.law = read_text(np.atleast_1d(load.attrs["laws"])[0])
            self.load = load[:, 0, :]
            if not self.percentiles["point"].size:
                raise ValueError(f"{path}: /percentiles is empty: the run has no results yet")

    def percentile(self, p):
        """Rows of one percentile in order of points: bearing, depth, low, high (NaN: an end that does not exist)."""
        rows = np.isclose(self.percentiles["percentile"], p)
        order = np.argsort(self.percentiles["point"][rows])
        keys = ("point", "bearing_deg", "depth_mm", "low_mm", "high_mm")
        return {key: self.percentiles[key][rows][order] for key in keys}

    def available_percentiles(self):
        return [float(p) for p in np.unique(self.percentiles["percentile"])]

    def shown_percentile(self):
        """The percentile that figures show as the high one: P95, else the largest of the file."""
        available = self.available_percentiles()
        return 95.0 if 95.0 in available else available[-1]

    def governing_point(self):
        """Number of the point with the largest depth at the shown percentile."""
        rows = self.percentile(self.shown_percentile())
        return int(rows["point"][int(np.argmax(np.nan_to_num(rows["depth_mm"])))])


def _weights(file):
    """Of files without weights, and of realisations that were left out: 1/n each, and 0."""
    status = file["realisations/status"][...]
    if "weights" not in file:
        return np.full(len(status), 1.0 / max(len(status), 1))
    ids, table = file["realisations/id"][...], read_table(file["weights"])
    weights = np.zeros(len(status))
    weights[np.searchsorted(ids, table["id"].astype(ids.dtype))] = table["weight"]
    return weights


def _law(campaign, sets, section, key):
    """The law of section.key as the campaign file or --set gives it; None when it is not to be understood here."""
    try:
        import yaml  # only here: Debian's python3-yaml is optional
    except ImportError:
        return None
    try:
        law = yaml.safe_load(campaign)[section].get(key)
        for path, _, value in (assignment.partition("=") for assignment in sets):
            if path.strip() == f"{section}.{key}":
                law = yaml.safe_load(value)
            elif path.strip().startswith(f"{section}.{key}."):
                return None  # a part of the law was set over the file: not worth a second campaign reader here
    except (yaml.YAMLError, AttributeError, KeyError, TypeError):
        return None
    return law


def _number(text, unit):
    return float(str(text).strip().removesuffix(unit))


def _directions(law):
    try:
        rose = law["rose"] if isinstance(law, dict) else {law: 1.0}
        rose = {_number(key, "deg"): float(share) for key, share in rose.items()}
    except (AttributeError, KeyError, TypeError, ValueError):
        return []
    return [(flows_to, share / sum(rose.values())) for flows_to, share in rose.items() if share > 0.0]


def _temperatures(law):
    try:
        ends = law["uniform"] if isinstance(law, dict) and set(law) == {"uniform"} else [law]
        ends = sorted(-_number(end, "degC") for end in ends)
    except (KeyError, TypeError, ValueError):
        return None
    return (ends[0], ends[-1]) if ends[0] > 0.0 and len(ends) <= 2 else None


def read_text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def read_table(group):
    return {name: dataset.asstr()[...] if h5py.check_string_dtype(dataset.dtype) else dataset[...]
            for name, dataset in group.items()}
