#!/usr/bin/env python3
"""Reference solutions of the floe model, independent of floewear (README.md here says what is in the tables).

    solve.py check          the tables again: both formulations against each other and against every file
    solve.py write          extreme_floes.csv, extreme_multi.csv and limited_floes.csv anew

Needs numpy and scipy. Method: DOP853 with error control on a right-hand side that is smooth between events. Every contact has
a mode (open, loose: overlap without force, pressing; sliding or not; sign of slip) that fixes which branch of each max, min and
modulus is taken; a step in which a branch would change is cut where it changes, by a root finder on real steps of
the method, so no formula is ever integrated across its kink. Two formulations: `cartesian`, and `polar` about the structure with
the gap itself as the unknown, which does not lose digits where rims just touch.
"""
import csv
import math
import os
import sys

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar
from scipy.special import roots_jacobi

K, MU, CF, RHO_I, RHO_W, U, RS = 2.0e6, 0.1, 10.0, 900.0, 1025.0, 2.0, 3.7  # zeta = 1, ct = c
TEMPERATURE, LAW, EXPONENT = -10.0, 0.116, 1.121
RATE = LAW * abs(TEMPERATURE) ** -EXPONENT * 1e-3  # depth [mm] per slip way [m] and MPa^m
LIMIT = None  # crushing limit on the pressure that wears: (P0 [MPa], q), P0 (A / 1 m2)^-q
OPEN, LOOSE, PRESSING = range(3)
# Per floe: 5 of motion, then what the structure contact adds up
N_STATE, SUMS = 11, ("J", "Jx", "t_force", "path", "depth", "W")
SIZE = np.array([1, 1, 1, 1, 1, 1e5, 1e5, 1, 0.1, 1e-7, 1e-7])  # what an error is relative to
J, JX, T_FORCE, PATH, DEPTH, WALL = range(5, 11)
WALL_ID = -1


class Floe:
    def __init__(self, D, h, x, y, vx=U, vy=0.0, spin=0.0):
        self.D, self.h, self.R = D, h, D / 2
        self.m = RHO_I * math.pi * self.R**2 * h
        self.inertia = self.m * self.R**2 / 2
        self.drag = 0.5 * RHO_W * CF * D * h
        self.start = (x, y, vx, vy, spin)


class Pair:
    """Floe a against floe b or the structure."""

    def __init__(self, floes, a, b):
        self.a, self.b = a, b
        m = floes[a].m if b == WALL_ID else floes[a].m * floes[b].m / (floes[a].m + floes[b].m)
        self.w, self.c = math.sqrt(K / m), 2 * math.sqrt(K * m)
        self.mode, self.slide, self.sign, self.is_fresh, self.is_capped = OPEN, 0, 1, False, False


class Scene:
    def __init__(self, floes, form="cartesian", tolerance=1e-13, first_piece=0.2):
        self.floes, self.is_polar, self.tol, self.first_piece = floes, form == "polar", tolerance, first_piece
        n = len(floes)
        self.pairs = [Pair(floes, i, WALL_ID) for i in range(n)]
        self.pairs += [Pair(floes, i, j) for i in range(n) for j in range(i)]
        self.size = np.tile(SIZE, n)
        self.t, self.z = 0.0, np.zeros(n * N_STATE)
        for i, f in enumerate(floes):
            x, y, vx, vy, spin = f.start
            r, b = math.hypot(x, y), math.atan2(y, -x)
            polar = (r - RS - f.R, b, -vx * math.cos(b) + vy * math.sin(b), vx * math.sin(b) + vy * math.cos(b), spin)
            self.z[i * N_STATE : i * N_STATE + 5] = polar if self.is_polar else f.start
        self.h, self.peak = 1e-3, np.zeros(n)
        self.first_touch, self.release, self.impact, self.exit = [None] * n, [None] * n, [None] * n, [None] * n
        self.breaks = []  # instants to stop at: ends of impacts

    # --- the model -----------------------------------------------------------------------------------------------
    def motion(self, z, i):
        """x, y, vx, vy, spin, gap to the structure, bearing (polar: theta = atan2(y, -x))."""
        a, b, va, vb, spin = z[i * N_STATE : i * N_STATE + 5].tolist()
        reach = RS + self.floes[i].R
        if not self.is_polar:
            r = math.hypot(a, b)
            return a, b, va, vb, spin, r - reach, a / r, b / r
        nx, ny = -math.cos(b), math.sin(b)  # outward; theta grows along (sin, cos)
        return (reach + a) * nx, (reach + a) * ny, va * nx + vb * ny, va * ny - vb * nx, spin, a, nx, ny

    def motions(self, z):
        return [self.motion(z, i) for i in range(len(self.floes))]

    def contact(self, p, q):
        """Overlap, closing rate, slip and normal of a pair; q: motions."""
        x, y, vx, vy, spin, gap, nx, ny = q[p.a]
        turn = self.floes[p.a].R * spin
        if p.b != WALL_ID:
            X, Y, VX, VY, SPIN = q[p.b][:5]
            x, y, vx, vy = x - X, y - Y, vx - VX, vy - VY
            r = math.hypot(x, y)
            gap, nx, ny = r - self.floes[p.a].R - self.floes[p.b].R, x / r, y / r
            turn += self.floes[p.b].R * SPIN
        return -gap, -(vx * nx + vy * ny), vy * nx - vx * ny - turn, nx, ny

    def chord(self, p, d):
        """Of the exact lens of two circles."""
        R = self.floes[p.a].R
        return math.sqrt(max(0.0, d * (2 * R - d) * (2 * RS - d) * (2 * R + 2 * RS - d))) / (R + RS - d)

    def wear_rates(self, p, d, N, slip):
        """d depth / dt [mm/s] and the same times the chord."""
        h, chord = self.floes[p.a].h, self.chord(p, d)
        if not (chord > 0 and N > 0):
            return 0.0, 0.0
        pressure = LIMIT[0] * (chord * h) ** -LIMIT[1] if p.is_capped else N / (chord * h) * 1e-6
        rate = RATE * pressure**EXPONENT * p.sign * slip
        return rate, rate * chord

    def rhs(self, z):
        out = np.zeros_like(z)
        q = self.motions(z)
        acc = []
        for f, (_, _, vx, vy, *_) in zip(self.floes, q):
            k = f.drag / f.m * math.hypot(U - vx, vy)
            acc.append([k * (U - vx), -k * vy, 0.0])
        for p in self.pairs:
            if p.mode != PRESSING:
                continue
            d, rate, slip, nx, ny = self.contact(p, q)
            N = K * d + p.c * rate
            F = -p.slide * MU * N if p.slide else -p.c * slip
            fx, fy = N * nx - F * ny, N * ny + F * nx
            for i, s in ((p.a, 1), (p.b, -1)):
                if i == WALL_ID:
                    continue
                f = self.floes[i]
                acc[i][0] += s * fx / f.m
                acc[i][1] += s * fy / f.m
                acc[i][2] -= F * f.R / f.inertia
            if p.b == WALL_ID:
                o = p.a * N_STATE
                out[o + J], out[o + JX], out[o + T_FORCE], out[o + PATH] = N, -N * nx, 1.0, p.sign * slip
                if not p.is_fresh:
                    out[o + DEPTH : o + WALL + 1] = self.wear_rates(p, d, N, slip)
        for i, (a, (x, y, vx, vy, spin, gap, nx, ny)) in enumerate(zip(acc, q)):
            o = i * N_STATE
            if self.is_polar:
                r, vr, vt = RS + self.floes[i].R + gap, z[o + 2], z[o + 3]
                ar, at = a[0] * nx + a[1] * ny, a[0] * ny - a[1] * nx
                out[o : o + 5] = vr, vt / r, ar + vt * vt / r, at - vr * vt / r, a[2]
            else:
                out[o : o + 5] = vx, vy, a[0], a[1], a[2]
        return out

    # --- events: what must stay positive in a mode, and what follows when it does not -----------------------------
    def guards(self, z):
        q = self.motions(z)
        out = []
        for p in self.pairs:
            d, rate, slip, *_ = self.contact(p, q)
            N = K * d + p.c * rate
            if p.mode == OPEN:
                out.append((-d, p, self.touch))
            elif p.mode == LOOSE:
                out += [(d, p, self.part), (-N, p, self.press)]
            else:
                out.append((N, p, self.let_go))
                if LIMIT and p.b == WALL_ID:
                    over = N - LIMIT[0] * 1e6 * (self.chord(p, d) * self.floes[p.a].h) ** (1 - LIMIT[1])
                    out.append((over if p.is_capped else -over, p, self.cross_limit))
                if p.slide:
                    out.append((p.slide * p.c * slip - MU * N, p, self.stick))
                else:
                    out += [(MU * N - p.c * slip, p, self.slip_forward), (MU * N + p.c * slip, p, self.slip_back),
                            (p.sign * slip, p, self.turn)]
        return out

    def slip_forward(self, p):
        p.slide = p.sign = 1

    def slip_back(self, p):
        p.slide = p.sign = -1

    def stick(self, p):
        p.slide = 0

    def turn(self, p):
        p.sign = -p.sign

    def cross_limit(self, p):
        p.is_capped = not p.is_capped

    def let_go(self, p):
        p.mode, p.slide = LOOSE, 0

    def part(self, p):
        p.mode = OPEN
        if p.b == WALL_ID:
            self.release[p.a], self.exit[p.a] = self.t, self.motion(self.z, p.a)

    def press(self, p):
        d, rate, slip, *_ = self.contact(p, self.motions(self.z))
        p.mode, p.sign, p.is_capped = PRESSING, 1 if slip >= 0 else -1, False
        p.slide = p.sign if p.c * abs(slip) > MU * max(0.0, K * d + p.c * rate) else 0

    def touch(self, p):
        self.press(p)
        if p.b != WALL_ID:
            return
        self.peak[p.a] = max(self.peak[p.a], self.normal(self.z, p))
        if self.first_touch[p.a] is None:
            self.first_touch[p.a] = self.t
            self.breaks.append((self.t + 2 / p.w, p.a))
        p.is_capped = LIMIT is not None  # no area yet
        if self.is_polar:
            self.z[p.a * N_STATE] = 0.0  # located to 1e-17 m; the first instants under a limit are shorter than that
        self.first_wear(p)

    # --- integration ---------------------------------------------------------------------------------------------
    def step(self, z, f0, h):
        """One DOP853 step: end state, derivative there, error in units of the tolerance (Hairer's mix of two estimates)."""
        k = np.empty((DOP853.n_stages + 1, z.size))
        k[0] = f0
        for s in range(1, DOP853.n_stages):
            k[s] = self.rhs(z + h * (DOP853.A[s, :s] @ k[:s]))
        z1 = z + h * (DOP853.B @ k[: DOP853.n_stages])
        k[-1] = self.rhs(z1)
        e5, e3 = np.abs(DOP853.E5 @ k) / self.size, np.abs(DOP853.E3 @ k) / self.size
        e5, e3 = e5.max(), e3.max()
        return z1, k[-1], h * e5 * e5 / math.hypot(e5, 0.1 * e3) / self.tol if e5 > 0 else 0.0

    def normal(self, z, p):
        d, rate, *_ = self.contact(p, self.motions(z))
        return K * d + p.c * rate

    def watch_peak(self, f0, h, za, zm, zb):
        """Largest normal force on the structure: at the ends of steps, and at a vertex inside one."""
        for p in self.pairs[: len(self.floes)]:
            if p.mode != PRESSING:
                continue
            a, m, b = (self.normal(z, p) for z in (za, zm, zb))
            best = max(a, m, b)
            curve, slope = a - 2 * m + b, b - a
            if curve < 0 and abs(slope) < 2 * abs(curve) and best > 0.9 * self.peak[p.a]:
                best = -minimize_scalar(lambda u: -self.normal(self.step(za, f0, u)[0], p), bounds=(0, h),
                                        method="bounded", options={"xatol": 1e-9 * h}).fun
            self.peak[p.a] = max(self.peak[p.a], best)

    def advance(self, t_end, is_trial=False):
        """To t_end, or to the first event, whose consequences are drawn (not in a trial). True: an event stopped it."""
        while self.t < t_end:
            f0 = self.rhs(self.z)
            h = min(self.h, t_end - self.t)
            z1, _, err = self.step(self.z, f0, h)
            grow = 0.9 * max(err, 1e-8) ** (-1 / 8)
            if err > 1:
                self.h = h * max(0.2, grow)
                continue
            half = self.step(self.z, f0, h / 2)[0]
            found = []
            for n, (now, at_half, at_end) in enumerate(zip(*map(self.guards, (self.z, half, z1)))):
                if at_half[0] >= 0 and at_end[0] >= 0:
                    continue
                value = lambda u, n=n: self.guards(self.step(self.z, f0, u)[0])[n][0]
                upper = h / 2 if at_half[0] < 0 else h
                # a guard of a mode that begins here is rounding noise about 0: look a little later
                lower = 0.0 if now[0] > 0 else 1e-3 * upper
                found.append((brentq(value, lower, upper, xtol=1e-17, rtol=1e-15) if value(lower) > 0 else 0.0, n))
            if found:
                h, n = min(found)
                _, pair, change = self.guards(self.z)[n]
                half, z1 = self.step(self.z, f0, h / 2)[0], self.step(self.z, f0, h)[0]
            self.watch_peak(f0, h, self.z, half, z1)
            is_last = not found and h == t_end - self.t
            self.t, self.z = t_end if is_last else self.t + h, z1
            if found:
                if not is_trial:
                    change(pair)
                    self.h = min(self.h, 1e-2 / max(p.w for p in self.pairs))
                return True
            self.h = max(self.h if is_last else 0.0, h * min(3.0, grow))
        return False

    def first_wear(self, p):
        """Wear of the first piece after a touch. There chord ~ t^(1/2) and sigma ~ t^(-1/2): with t = u^2 both integrands are
        u^(1-m) times a smooth function, so a Gauss-Jacobi rule with that weight is exact to rounding; the motion goes from node to
        node. Under a limit sigma ~ t^(-q/2). A piece must not contain an event: it is tried, and shortened until it has none."""
        keep = self.t, self.z, self.peak.copy()
        steep = EXPONENT * LIMIT[1] if LIMIT else EXPONENT
        x, weight = roots_jacobi(14, 0, 1 - steep)
        length = self.first_piece / max(q.w for q in self.pairs)
        p.is_fresh = True
        while True:
            self.t, self.z, self.peak = 0.0, keep[1], keep[2].copy()  # time since touch, whose nodes may be 1e-20 s apart
            self.h = 1e-2 * length
            total, is_cut = np.zeros(2), False
            for u, share in zip((1 + x) / 2, weight):
                is_cut = is_cut or self.advance(length * u * u, is_trial=True)
                d, rate, slip, *_ = self.contact(p, self.motions(self.z))
                wear = np.array(self.wear_rates(p, d, K * d + p.c * rate, slip))
                total += share * u**steep * wear
            if not (is_cut or self.advance(length, is_trial=True)):
                break
            length = 0.5 * self.t
        self.t += keep[0]
        p.is_fresh = False
        self.z = self.z.copy()
        self.z[p.a * N_STATE + DEPTH : p.a * N_STATE + WALL + 1] += total * length * 2 ** (steep - 1)

    def run(self, t_end):
        while self.t < t_end:
            stop, i = min([b for b in self.breaks if self.t < b[0] < t_end] + [(t_end, None)], key=lambda b: b[0])
            if not self.advance(stop) and i is not None:
                self.impact[i] = self.sums(i)
        return self

    def sums(self, i):
        return dict(zip(SUMS, self.z[i * N_STATE + 5 : (i + 1) * N_STATE].tolist()))


# --- the tables ------------------------------------------------------------------------------------------------------
FORMULATIONS = (("polar", 1e-13, 0.2), ("cartesian", 1e-13, 0.1), ("polar", 1e-12, 0.1))
SMALL, LARGE = (1.2, 0.3), (12.56, 1.3)
EXTREME_FLOES = [("small", *SMALL, y) for y in (0.4, 1.5, 3.0, 4.0, 4.5)]
EXTREME_FLOES += [("large", *LARGE, y) for y in (1.0, 4.0, 7.0, 9.0)]
EXTREME_SCENES = {
    "X01_squeezed": (8.0, [(*SMALL, -4.6, 0.6, U, 0.0, 0.0), (*LARGE, -12.0, 0.0, U, 0.0, 0.0)]),
    "X02_side_by_side": (8.0, [(*SMALL, -4.0, 2.2, U, 0.0, 0.0), (*LARGE, -10.8, 0.6, U, 0.0, 0.0)]),
}
LIMITED_EXPONENTS = (0.5, 1.121, 1.9, 2.5)
LIMITED_FLOES = [(*f, *limit) for f in (("1", 2.5, 0.5, 2.0), ("1", 2.5, 0.5, 4.0), ("small", *SMALL, 1.5), ("large", *LARGE, 4.0))
                 for limit in ((0.5, 0.0), (5.0, 0.0), (7.4, 0.7))]
START = ("D", "h", "x0", "y0", "vx0", "vy0", "spin0")


def solve_single(case, D, h, y0, formulation):
    """One row of a table of single floes; it starts 0.3 m off the structure."""
    row = {"case": case, "D": D, "h": h, "y0": y0, "outcome": "miss"}
    reach = RS + D / 2
    if abs(y0) >= reach:
        return row
    s = Scene([Floe(D, h, -math.sqrt(reach**2 - y0**2) - 0.3, y0)], *formulation)
    t_pinned = 60 + 0.3 / U  # no offset: nothing breaks the symmetry
    while s.release[0] is None and s.t < t_pinned:
        s.run(min(s.t + 0.5, t_pinned))
    sums = s.sums(0)
    row |= {"outcome": "leaves", "touch_deg": math.degrees(math.asin(y0 / reach)), "t_force": sums["t_force"],
            "N_peak": s.peak[0], "J_N": sums["J"], "J_x": sums["Jx"], "path_total": sums["path"],
            "depth_total_mm": sums["depth"], "W_mm_m": sums["W"], "depth_impact_mm": s.impact[0]["depth"],
            "path_impact": s.impact[0]["path"]}
    if s.release[0] is None:
        return row | {"outcome": "pinned_60s"}
    x, y, vx, vy, spin, _, nx, ny = s.exit[0]
    return row | {"t_release": s.release[0] - s.first_touch[0], "exit_deg": math.degrees(math.atan2(y, -x)),
                  "v_theta_exit": abs(vy * nx - vx * ny), "spin_exit": abs(spin)}


def solve_limited(case, D, h, y0, P0, q, formulation):
    """Loads [MPa^m m] and [MPa^m m2] of one floe under a crushing limit, a pair of columns for every exponent."""
    global EXPONENT, RATE, LIMIT
    keep = EXPONENT, RATE, LIMIT
    row = {"case": case, "D": D, "h": h, "y0": y0, "P0": P0, "q": q}
    for m in LIMITED_EXPONENTS:
        EXPONENT, RATE, LIMIT = m, 1e-5, (P0, q)
        single = solve_single(case, D, h, y0, formulation)
        row |= {f"along_{m:g}": single["depth_total_mm"] / RATE, f"wall_{m:g}": single["W_mm_m"] / RATE}
    EXPONENT, RATE, LIMIT = keep
    return row


def solve_scene(scene, t_end, starts, formulation):
    """The rows of a scene; what all its floes do to the structure stands on the first."""
    floes = [Floe(*start) for start in starts]
    s = Scene(floes, *formulation).run(t_end)
    rows = []
    for i, start in enumerate(starts):
        sums = s.sums(i)
        rows.append({"scene": scene, "t_end": t_end, "floe": i} | dict(zip(START, start))
                    | dict(zip(("x", "y", "vx", "vy", "spin"), s.motion(s.z, i)))
                    | {"J_N_floe": sums["J"], "t_force_floe": sums["t_force"], "path_floe": sums["path"],
                       "depth_floe_mm": sums["depth"], "W_floe_mm_m": sums["W"]})
    for total, part in (("J_N", "J_N_floe"), ("path", "path_floe"), ("depth_mm", "depth_floe_mm"), ("W_mm_m", "W_floe_mm_m")):
        rows[0][total] = sum(row[part] for row in rows)
    rows[0]["N_peak"] = max(s.peak)
    return rows


def solve_table(rows, formulation):
    """All rows of a table again, from what they say about the start."""
    if "P0" in rows[0]:
        return [solve_limited(r["case"], *(float(r[k]) for k in ("D", "h", "y0", "P0", "q")), formulation) for r in rows]
    if "outcome" in rows[0]:
        return [solve_single(r["case"], *(float(r[k]) for k in ("D", "h", "y0")), formulation) for r in rows]
    out = []
    for scene in dict.fromkeys(r["scene"] for r in rows):
        mine = [r for r in rows if r["scene"] == scene]
        starts = [tuple(float(r[k]) for k in START) for r in mine]
        out += solve_scene(scene, float(mine[0]["t_end"]), starts, formulation)
    return out


def worst_difference(rows, others):
    """Largest difference over all numbers: relative, for positions and velocities in m and m/s; where it is."""
    worst = 0.0, ""
    for row, other in zip(rows, others):
        for name, text in row.items():
            if name in ("scene", "case", "outcome"):
                assert text == other[name], (name, text, other[name])
                continue
            a, b = (float(v) if v not in (None, "") else 0.0 for v in (text, other.get(name)))
            scale = max(1.0, abs(b)) if name in ("x", "y", "vx", "vy", "spin") else abs(b) or 1.0
            worst = max(worst, (abs(a - b) / scale, f"{name} of {row.get('scene', row.get('case'))} {row.get('y0')}"))
    return worst


def read(path):
    with open(path, newline="") as f:
        return list(csv.DictReader(f))


def main(command):
    here = os.path.dirname(os.path.abspath(__file__))
    of = {name: os.path.join(here, name) for name in
          ("single_floe.csv", "multi_floe.csv", "extreme_floes.csv", "extreme_multi.csv", "limited_floes.csv")}
    if command == "write":
        floes = [solve_single(*f, FORMULATIONS[0]) for f in EXTREME_FLOES]
        scenes = [row for name, scene in EXTREME_SCENES.items() for row in solve_scene(name, *scene, FORMULATIONS[0])]
        limited = [solve_limited(*f, FORMULATIONS[0]) for f in LIMITED_FLOES]
        for like, name, rows in (("single_floe.csv", "extreme_floes.csv", floes),
                                 ("multi_floe.csv", "extreme_multi.csv", scenes), (None, "limited_floes.csv", limited)):
            with open(of[name], "w", newline="") as f:
                table = csv.DictWriter(f, like and read(of[like])[0].keys() or rows[0].keys(), lineterminator="\n")
                table.writeheader()
                table.writerows(rows)
    is_good = True
    for name, path in of.items():
        rows = read(path)
        for formulation in FORMULATIONS:
            if "P0" in rows[0] and formulation[0] != "polar":
                continue  # has not the digits: README.md
            difference, where = worst_difference(rows, solve_table(rows, formulation))
            is_good = is_good and difference <= 1e-9
            print(f"{name:18s} {formulation[0]:9s} tolerance {formulation[1]:g}: worst difference {difference:.1e} ({where})")
    return 0 if is_good else 1


if __name__ == "__main__":
    if sys.argv[1:] not in (["check"], ["write"]):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
