#!/usr/bin/env python3
"""Reference solutions of scenes with wind, skin drag, added mass, deflected flow, a current that changes, and floes with contact properties
of their own; independent of floewear and of solve.py beside it (README.md here tells the equations).

    solve_effects.py write     effects.csv anew
    solve_effects.py check     every scene again at other tolerances, and without the overlap as an unknown, against the file
    solve_effects.py order     what a current in segments does: error against their length

Needs numpy and scipy. Unknowns per floe: x, y, vx, vy, spin and five sums (impulse, time, path, depth, depth x wall); per closed contact its
overlap, 0 at the touch, so that no digits are lost where rims just meet. scipy's DOP853 runs on one smooth branch of the model at a time; a
step in which a branch ends (touch, parting, force gone or back, slip at its cap, slip turned, a floe's centre past the structure's axis in
deflected flow, a row of a course) is thrown away from that instant on, which is found on its interpolant and then on real steps.
"""
import csv
import math
import os
import sys

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq
from scipy.special import roots_jacobi

RS, RHO_I, RHO_W, RHO_A = 3.7, 900.0, 1025.0, 1.3
AIR_SKIN, AIR_FORM = 0.0018, 1.1
TEMPERATURE, LAW, EXPONENT = -10.0, 0.116, 1.121
RATE = LAW * abs(TEMPERATURE) ** -EXPONENT * 1e-3  # depth [mm] per way [m] and MPa^m
N_FLOE = 10
WALL = -1
OPEN, LOOSE, PRESSING = "open", "loose", "pressing"

DEFAULTS = {"speed": 2.0, "k": 2.0e6, "mu": 0.1, "form_drag": 10.0, "skin_drag": 0.0, "added_mass": 0, "deflected": 0, "rotation": 1,
            "floe_k": 0.0, "floe_mu": -1.0, "wind_speed": 0.0, "wind_deg": 0.0, "period": 0.0, "minor_ratio": 0.0, "phase": 0.0, "course": ""}


def added_share(R, draft):
    """Lamb, art. 114: oblate spheroid with half axes R, R, draft that moves along R; over the displaced mass, which is the floe's own."""
    e = math.sqrt(1 - (draft / R) ** 2)
    b0 = math.sqrt(1 - e * e) * math.asin(e) / e**3 - (1 - e * e) / e**2
    return b0 / (2 - b0)


class Floe:
    def __init__(self, p, D, h, x, y, vx, vy, spin):
        self.R, self.h = D / 2, h
        own = RHO_I * math.pi * self.R**2 * h
        self.m = own * (1 + (added_share(self.R, h * RHO_I / RHO_W) if p["added_mass"] else 0))
        self.inertia = own * self.R**2 / 2
        self.face = 0.5 * RHO_W * p["skin_drag"] * math.pi * self.R**2
        self.water = 0.5 * RHO_W * p["form_drag"] * D * h + self.face
        self.air = 0.5 * RHO_A * (AIR_SKIN * math.pi * self.R**2 + AIR_FORM * D * (1 - RHO_I / RHO_W) * h) if p["wind_speed"] else 0.0
        self.start = (x, y, vx, vy, spin)
        self.is_behind = False


class Pair:
    def __init__(self, p, floes, a, b):
        self.a, self.b = a, b
        ma = floes[a].m
        m = ma if b == WALL else ma * floes[b].m / (ma + floes[b].m)
        self.k = p["floe_k"] if b != WALL and p["floe_k"] > 0 else p["k"]
        self.mu = p["floe_mu"] if b != WALL and p["floe_mu"] >= 0 else p["mu"]
        self.c = 2 * math.sqrt(self.k * m)
        self.w = math.sqrt(self.k / m)
        self.mode, self.cap, self.sign = OPEN, 0, 1


def course_rows(text):
    return [tuple(float(v) for v in row.split(":")) for row in text.split(";")]


class Scene:
    def __init__(self, p, starts, t_end, rtol=1e-13, by_overlap=True, segment=0.0):
        self.p, self.t_end, self.rtol, self.by_overlap, self.segment = p, t_end, rtol, by_overlap, segment
        self.floes = [Floe(p, *s) for s in starts]
        n = len(starts)
        self.pairs = [Pair(p, self.floes, i, WALL) for i in range(n)] + [Pair(p, self.floes, i, j) for i in range(n) for j in range(i)]
        self.y = np.zeros(n * N_FLOE + len(self.pairs))
        for i, f in enumerate(self.floes):
            self.y[i * N_FLOE : i * N_FLOE + 5] = f.start
        self.atol = np.full(self.y.size, 1e-14)
        scale = (1, 1, 1, 1, 1, 1e5, 1, 0.1, 1e-7, 1e-7)
        for i in range(n):
            self.atol[i * N_FLOE : (i + 1) * N_FLOE] = rtol * np.array(scale)
        self.atol[n * N_FLOE :] = rtol * 1e-3
        self.t, self.h = 0.0, 1e-3
        self.wind = tuple(p["wind_speed"] * f(math.radians(p["wind_deg"])) for f in (math.cos, math.sin))
        self.rows = course_rows(p["course"]) if p["course"] else []
        self.fresh = None
        for i, f in enumerate(self.floes):
            f.is_behind = self.ahead(self.t, self.y, i) > 0
        for q in self.pairs:
            d, rate, *_ = self.contact(q, self.y, geometric=True)
            if abs(d) < 1e-12 and rate > 0:
                self.touch(q)

    # --- water and air ------------------------------------------------------------------------------------------------
    def current(self, t):
        p = self.p
        if self.segment:
            t = (math.floor(t / self.segment * (1 + 1e-12)) + 0.5) * self.segment
        if p["period"]:
            phi = p["phase"] + 2 * math.pi * (t - self.t_end / 2) / p["period"]
            return p["speed"] * math.cos(phi), p["speed"] * p["minor_ratio"] * math.sin(phi)
        if self.rows:
            k = max([i for i, r in enumerate(self.rows) if r[0] <= t], default=0)
            if not self.segment:
                k = self.row  # the branch that is being integrated
            time, factor, turn = self.rows[k]
            if k + 1 < len(self.rows):
                u = (t - time) / (self.rows[k + 1][0] - time)
                factor, turn = factor + u * (self.rows[k + 1][1] - factor), turn + u * (self.rows[k + 1][2] - turn)
            return p["speed"] * factor * math.cos(turn), p["speed"] * factor * math.sin(turn)
        return p["speed"], 0.0

    def ahead(self, t, y, i):
        u, v = self.current(t)
        return u * y[i * N_FLOE] + v * y[i * N_FLOE + 1]

    def water(self, t, x, y, f):
        u, v = self.current(t)
        if not self.p["deflected"]:
            return u, v
        U = math.hypot(u, v)
        if U == 0:
            return 0.0, 0.0
        phi, q = math.atan2(y, x) - math.atan2(v, u), RS**2 / (x * x + y * y)
        along, left = U * (1 - q * math.cos(2 * phi)), 0.0 if f.is_behind else -U * q * math.sin(2 * phi)
        return (along * u - left * v) / U, (along * v + left * u) / U

    # --- the model ----------------------------------------------------------------------------------------------------
    def contact(self, q, y, geometric=False):
        """Overlap, closing rate, slip, normal."""
        a = y[q.a * N_FLOE : q.a * N_FLOE + 5].tolist()
        b = [0.0] * 5 if q.b == WALL else y[q.b * N_FLOE : q.b * N_FLOE + 5].tolist()
        Ra, Rb = self.floes[q.a].R, RS if q.b == WALL else self.floes[q.b].R
        dx, dy, ux, uy = a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]
        r = math.hypot(dx, dy)
        nx, ny = dx / r, dy / r
        d = Ra + Rb - r if geometric or not self.by_overlap or q.mode == OPEN else y[len(self.floes) * N_FLOE + self.pairs.index(q)]
        return d, -(ux * nx + uy * ny), uy * nx - ux * ny - Ra * a[4] - Rb * b[4], nx, ny

    def wear(self, q, d, N, slip):
        R, h = self.floes[q.a].R, self.floes[q.a].h
        chord = math.sqrt(max(0.0, d * (2 * R - d) * (2 * RS - d) * (2 * R + 2 * RS - d))) / (R + RS - d)
        if not (chord > 0 and N > 0):
            return 0.0, 0.0
        rate = RATE * (N / (chord * h) * 1e-6) ** EXPONENT * q.sign * slip
        return rate, rate * chord

    def rhs(self, t, y):
        out = np.zeros_like(y)
        for i, f in enumerate(self.floes):
            x, Y, vx, vy, spin = y[i * N_FLOE : i * N_FLOE + 5].tolist()
            ux, uy = self.water(t, x, Y, f)
            V = math.hypot(ux - vx, uy - vy)
            A = math.hypot(self.wind[0] - vx, self.wind[1] - vy)
            ax = (f.water * V * (ux - vx) + f.air * A * (self.wind[0] - vx)) / f.m
            ay = (f.water * V * (uy - vy) + f.air * A * (self.wind[1] - vy)) / f.m
            torque = -f.face * f.R**2 * spin * math.hypot(0.75 * V, 0.4 * f.R * spin)
            out[i * N_FLOE : i * N_FLOE + 5] = vx, vy, ax, ay, torque / f.inertia
        for n, q in enumerate(self.pairs):
            if q.mode == OPEN:
                continue
            d, rate, slip, nx, ny = self.contact(q, y)
            out[len(self.floes) * N_FLOE + n] = rate
            if q.mode == LOOSE:
                continue
            N = q.k * d + q.c * rate
            F = -q.cap * q.mu * N if q.cap else -q.c * slip
            fx, fy = N * nx - F * ny, N * ny + F * nx
            for i, s in ((q.a, 1), (q.b, -1)):
                if i == WALL:
                    continue
                f, o = self.floes[i], i * N_FLOE
                out[o + 2] += s * fx / f.m
                out[o + 3] += s * fy / f.m
                out[o + 4] -= F * f.R / f.inertia
            if q.b == WALL:
                o = q.a * N_FLOE
                out[o + 5], out[o + 6], out[o + 7] = N, 1.0, q.sign * slip
                if self.fresh is not q:
                    out[o + 8], out[o + 9] = self.wear(q, d, N, slip)
        if not self.p["rotation"]:
            out[4 : len(self.floes) * N_FLOE : N_FLOE] = 0
        return out

    # --- branches: each value stays positive on its branch -------------------------------------------------------------
    def guards(self, t, y):
        out = []
        for q in self.pairs:
            d, rate, slip, *_ = self.contact(q, y)
            N = q.k * d + q.c * rate
            if q.mode == OPEN:
                out.append((-d, self.touch, q))
            elif q.mode == LOOSE:
                out += [(d, self.part, q), (-N, self.press, q)]
            else:
                out.append((N, self.let_go, q))
                if q.cap:
                    out.append((q.cap * q.c * slip - q.mu * N, self.stick, q))
                else:
                    out += [(q.mu * N - q.c * slip, self.slide_on, q), (q.mu * N + q.c * slip, self.slide_back, q)]
                    if q.b == WALL:
                        out.append((q.sign * slip, self.turn, q))
        if self.p["deflected"]:
            for i, f in enumerate(self.floes):
                out.append(((-1 if f.is_behind else 1) * -self.ahead(t, y, i), self.cross, f))
        return out

    def slide_on(self, q):
        q.cap = q.sign = 1

    def slide_back(self, q):
        q.cap = q.sign = -1

    def stick(self, q):
        q.cap = 0

    def turn(self, q):
        q.sign = -q.sign

    def let_go(self, q):
        q.mode, q.cap = LOOSE, 0

    def part(self, q):
        q.mode = OPEN

    def cross(self, f):
        f.is_behind = not f.is_behind

    def press(self, q):
        d, rate, slip, *_ = self.contact(q, self.y)
        q.mode, q.sign = PRESSING, 1 if slip >= 0 else -1
        q.cap = q.sign if q.c * abs(slip) > q.mu * max(0.0, q.k * d + q.c * rate) else 0

    def touch(self, q):
        self.y[len(self.floes) * N_FLOE + self.pairs.index(q)] = 0.0
        q.mode = LOOSE
        self.press(q)
        if q.b == WALL:
            self.first_wear(q)

    # --- integration ---------------------------------------------------------------------------------------------------
    def solver(self, t, y, until, h):
        return DOP853(self.rhs, t, y, until, rtol=self.rtol, atol=self.atol, first_step=min(h, until - t))

    def reach(self, t, y, until, h):
        """Real steps to until, no questions asked."""
        if until <= t:
            return y
        s = self.solver(t, y, until, h)
        while s.status == "running":
            s.step()
        return s.y

    def advance(self, until, is_trial=False):
        """To until, or to the first end of a branch, whose consequences are drawn (not in a trial). True: one was met."""
        while self.t < until:
            s = self.solver(self.t, self.y, until, self.h)
            first = True
            while s.status == "running":
                t0, y0 = s.t, s.y
                s.step()
                if s.status == "failed":
                    raise RuntimeError(f"t = {s.t}")
                h, dense = s.t - t0, None
                before, middle_t = self.guards(t0, y0), t0 + 0.5 * h
                found = []
                at_end = self.guards(s.t, s.y)
                dense = s.dense_output()
                middle = self.guards(middle_t, dense(middle_t))
                for n in range(len(at_end)):
                    if at_end[n][0] >= 0 and middle[n][0] >= 0:
                        continue
                    upper = middle_t if middle[n][0] < 0 else s.t
                    value = lambda t, n=n: self.guards(t, dense(t))[n][0]
                    lower = t0 if before[n][0] > 0 and not first else t0 + 1e-3 * (upper - t0)
                    at = brentq(value, lower, upper, xtol=1e-16, rtol=1e-15) if value(lower) > 0 else lower
                    found.append((at, n))
                first = False
                if not found:
                    self.t, self.y, self.h = s.t, s.y, max(h, 1e-9)
                    continue
                at, n = min(found)
                y1 = self.reach(t0, y0, at, at - t0)
                for _ in range(3):  # on real steps
                    g = self.guards(at, y1)[n][0]
                    slope = (self.guards(at + 1e-7, self.reach(at, y1, at + 1e-7, 1e-7))[n][0] - g) / 1e-7
                    if slope == 0 or abs(g / slope) > 1e-6 or not t0 < at - g / slope < s.t:
                        break
                    at -= g / slope
                    y1 = self.reach(t0, y0, at, at - t0)
                _, change, what = before[n]
                self.t, self.y, self.h = at, y1.copy(), 1e-2 / max(q.w for q in self.pairs)
                if not is_trial:
                    change(what)
                return True
        return False

    def first_wear(self, q):
        """Of the first piece after a touch. Pressure goes with t^(-1/2) there: with t = u^2 both integrands are u^(1-m) times a smooth function, and
        Gauss's rule with that weight is exact to rounding. The motion goes from node to node; a piece must not contain the end of a branch."""
        keep = self.t, self.y.copy()
        x, weight = roots_jacobi(16, 0, 1 - EXPONENT)
        length = 0.15 / max(p.w for p in self.pairs)
        self.fresh = q
        while True:
            self.t, self.y, self.h = keep[0], keep[1].copy(), 1e-2 * length
            total, is_cut = np.zeros(2), False
            for u, share in zip((1 + x) / 2, weight):
                is_cut = is_cut or self.advance(keep[0] + length * u * u, is_trial=True)
                d, rate, slip, *_ = self.contact(q, self.y)
                total += share * u**EXPONENT * np.array(self.wear(q, d, q.k * d + q.c * rate, slip))
            if not (is_cut or self.advance(keep[0] + length, is_trial=True)):
                break
            length = 0.5 * (self.t - keep[0])
            assert length > 1e-12
        self.fresh = None
        self.y = self.y.copy()
        self.y[q.a * N_FLOE + 8 : q.a * N_FLOE + 10] += total * length * 2 ** (EXPONENT - 1)

    def run(self):
        stops = [r[0] for r in self.rows if 0 < r[0] < self.t_end] if not self.segment else []
        if self.segment:
            stops += [k * self.segment for k in range(1, int(self.t_end / self.segment) + 1)]
        stops = sorted(set(stops + [self.t_end]))
        self.row = 0
        for k, stop in enumerate(stops):
            while self.t < stop:
                self.advance(stop)
            if self.rows:
                self.row = max(i for i, r in enumerate(self.rows) if r[0] <= self.t)
        return self

    row = 0

    def rows_out(self, name, starts):
        out = []
        n = len(self.floes)
        for i, start in enumerate(starts):
            row = {"scene": name, "t_end": self.t_end} | (self.p if i == 0 else {}) | {"floe": i}
            row |= dict(zip(("D", "h", "x0", "y0", "vx0", "vy0", "spin0"), start))
            row |= dict(zip(("x", "y", "vx", "vy", "spin"), self.y[i * N_FLOE : i * N_FLOE + 5].tolist()))
            out.append(row)
        sums = sum(self.y[i * N_FLOE + 5 : (i + 1) * N_FLOE] for i in range(n)).tolist()
        out[0] |= dict(zip(("J_N", "t_force", "path", "depth_mm", "W_mm_m"), sums))
        return out


# --- the scenes --------------------------------------------------------------------------------------------------------
A, B, C, L = (2.5, 0.5), (5.0, 0.9), (1.6, 0.4), (8.0, 1.1)  # D, h


def off(floe, y, gap=0.3, vx=2.0, vy=0.0, spin=0.0):
    """gap upstream of the structure at offset y"""
    return (*floe, -math.sqrt((RS + floe[0] / 2) ** 2 - y * y) - gap, y, vx, vy, spin)


TWO = [(*A, -5.2, 0.6, 2.0, 0.0, 0.0), (*A, -8.2, 0.4, 2.0, 0.0, 0.0)]
THREE = [(*B, -6.6, 0.8, 2.0, 0.0, 0.0), (*A, -10.6, -0.4, 2.0, 0.0, 0.0), (*C, -8.6, 3.6, 2.0, 0.0, 0.0)]
SPUN = [(*A, -5.2, 0.6, 2.0, 0.0, 1.5), (*B, -9.4, 1.4, 2.0, 0.0, -0.8)]
SCENES = {
    "W01_wind_along": (8.0, {"wind_speed": 15.0}, [off(A, 1.0)]),
    "W02_wind_60": (8.0, {"wind_speed": 15.0, "wind_deg": 60.0}, [off(B, -1.5)]),
    "W03_wind_against": (8.0, {"wind_speed": 25.0, "wind_deg": 180.0}, [off(A, 2.0)]),
    "W04_wind_60_three": (10.0, {"wind_speed": 20.0, "wind_deg": 60.0}, THREE),
    "S01_skin_alone": (40.0, {"form_drag": 0.0, "skin_drag": 0.0055}, [off(A, 1.0, spin=-0.7)]),
    "S02_skin_rough": (9.0, {"skin_drag": 0.2}, [off(B, 2.0, spin=0.5)]),
    "S03_skin_two": (9.0, {"skin_drag": 0.1}, SPUN),
    "S04_skin_locked": (7.0, {"skin_drag": 0.1, "rotation": 0}, [off(A, 1.5, spin=0.4)]),
    "M01_added_mass": (8.0, {"added_mass": 1}, [off(A, 1.0)]),
    "M02_added_mass_large": (8.0, {"added_mass": 1}, [off(L, 3.0)]),
    "M03_added_mass_two": (9.0, {"added_mass": 1}, TWO),
    "D01_deflected": (9.0, {"deflected": 1}, [off(A, 0.7, gap=1.0, vx=1.2)]),
    "D02_deflected_large": (9.0, {"deflected": 1}, [off(L, -3.0, gap=1.0, vx=1.6)]),
    "D03_deflected_behind": (8.0, {"deflected": 1}, [(*A, -4.0, 3.6, 2.0, 0.3, 0.0)]),
    "D04_deflected_two": (9.0, {"deflected": 1}, [(*A, -5.4, 1.0, 1.6, 0.2, 0.0), (*B, -9.8, -0.6, 1.9, 0.0, 0.0)]),
    "I01_ice_on_ice": (9.0, {"floe_k": 5.0e5, "floe_mu": 0.3}, TWO),
    "I02_ice_on_ice_three": (10.0, {"floe_k": 6.0e6, "floe_mu": 0.02}, THREE),
    "T01_to_and_fro": (30.0, {"period": 200.0, "phase": 0.5}, [off(A, 1.0)]),
    "T02_ellipse": (30.0, {"period": 200.0, "minor_ratio": 0.3, "phase": 0.2}, [off(B, 1.5)]),
    "T03_ellipse_back": (30.0, {"period": 200.0, "minor_ratio": -0.5, "phase": 1.0}, TWO),
    "T04_reversal": (50.0, {"period": 200.0, "phase": 1.5}, [off(A, 1.0, vx=1.3), (*B, 7.5, 1.2, 1.3, 0.0, 0.0)]),
    "T05_course": (20.0, {"course": "0:0.6:0;4:1:0;9:1:0.5;15:0.4:-0.2"}, [off(A, 1.0, vx=1.2), (*B, -10.4, -0.8, 1.2, 0.0, 0.0)]),
    "X01_all_but_tide": (10.0, {"wind_speed": 15.0, "wind_deg": -60.0, "skin_drag": 0.02, "added_mass": 1, "deflected": 1, "floe_k": 1.0e6,
                                "floe_mu": 0.05}, THREE),
    "X02_all": (20.0, {"wind_speed": 15.0, "wind_deg": 60.0, "skin_drag": 0.02, "added_mass": 1, "deflected": 1, "floe_k": 1.0e6, "floe_mu": 0.05,
                       "period": 200.0, "minor_ratio": 0.3, "phase": -0.3}, TWO),
}
RESULTS = ("x", "y", "vx", "vy", "spin", "J_N", "t_force", "path", "depth_mm", "W_mm_m")


def solve(name, **how):
    t_end, given, starts = SCENES[name]
    return Scene(DEFAULTS | given, starts, t_end, **how).run().rows_out(name, starts)


def difference(rows, others):
    """Largest difference of results: relative for sums, m and m/s for states."""
    worst = 0.0, ""
    for row, other in zip(rows, others):
        for key in RESULTS:
            a, b = (float(r[key]) if r.get(key) not in (None, "") else 0.0 for r in (row, other))
            scale = max(1.0, abs(b)) if key in RESULTS[:5] else abs(b) or 1.0
            worst = max(worst, (abs(a - b) / scale, key))
    return worst


def main(command):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "effects.csv")
    if command == "write":
        rows = [row for name in SCENES for row in solve(name)]
        with open(path, "w", newline="") as f:
            table = csv.DictWriter(f, rows[0].keys(), lineterminator="\n")
            table.writeheader()
            table.writerows(rows)
        return 0
    if command == "order":
        for name in (n for n in SCENES if n[0] == "T" or n == "X02_all"):
            exact, before = solve(name), None
            for segment in (1.0, 0.5, 0.25, 0.125, 0.0625):
                rows = solve(name, segment=segment)
                errors = [abs(float(rows[0][k]) / float(exact[0][k]) - 1) for k in ("J_N", "depth_mm", "W_mm_m")]
                errors.append(max(math.hypot(a["x"] - b["x"], a["y"] - b["y"]) for a, b in zip(rows, exact)))
                orders = [math.log2(a / b) if b > 0 and a > 0 else 0 for a, b in zip(before, errors)] if before else []
                print(f"{name:18s} {segment:7.4f} s  J {errors[0]:.1e}  depth {errors[1]:.1e}  W {errors[2]:.1e}  place {errors[3]:.1e} m   order "
                      + " ".join(f"{o:.2f}" for o in orders), flush=True)
                before = errors
        return 0
    with open(path, newline="") as f:
        table = list(csv.DictReader(f))
    is_good = True
    for name in SCENES:
        mine = [r for r in table if r["scene"] == name]
        for how in ({"rtol": 3e-12}, {"by_overlap": False, "rtol": 1e-12}):
            worst, key = difference(solve(name, **how), mine)
            is_good = is_good and worst <= 1e-7
            print(f"{name:22s} {how}: {worst:.1e} ({key})", flush=True)
    return 0 if is_good else 1


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in ("check", "write", "order"):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
