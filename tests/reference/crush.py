#!/usr/bin/env python3
"""Reference solutions of single floes against a structure that crushes them: independent of the C code, kept in crush.csv.

usage: crush.py check | write        (needs numpy and scipy; a minute)

One floe in polar coordinates about the structure, SciPy's DOP853 from one change of law to the next, each located:

  PUSH     d' > 0 at the deepest overlap: N = F(d) = P0 (b h)^(1-q); what the wall's disc leaves in the rim is kept, point by point
  FLAT     d < D: N = F(D) (1 - kappa (D - d) / D) + c d', c = 2 sqrt(kappa F(D) / D m); FREE where that is below 0, FULL (N = F(D)) where above F(D)
  RECEDE   d' < 0 where D has turned away: N = max(0, F(d) + c d')

D at a place of the rim is the largest of depth - s^2 / (2 R*) over all that was kept, none of it on a grid. Friction, drag and wear as in solve.py; the
flat's moment -cr (w - v/r), at most N b / 2 (1 - N / F(D)), with the force -M/r along the wall. depth_mm is counted along the contact, W_mm_m over the wall.
`check` solves every row twice, with tolerances 1e-9 and 1e-10 (and the kept imprints twice as dense): the worst difference is printed."""
import csv
import math
import os
import sys

import numpy as np
from scipy.integrate import solve_ivp

RS, RHO, RHO_W, MU, EXPONENT = 3.7, 900.0, 1025.0, 0.1, 1.121
RATE = 0.116 * 10**-EXPONENT * 1e-3  # mm per m and MPa^m at -10 degC
PUSH, FLAT, FREE, FULL, RECEDE = range(5)
GIVEN = ("D", "h", "y0", "speed", "pressure", "exponent", "form_drag", "flat", "t_end")
FOUND = ("d_max", "N_peak", "J_N", "path", "depth_mm", "W_mm_m", "t_force", "spin", "orbit")


class Hit:
    def __init__(self, D, h, y0, speed, pressure, exponent, form_drag, flat, t_end, tol, spacing):
        self.R, self.h, self.U, self.P0, self.q, self.flat, self.t_end, self.tol, self.spacing = D / 2, h, speed, pressure, exponent, flat, t_end, tol, spacing
        R = self.R
        self.m = RHO * math.pi * R * R * h
        self.inertia, self.star, self.K = self.m * R * R / 2, R * RS / (R + RS), 0.5 * RHO_W * form_drag * D * h
        e = 1.5 - exponent / 2
        self.kappa = e / (2 * math.exp(-2))
        g = 2 * math.sqrt(2 * self.star) * h
        d0 = (0.01 / g) ** 2 if exponent else 0.0
        work0 = 2 / 3 * pressure * 0.01 ** (1 - exponent) * d0
        deepest = ((0.5 * self.m * speed**2 - work0) * e / (pressure * g ** (1 - exponent)) + d0**e) ** (1 / e)
        self.ct = 2 * self.m * speed / (math.e * deepest)  # of the critically damped spring that is as deep
        self.cr = self.ct * R * R
        self.depth, self.place = np.zeros(0), np.zeros(0)

    def chord(self, d):
        R = self.R
        return math.sqrt(d * (2 * (R + RS) - d) * (2 * R - d) * (2 * RS - d)) / (R + RS - d) if d > 0 else 0.0

    def F(self, d):
        area = self.chord(d) * self.h  # the law's pressure holds on below 0.01 m2
        return self.P0 * max(area, 0.01) ** -self.q * area if d > 0 else 0.0

    def deepest(self, s):
        return max(0.0, float(np.max(self.depth - (s - self.place) ** 2 / (2 * self.star)))) if self.depth.size else 0.0

    def keep(self, d, s):
        self.depth, self.place = np.append(self.depth, d), np.append(self.place, s)

    def line(self, D, d, u):
        F = self.F(D)
        return F * (1 - self.kappa * (D - d) / D) + 2 * math.sqrt(self.kappa * F / D * self.m) * u

    def load(self, mode, d, u, s):
        """N, the overlap that chord and F belong to, F."""
        if mode == PUSH:
            return self.F(d), d, self.F(d)
        if mode == RECEDE:
            F = self.F(d)
            return (max(0.0, F + 2 * math.sqrt(self.kappa * F / d * self.m) * u) if d > 0 else 0.0), d, F
        D = self.deepest(s)
        F = self.F(D)
        if D <= 0 or mode == FREE:
            return 0.0, D, F
        return (F if mode == FULL else max(0.0, self.line(D, d, u))), D, F

    def rhs(self, mode):
        def f(_, z):
            d, u, v, w, s, angle = z[:6]
            R, r = self.R, self.R + RS - d
            N, D, F = self.load(mode, d, u, s)
            slip = v - R * w
            rub = -max(-MU * N, min(MU * N, self.ct * slip))
            M = 0.0
            if self.flat and N > 0 and mode != PUSH:
                cap = max(0.0, N * self.chord(D) / 2 * (1 - N / F))
                M = -max(-cap, min(cap, self.cr * (w - v / r)))
            nx, ny = math.cos(angle), math.sin(angle)
            rx, ry = self.U + u * nx + v * ny, u * ny - v * nx
            drag = self.K * math.hypot(rx, ry)
            out, along = drag * (rx * nx + ry * ny), drag * (ry * nx - rx * ny)
            b = self.chord(D)
            wear = RATE * (N / (b * self.h) * 1e-6) ** EXPONENT * abs(slip) if b > 0 and N > 0 else 0.0
            return [u, -(N + out) / self.m - v * v / r, (rub - M / r + along) / self.m + u * v / r, (M - R * rub) / self.inertia, R * (v / r - w), v / r,
                    N, abs(slip) if N > 0 else 0.0, wear, wear * b, 1.0 if N > 0 else 0.0]
        return f

    def events(self, mode):
        def signed(z):
            D = self.deepest(z[4])
            return self.line(D, z[0], z[1]) if D > 0 else -1.0

        def full(z):
            D = self.deepest(z[4])
            return self.line(D, z[0], z[1]) / self.F(D) - 1 if D > 0 else 1.0

        over = lambda z: z[0] - self.deepest(z[4])
        rate, apart = lambda z: z[1], lambda z: z[0]
        after = {PUSH: [(rate, -1, "peak")], FLAT: [(over, 1, "over"), (signed, -1, FREE), (full, 1, FULL)], FULL: [(over, 1, "over"), (full, -1, FLAT)],
                 FREE: [(signed, 1, FLAT), (over, 1, "over"), (apart, -1, "apart")], RECEDE: [(over, -1, FLAT), (rate, 1, PUSH), (apart, -1, "apart")]}[mode]
        functions = []
        for g, direction, _ in after:
            e = lambda _, z, g=g: g(z)
            e.terminal, e.direction = True, direction
            functions.append(e)
        return functions, [what for *_, what in after]

    def go(self, mode, t, z, events):
        return solve_ivp(self.rhs(mode), (t, self.t_end), z, method="DOP853", rtol=self.tol, atol=1e-4 * self.tol, events=events,
                         first_step=min(1e-7, self.t_end - t), max_step=0.02)

    def write(self, sol):
        """What a push leaves: its course, as densely as the place moves."""
        for i in range(len(sol.t)):
            d, s = sol.y[0, i], sol.y[4, i]
            if i == len(sol.t) - 1 or not self.depth.size or abs(s - self.place[-1]) > self.spacing or d - self.depth[-1] > 0.02 * d:
                self.keep(d, s)

    def solve(self, y0):
        reach = self.R + RS
        angle = math.atan2(y0, -math.sqrt(reach**2 - y0**2))
        z = np.array([1e-13, -self.U * math.cos(angle), -self.U * math.sin(angle), 0, 0, angle, 0, 0, 0, 0, 0])
        t, mode, d_max = 0.0, PUSH, 0.0
        while t < self.t_end:
            events, after = self.events(mode)
            sol = self.go(mode, t, z, events)
            t, z = sol.t[-1], sol.y[:, -1].copy()
            if mode == PUSH:
                self.write(sol)
                d_max = max(d_max, z[0])
            if t >= self.t_end:
                break
            hit = after[[i for i, found in enumerate(sol.t_events) if len(found)][0]]
            if hit == "peak":  # does the place turn away faster than the floe backs off?
                acceleration, turn = self.rhs(PUSH)(t, z)[1], self.rhs(PUSH)(t, z)[4]
                mode = FLAT if acceleration < -(turn**2) / self.star else RECEDE
            elif hit == "over":
                mode = PUSH if z[1] > 0 else RECEDE
            elif hit == "apart":
                z[0] = -1e-12
                back = lambda _, z: z[0]
                back.terminal, back.direction = True, 1
                sol = self.go(FREE, t, z, [back])
                t, z = sol.t[-1], sol.y[:, -1].copy()
                if t >= self.t_end:
                    break
                z[0] = max(z[0], 1e-13)
                D = self.deepest(z[4])
                mode = PUSH if D <= 0 else FLAT if self.line(D, z[0], z[1]) > 0 else FREE
            else:
                mode = hit
        return dict(zip(FOUND, (d_max, self.F(d_max), z[6], z[7], z[8], z[9], z[10], z[3], z[2] / (reach - z[0]))))


CASES = [  # D, h, y0, speed, pressure, exponent, form drag, flat, t_end
    (2.5, 0.5, 0.99, 2.0, 0.5e6, 0.0, 10.0, 1, 4.9), (2.5, 0.5, 0.99, 2.0, 0.5e6, 0.0, 10.0, 0, 4.9), (2.5, 0.5, 1.5, 2.0, 1.1e6, 0.0, 10.0, 1, 4.9),
    (2.5, 0.5, 3.5, 2.0, 1.1e6, 0.0, 10.0, 1, 4.0), (8.0, 1.1, 3.0, 2.0, 1.1e6, 0.0, 10.0, 1, 6.0), (12.0, 1.3, 6.0, 1.0, 1.1e6, 0.0, 10.0, 1, 15.0),
    (1.2, 0.3, 0.6, 2.0, 1.1e6, 0.0, 10.0, 1, 4.0), (10.0, 1.1, 1.0, 2.0, 3.0e6, 0.0, 10.0, 1, 6.0), (2.5, 0.5, 0.3, 2.0, 1.1e6, 0.0, 10.0, 1, 6.0),
    (5.0, 0.7, 2.0, 1.0, 1.1e6, 0.3, 10.0, 1, 4.0), (6.0, 0.9, 3.0, 1.5, 2.0e6, 0.2, 1.0, 1, 6.0),
]


def row_of(case, tol, spacing):
    *given, flat, t_end = case
    found = Hit(*given, bool(flat), t_end, tol, spacing).solve(given[2])
    return dict(zip(GIVEN, case)) | found


def main(command):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "crush.csv")
    if command == "write":
        with open(path, "w", newline="") as f:
            table = csv.DictWriter(f, GIVEN + FOUND, lineterminator="\n")
            table.writeheader()
            table.writerows(row_of(c, 1e-10, 2e-4) for c in CASES)
    with open(path, newline="") as f:
        rows = [{k: float(v) for k, v in r.items()} for r in csv.DictReader(f)]
    worst = 0.0
    for case, row in zip(CASES, rows, strict=True):
        other = row_of(case, 1e-9, 4e-4)
        difference = {k: abs(other[k] / row[k] - 1) for k in FOUND}
        k = max(difference, key=difference.get)
        print(f"D {case[0]:g} h {case[1]:g} offset {case[2]:g} at {case[3]:g} m/s: worst difference {difference[k]:.1e} ({k})", flush=True)
        worst = max(worst, difference[k])
    return 0 if worst <= 1e-4 else 1


if __name__ == "__main__":
    if sys.argv[1:] not in (["check"], ["write"]):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
