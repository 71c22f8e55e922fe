"""The paper's 60 s scene: one set of floes that every program is given. Python 3 alone; a seed always gives the same floes."""
import math
import random

AREA_LENGTH, AREA_WIDTH = 120.0, 100.0  # [m] upstream of the structure: what the current brings past in 60 s
CONCENTRATION = 0.4
CLASSES = (0.5, 0.7, 0.9, 1.1, 1.3)  # [m] thickness, one fifth of the floes each
SPEED = 2.0  # [m/s] of the current, along +x
DURATION = 60.0  # [s]
STRUCTURE = 3.7  # [m] radius, fixed at the origin
ICE, WATER = 900.0, 1025.0  # [kg/m3]
FORM_DRAG = 10.0  # on the side area D h
STIFFNESS = 2.0e6  # [N/m]
FRICTION = 0.1
TEMPERATURE = 10.0  # [K] below freezing
CLEARANCE = 1e-6  # [m] between any two rims: no program starts with an overlap
TRIES = 100000


class Floe:
    def __init__(self, diameter, thickness):
        self.radius, self.thickness, self.x, self.y = diameter / 2, thickness, 0.0, 0.0
        self.mass = ICE * math.pi * self.radius**2 * thickness
        # F = drag |u - v| (u - v)
        self.drag = 0.5 * WATER * FORM_DRAG * diameter * thickness


def damping(mass):
    """Critical, of a contact with this effective mass; the tangential dashpot is the same."""
    return 2 * math.sqrt(STIFFNESS * mass)


def draw(rng):
    """Sizes first and places later: a size drawn anew when its place is refused would make the field finer."""
    floes, area = [], 0.0
    while area < CONCENTRATION * AREA_LENGTH * AREA_WIDTH:
        h = CLASSES[len(floes) % len(CLASSES)]
        low, high = 4 * h, math.sqrt(130 * h - 11)
        # Whole millimetres, like the places: the decimals in every program's input are then the same numbers.
        diameter = math.floor(1000 * (low + rng.random() * (high - low))) / 1000
        floes.append(Floe(diameter, h))
        area += math.pi * diameter**2 / 4
    return sorted(floes, key=lambda f: -f.radius)


def make(seed):
    """Floes of one field, largest placed first; none touches another or the structure."""
    rng = random.Random(seed)
    placed = []
    for floe in draw(rng):
        for _ in range(TRIES):
            floe.x = round(-AREA_LENGTH * rng.random(), 3)
            floe.y = round(AREA_WIDTH * (rng.random() - 0.5), 3)
            if math.hypot(floe.x, floe.y) < floe.radius + STRUCTURE + CLEARANCE:
                continue
            if all(math.hypot(floe.x - o.x, floe.y - o.y) > floe.radius + o.radius + CLEARANCE for o in placed):
                break
        else:
            raise RuntimeError(f"no place for a floe of {2 * floe.radius} m in field {seed}")
        placed.append(floe)
    return placed


def yaml(floes, duration):
    """The scene file of floewear; accuracy comes with --set."""
    lines = [
        f"structure: {{diameter: {2 * STRUCTURE:g} m}}",
        f"ice: {{density: {ICE:g} kg/m3, temperature: {-TEMPERATURE:g} degC}}",
        f"current: {{speed: {SPEED:g} m/s}}",
        f"contact: {{stiffness: {STIFFNESS / 1000:g} kN/m, damping_ratio: 1, friction: {FRICTION:g}, slip_damping_ratio: 1}}",
        f"water: {{density: {WATER:g} kg/m3, form_drag: {FORM_DRAG:g}}}",
        f"duration: {duration:g} s",
        "accuracy: 1 %",
        "floes:",
    ]
    lines += [f"  - {{x: {f.x:.3f} m, y: {f.y:.3f} m, diameter: {2 * f.radius:.3f} m, thickness: {f.thickness:g} m, "
              f"vx: {SPEED:g} m/s}}" for f in floes]
    return "\n".join(lines) + "\n"
