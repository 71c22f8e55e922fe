"""Exceedance of the window depth at a measuring point, from the rings of a results file.

A realisation's ring holds its wear load per arc, free of temperature and direction; both are averaged afterwards. Written
out for a constant or uniform temperature and a constant direction or a rose (docstring of `exceedance`); a campaign with
other laws, with a site table, with failed realisations or with another abrasion law than bekker2011 gives None, and so
does a curve that does not pass through the percentiles that floewear itself has stored in the file: two computations of
one number have to agree before one of them is drawn.
"""
import numpy as np

COEFFICIENT, EXPONENT = 0.116, 1.121  # bekker2011, eq. (1) of the source paper: mm/km, MPa, degC
N_DEPTHS = 400


def exceedance(results, point):
    """(depth [mm], P(window depth > depth)) of one point, or None.

    P(D > x) = weighted mean over realisations, sum over directions d of w_d P(|T| < (a L_d / x)^(1/m)),
    with L_d the wear load of the arc that faces the point's bearing when the current flows to d."""
    if not results.directions or results.temperatures is None or results.n_failed or results.law != "bekker2011":
        return None
    rows = results.percentiles["point"] == point
    bearing = results.percentiles["bearing_deg"][rows][0]
    n, n_arcs = results.load.shape
    weights, loads = [], []
    for flows_to, share in results.directions:
        theta = (bearing - flows_to - 180.0) % 360.0
        loads.append(results.load[:, int(np.floor(theta * n_arcs / 360.0 + 1e-9)) % n_arcs])
        weights.append(share * results.weights)
    loads, weights = np.concatenate(loads), np.concatenate(weights)
    warmest, coldest = results.temperatures

    def probability(depth):
        limit = (COEFFICIENT * loads[None, :] / np.atleast_1d(depth)[:, None]) ** (1.0 / EXPONENT)
        if coldest > warmest:
            share = np.clip((limit - warmest) / (coldest - warmest), 0.0, 1.0)
        else:
            share = (limit > warmest).astype(float)
        return share @ weights

    deepest = COEFFICIENT * loads.max() * warmest**-EXPONENT
    if not deepest > 0.0:
        return None
    known = results.percentiles["depth_mm"][rows]
    wanted = 1.0 - results.percentiles["percentile"][rows] / 100.0
    seen = known > 0.0
    # A step of the sample is 1/n high, and a percentile may stand on either side of it.
    below, above = probability(known[seen] * (1.0 + 1e-6)), probability(known[seen] * (1.0 - 1e-6))
    if np.any(below > wanted[seen] + 1.0 / n + 1e-3) or np.any(above < wanted[seen] - 1.0 / n - 1e-3):
        return None
    depth = np.geomspace(deepest * 1e-5, deepest * (1.0 - 1e-9), N_DEPTHS)
    return depth, probability(depth)
