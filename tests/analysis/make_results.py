"""Synthetic results files for the tests of analysis/: the layout of src/store/results_write.c, numbers from known laws.

A realisation's ring is a smooth bump facing the current times a lognormal factor. Depths are brute force: every
realisation, every direction, N_T temperatures in the middles of equal shares of the law; percentiles are read from the
sorted depths with their weights. Standard library, numpy and h5py only."""
import math

import h5py
import numpy as np

N_T = 400
N_ARCS = 72
ROSE = "{rose: {0 deg: 1, 90 deg: 2, 180 deg: 1, 270 deg: 4}}"
ROSE_SHARES = {0.0: 0.125, 90.0: 0.25, 180.0: 0.125, 270.0: 0.5}
CAMPAIGN = """name: {name}
ice: {{temperature: {temperature}}}
current: {{speed: 0.5 m/s, direction: {direction}}}
"""


def order_interval(n, p, confidence=0.95):
    """Ranks (from 1) of the order-statistic interval of the p-quantile by the binomial law, None: no rank reaches."""
    cdf = np.cumsum([math.comb(n, k) * p**k * (1.0 - p) ** (n - k) for k in range(n + 1)])
    tail = (1.0 - confidence) / 2.0
    low = int(np.searchsorted(cdf, tail, side="right"))
    high = int(np.searchsorted(cdf, 1.0 - tail)) + 1
    return (low if low >= 1 else None), (high if high <= n else None)


def table(file, name, columns):
    group = file.create_group(name)
    for key, values in columns.items():
        values = np.asarray(values)
        group.create_dataset(key, data=values.astype("S") if values.dtype.kind == "U" else values)


def depths(load, bearing, shares, temperatures):
    """(depth [mm], weight) of every realisation, direction and temperature at one bearing, in ascending depth."""
    coldest, warmest = temperatures
    kelvin = np.abs(coldest + (np.arange(N_T) + 0.5) / N_T * (warmest - coldest))
    rate = 0.116 * kelvin**-1.121
    depth, weight = [], []
    for flows_to, share in shares.items():
        arc = int(((bearing - flows_to - 180.0) % 360.0) // (360.0 / N_ARCS))
        depth.append(np.outer(load[:, arc], rate).ravel())
        weight.append(np.full(depth[-1].size, share / depth[-1].size))
    depth, weight = np.concatenate(depth), np.concatenate(weight)
    order = np.argsort(depth)
    return depth[order], weight[order]


def make_life(file, numbers, bearings, means, allowance=math.nan, with_law=False, water_level=True, years=50):
    """Lives of 400 windows a year whose depth after a year is normal with a CV of 0.5/sqrt(years); the law's factor is then 1/2 or 2."""
    percentiles, scores = np.array([5.0, 50.0, 90.0, 95.0, 99.0]), np.array([-1.645, 0.0, 1.282, 1.645, 2.326])
    year = np.arange(1.0, years + 1.0)
    depth = 400.0 * means[:, None, None] * (year[:, None] + 0.5 * np.sqrt(year[:, None]) * scores)  # points x years x percentiles
    law = depth * np.where(scores > 0.0, 2.0, np.where(scores < 0.0, 0.5, 1.0)) if with_law else np.full_like(depth, math.nan)
    point, at, p = (a.ravel() for a in np.meshgrid(np.arange(len(numbers)), year, percentiles, indexing="ij"))
    table(file, "life_fan", {"point": numbers[point], "bearing_deg": bearings[point], "year": at, "percentile": p, "depth_mm": depth.ravel(),
                             "with_law_depth_mm": law.ravel()})
    end = depth[:, -1, 1:].ravel()
    table(file, "service_life", {"point": np.repeat(numbers, 4), "percentile": np.tile(percentiles[1:], len(numbers)), "depth_mm": end,
                                 "low_mm": 0.8 * end, "high_mm": 1.3 * end, "assumption": ["windows of persistence 0.9"] * len(end)})
    none = np.full(len(numbers), math.nan)
    table(file, "life_points", {"point": numbers, "bearing_deg": bearings, "cv": np.full(len(numbers), 0.5 / math.sqrt(years)),
                                "allowance_mm": np.full(len(numbers), allowance), "never": none, "with_law_never": none})
    if not math.isnan(allowance):
        by_then = np.array([[0.5 * math.erfc((allowance / (400.0 * m) - t) / (0.5 * math.sqrt(2.0 * t))) if m > 0.0 else 0.0 for t in year]
                            for m in means])
        new = np.diff(np.maximum.accumulate(by_then, axis=1), axis=1, prepend=0.0)
        file["life_points/never"][...] = 1.0 - by_then[:, -1]
        file["life_points/with_law_never"][...] = 1.0 - by_then[:, -1] if with_law else math.nan
        table(file, "allowance_year", {"point": np.repeat(numbers, years), "year": np.tile(year, len(numbers)), "probability": new.ravel(),
                                       "with_law_probability": (0.5 * new if with_law else math.nan * new).ravel()})
    if water_level:
        height = np.linspace(-1.5, 1.0, 81)
        share = np.exp(-0.5 * ((height + 0.2) / 0.4) ** 2)
        table(file, "life_map", {"point": np.repeat(numbers, 81), "bearing_deg": np.repeat(bearings, 81), "height_m": np.tile(height, len(numbers)),
                                 "percentile": np.full(81 * len(numbers), 90.0), "depth_mm": (depth[:, -1, 2, None] * share).ravel()})


def make(path, name="synthetic", n=200, bearings=None, direction=ROSE, shares=None, temperatures=(-12.0, -2.0),
         scale=1.0, percentiles=(50, 90, 95, 99), n_failed=0, sets=(), seed=1, life=None):
    """shares: {direction: share}, what `direction` says; scale: of the wear load [1e-3 MPa^1.121 km]; life: what make_life takes."""
    random = np.random.default_rng(seed)
    bearings = np.arange(0.0, 360.0, 15.0) if bearings is None else np.asarray(bearings, float)
    shares = ROSE_SHARES if shares is None else shares
    theta = np.radians((np.arange(N_ARCS) + 0.5) * 360.0 / N_ARCS)
    load = scale * 1e-3 * np.exp(0.8 * random.standard_normal((n, 1))) * (0.02 + np.maximum(0.0, np.cos(theta)) ** 0.7)

    rows, means = [], []
    for point, bearing in enumerate(bearings, 1):
        depth, weight = depths(load, bearing, shares, temperatures)
        means.append(float(depth @ weight))
        cdf = np.cumsum(weight)
        for p in percentiles:
            low, high = order_interval(n, p / 100.0)

            def at(share):
                return depth[min(np.searchsorted(cdf, share), len(depth) - 1)]
            rows.append((point, bearing, float(p), at(p / 100.0), at((low - 1) / n) if low else math.nan,
                         at(high / n) if high else math.nan, 0.95, "order statistics"))
    keys = ("point", "bearing_deg", "percentile", "depth_mm", "low_mm", "high_mm", "coverage", "method")
    numbers = np.arange(1, len(bearings) + 1)
    with h5py.File(path, "w") as file:
        law = f"{temperatures[0]} degC" if temperatures[0] == temperatures[1] else \
            "{{uniform: [{} degC, {} degC]}}".format(*temperatures)
        file.attrs["name"] = name
        file.attrs["campaign"] = CAMPAIGN.format(name=name, direction=direction, temperature=law)
        file.attrs["sets"] = np.array(sets, dtype=h5py.string_dtype())
        table(file, "percentiles", dict(zip(keys, map(list, zip(*rows)))))
        table(file, "points", {"point": numbers, "bearing_deg": bearings, "mean_mm": means})
        table(file, "realisations", {"id": np.arange(n), "status": (np.arange(n) < n_failed).astype(np.int32),
                                     "window": np.full(n, 10800.0), "wear_load": load[:, None, :]})
        laws = np.array(["bekker2011"], dtype=h5py.string_dtype())
        file["realisations/wear_load"].attrs["laws"] = laws
        if life is not None:
            make_life(file, numbers, bearings, np.array(means), **life)
    return path


def make_study(path, name="synthetic", n_coupled=8, budget=True, chosen=True):
    """An accuracy study whose methods are exact power laws: error of order 2 falls with the square of CPU time, of the plain
    schemes with its first power."""
    methods, levels, cpu, error, is_chosen = [], [], [], [], []
    for method, first, order in (("events, hermite", 3e-3, 2.0), ("events 3, hermite", 4e-3, 3.0),
                                 ("every floe, euler, naive", 3e-2, 1.0), ("every floe, rk4, hermite", 0.1, 1.0)):
        for k in range(4):
            methods.append(method)
            levels.append(10.0 ** (-2 - k))
            cpu.append(first * 2.0**k)
            error.append(0.02 * 2.0 ** (-order * k))
            is_chosen.append(float(chosen and method == "events, hermite" and k == 1))
    n = len(methods)
    with h5py.File(path, "w") as file:
        file.attrs["filetype"] = "floewear accuracy"
        file.attrs["name"] = name
        known = np.array(error) if n_coupled else np.full(n, np.nan)
        table(file, "work_precision", {"method": methods, "setting": [f"tolerance {level:g}" for level in levels], "cpu_s": cpu,
                                       "coupled_rms": known, "depth_rms": np.array(error) * 2.0, "is_chosen": is_chosen})
        rows = [(b, 10.0 ** (-2 - k), 1e-2 * 0.3**k, 2.0 / np.sqrt(b / (1.0 + k)), k == 1.0)
                for b in (20.0, 200.0, 2e5) for k in range(4)] if budget else []
        spent, tolerance, step, sampling, taken = (np.array(c, float) for c in zip(*rows)) if rows else [np.zeros(0)] * 5
        table(file, "budget_cpu", {"budget_cpu_s": spent, "tolerance": tolerance, "step_error": step, "sampling_error": sampling,
                                   "total_error": np.hypot(step, sampling), "n": spent, "is_chosen": taken})
        table(file, "summary", {"accuracy": [0.01], "n_windows": [8.0], "n_coupled": [float(n_coupled)], "way": [60.0],
                                "warm_up_way": [20.0], "mean_speed": [0.47], "reference_hit_error": [7e-7],
                                "cpu_s_window": [0.4]})
    return path
