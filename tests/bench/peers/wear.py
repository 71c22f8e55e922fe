"""Wear of the structure out of a DEM program's per-step states, as its user would sum it up afterwards."""
import numpy as np

import scene

EXPONENT = 1.121
RATE = 0.116 * scene.TEMPERATURE**-EXPONENT * 1e-6**EXPONENT / 1000  # mm per metre of slip at 1 Pa


class Sums:
    """Depth along the contacts [mm] by both sums, and normal impulse [N s]."""

    def __init__(self, naive, graded, impulse):
        self.naive, self.graded, self.impulse = naive, graded, impulse


def rates(floes, ids, state):
    """Overlap, its rate, normal force and wear rate [mm/s] at each row; state: x, y, vx, vy, spin; ids count from 1."""
    radius = np.array([f.radius for f in floes])[ids - 1]
    height = np.array([f.thickness for f in floes])[ids - 1]
    c = np.array([scene.damping(f.mass) for f in floes])[ids - 1]
    x, y, vx, vy, spin = state.T
    distance = np.hypot(x, y)
    nx, ny = x / distance, y / distance
    overlap, closing = radius + scene.STRUCTURE - distance, -(vx * nx + vy * ny)
    force = np.maximum(0.0, scene.STIFFNESS * overlap + c * closing)
    slip = np.abs(-vx * ny + vy * nx - spin * radius)
    # Chord of the two circles: half of it stands over the line of centres at this distance from the structure's centre.
    foot = (distance**2 + scene.STRUCTURE**2 - radius**2) / (2 * distance)
    chord = 2 * np.sqrt(np.maximum(scene.STRUCTURE**2 - foot**2, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        wear = np.where(chord > 0, RATE * (force / (chord * height))**EXPONENT * slip, 0.0)
    return overlap, closing, force, wear


def sums(floes, steps, ids, state, dt):
    """Rows are the floes that overlap the structure, step by step, at the ends of the steps."""
    order = np.lexsort((steps, ids))
    steps, ids, state = steps[order], ids[order], state[order]
    overlap, closing, force, wear = rates(floes, ids, state)
    if len(ids) == 0:
        return Sums(0.0, 0.0, 0.0)
    first = np.r_[True, (np.diff(ids) != 0) | (np.diff(steps) != 1)]
    last = np.r_[first[1:], True]
    # Time since the touch, which lies inside the step that ended with the first overlap.
    start = np.clip(overlap[first] / np.maximum(closing[first], 1e-9), 1e-6 * dt, dt)
    run = np.cumsum(first) - 1
    age = (steps - steps[first][run]) * dt + start[run]
    # The rate falls like age^-m/2 after the touch: between samples what is left of it is taken as linear in age^(1 - m/2).
    power = 1 - EXPONENT / 2
    grade = age**power / power
    before, after = np.r_[0.0, grade[:-1]], np.r_[grade[1:], 0.0]
    before[first] = -grade[first]  # before the first sample its own value holds, from the touch on
    after[last] = grade[last]
    weight = (after - before) / 2 * age**(EXPONENT / 2)
    # Trapezoids, and the whole of the part before the first sample, where the force starts with its jump.
    share = np.where(first, start[run] + dt / 2, dt) - np.where(last, dt / 2, 0.0)
    return Sums(float(np.sum(wear) * dt), float(np.sum(weight * wear)), float(np.sum(share * force)))
