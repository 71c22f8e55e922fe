"""floewear beside LAMMPS and LIGGGHTS on the paper's 60 s scene: error of the depth and CPU time, as Markdown.

usage: bench_peers.py [--quick] FLOEWEAR

FLOEWEAR is the program. --quick: seconds long; checks that all programs find the same impulse and depth, never how fast.
Exit code 77: numpy or both peers are missing.
"""
import concurrent.futures
import json
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

import scene

MISSING = 77
try:
    import lammps_peer
    from liggghts_peer import Liggghts
except ModuleNotFoundError as error:
    print(f"no {error.name} for this Python", file=sys.stderr)
    sys.exit(MISSING)

PEERS = [p for p in (lammps_peer.Lammps, Liggghts) if shutil.which(p.program)]
FIELDS = (1, 2, 3, 4, 5, 6)
LOCKED_FIELDS = FIELDS[:3]
STEPS = (8e-3, 3e-3, 1e-3, 3e-4, 1e-4)  # [s]; the last one is each program's own limit
FINEST = STEPS[-1]
LOCKED_STEP = 3e-4  # [s]
ENOUGH = 0.015  # depth error for the ratio in a sentence
ACCURACIES = (0.1, 0.01, 0.001)
REFERENCE = 0.0001
ROUNDS = 3  # of timing, each on another field
REPEATS = 3  # of floewear, whose runs are short, beside every run of a peer
LOCKED = ("--set", "effects={rotation: off}")
NAIVE, GRADED, IMPULSE = "naive", "graded", "impulse"


def floewear(program, file, accuracy, *options):
    """(depth mm, normal impulse N s, CPU s of the simulation, CPU s of the process)"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "scene", file, "--json", "--set", f"accuracy={100 * accuracy:g} %", *options],
                          capture_output=True, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = json.loads(done.stdout)
    return (out["structure"]["depth_along_contact_mm"], out["structure"]["normal_impulse_N_s"], out["cost"]["cpu_s"],
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def states(task):
    """One run with a dump, for the errors; not for its time, which the dump rules and others share."""
    peer, field, dt, duration, rotates = task
    with tempfile.TemporaryDirectory() as folder:
        sums = lammps_peer.run(peer, pathlib.Path(folder), scene.make(field), dt, duration, True, rotates)[1]
    return {NAIVE: sums.naive, GRADED: sums.graded, IMPULSE: sums.impulse}


def all_states(tasks):
    # Longest first: the last ones to end are then short.
    tasks = sorted(tasks, key=lambda t: t[2])
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(tasks, pool.map(states, tasks)))


def rms(values):
    return statistics.fmean(v * v for v in values) ** 0.5


def spread(errors):
    """Mean and r.m.s. over the fields."""
    return f"{100 * statistics.fmean(errors):+.2g}, {100 * rms(errors):.2g} %"


def version(peer):
    with tempfile.TemporaryDirectory() as folder:  # even this leaves a log behind
        lines = subprocess.run([peer.program, "-h"], cwd=folder, capture_output=True, text=True, check=False).stdout.splitlines()
    line = next((text for text in lines if text.strip()), "").strip()
    return line.split("Parallel Simulator - ")[-1].split(", compiled")[0].split("LIGGGHTS-PUBLIC ")[-1]


class Results:
    """Errors of every program at every step or accuracy, and the times of the rounds."""

    def __init__(self, program, folder):
        self.program, self.folder, self.files = program, folder, {}
        for field in FIELDS:
            self.files[field] = str(folder / f"field-{field}.yaml")
            pathlib.Path(self.files[field]).write_text(scene.yaml(scene.make(field), scene.DURATION))
        self.own = {a: [floewear(program, self.files[f], a) for f in FIELDS] for a in (*ACCURACIES, REFERENCE)}
        self.locked = [floewear(program, self.files[f], REFERENCE, *LOCKED) for f in LOCKED_FIELDS]
        self.states = all_states([(p, f, dt, scene.DURATION, True) for p in PEERS for f in FIELDS for dt in STEPS] +
                                 [(p, f, LOCKED_STEP, scene.DURATION, False) for p in PEERS for f in LOCKED_FIELDS])
        self.own_times = {a: [] for a in ACCURACIES}  # per round: median of (simulation, process)
        self.times = {}  # (peer, step): per round (time steps, process)
        self.without_drag = {p: [] for p in PEERS}
        for field in FIELDS[:ROUNDS]:
            self.measure(field)

    def measure(self, field):
        """One round: all programs in turn, so that whoever else uses the machine slows all of them."""
        floes, mine = scene.make(field), {a: [] for a in ACCURACIES}

        def cpu(peer, dt, duration):
            return lammps_peer.run(peer, self.folder, floes, dt, duration)[0]

        # Their own clocks show wall time, which others lengthen: a run of no steps tells what of the CPU time is set-up.
        set_up = {p: statistics.median(cpu(p, 1e-3, 0) for _ in range(REPEATS)) for p in PEERS}
        for dt in STEPS:
            for peer in PEERS:
                process = cpu(peer, dt, scene.DURATION)
                self.times.setdefault((peer, dt), []).append((process - set_up[peer], process))
                for a in ACCURACIES:
                    mine[a] += [floewear(self.program, self.files[field], a)[2:] for _ in range(REPEATS)]
        for peer in PEERS:
            self.without_drag[peer].append(cpu(dragless(peer), 1e-3, scene.DURATION) - set_up[peer])
        for a in ACCURACIES:
            self.own_times[a].append(tuple(statistics.median(v) for v in zip(*mine[a])))

    def depth_errors(self, accuracy):
        return [x[0] / r[0] - 1 for x, r in zip(self.own[accuracy], self.own[REFERENCE])]

    def impulse_errors(self, accuracy):
        return [x[1] / r[1] - 1 for x, r in zip(self.own[accuracy], self.own[REFERENCE])]

    def peer_errors(self, peer, dt, what, against=None):
        """Against the peer's own limit; or against floewear's reference when its column is given."""
        values = [self.states[peer, f, dt, scene.DURATION, True][what] for f in FIELDS]
        limit = ([self.states[peer, f, FINEST, scene.DURATION, True][GRADED] for f in FIELDS] if against is None
                 else [r[against] for r in self.own[REFERENCE]])
        return [v / w - 1 for v, w in zip(values, limit)]

    def locked_errors(self, peer, what, column):
        return [self.states[peer, f, LOCKED_STEP, scene.DURATION, False][what] / r[column] - 1 for f, r in zip(LOCKED_FIELDS, self.locked)]

    def ratio(self, peer, dt, accuracy, column):
        return statistics.median(t[column] / m[column] for t, m in zip(self.times[peer, dt], self.own_times[accuracy]))

    def decoupling(self):
        """Largest change of a field's impulse between any step of a peer and its smallest."""
        of = self.states
        return max(abs(of[p, f, dt, scene.DURATION, True][IMPULSE] / of[p, f, FINEST, scene.DURATION, True][IMPULSE] - 1)
                   for p in PEERS for f in FIELDS for dt in STEPS)

    def cheapest(self, error):
        """Of floewear's accuracies the cheapest that is at least as near."""
        return next((a for a in ACCURACIES if rms(self.depth_errors(a)) <= error), None)


def dragless(peer):
    class Dragless(peer):
        @staticmethod
        def inputs(*arguments):
            files = peer.inputs(*arguments)
            return {**files, "in": files["in"].replace("fix drag ", "#")}
    return Dragless


def cost_table(r):
    print("### Error and cost\n")
    print(f"Errors over {len(FIELDS)} fields: mean, r.m.s. CPU: median of {ROUNDS} rounds, programs in turn, one core; of the time "
          "steps (floewear: its simulation) and of the whole process. Depth error: floewear against its accuracy 0.01 %; the others "
          "against their own limit, the graded sum at their smallest step, because their contact differs a little (below). Sum at "
          "step ends: rate at a step's end times the step, what a DEM user does with a dump. Graded sum: the touch located inside "
          "its step, and the singular rate after it integrated as such, which a user would have to write; neither sum is in the times. "
          f"Runs stay coupled: no field's impulse changes by more than {100 * r.decoupling():.1g} % with a peer's step, so these "
          "are errors, not the scatter of another course of events.\n")
    print("| program | step or accuracy | CPU s: time steps | process | depth error, sum at step ends | graded sum | "
          "step ends against floewear 0.01 % | normal impulse against it |")
    print("|---|---|---|---|---|---|---|---|")
    for peer in PEERS:
        for dt in STEPS:
            steps, process = (statistics.median(v) for v in zip(*r.times[peer, dt]))
            graded = "taken as the limit" if dt == FINEST else spread(r.peer_errors(peer, dt, GRADED))
            print(f"| {peer.name} | {1000 * dt:g} ms | {steps:.3g} | {process:.3g} | {spread(r.peer_errors(peer, dt, NAIVE))} | {graded} | "
                  f"{spread(r.peer_errors(peer, dt, NAIVE, 0))} | {spread(r.peer_errors(peer, dt, IMPULSE, 1))} |")
    for a in ACCURACIES:
        steps, process = (statistics.median(v) for v in zip(*r.own_times[a]))
        print(f"| floewear | {100 * a:g} % | {steps:.3g} | {process:.3g} | its own sum: {spread(r.depth_errors(a))} | | | "
              f"{spread(r.impulse_errors(a))} |")
    print()


def needed(r, peer):
    """The coarsest step that is near enough, by either sum, and what it costs."""
    for what, name in ((NAIVE, "at step ends"), (GRADED, "graded")):
        dt = next((dt for dt in STEPS if rms(r.peer_errors(peer, dt, what)) <= ENOUGH), None)
        a = r.cheapest(ENOUGH)
        if dt is None or a is None:
            yield f"a step below {1000 * FINEST:g} ms with the sum {name}"
        else:
            yield f"{1000 * dt:g} ms with the sum {name} ({r.ratio(peer, dt, a, 0):.3g} times floewear's CPU s at {100 * a:g} %)"


def ratio_table(r):
    print("### Ratio at the depth accuracy of each\n")
    print("CPU s of the peer's time steps over CPU s of floewear's simulation, at floewear's cheapest accuracy whose r.m.s. depth "
          "error is no larger than the peer's (often far smaller: 10 % is its coarsest); median of the rounds. "
          "Last column: of the whole processes, in which floewear's start and its reading of the scene are most of it.\n")
    print("| program | step | sum | its depth error, r.m.s. | floewear at | its depth error, r.m.s. | CPU ratio | of processes |")
    print("|---|---|---|---|---|---|---|---|")
    for peer in PEERS:
        for what, name in ((NAIVE, "at step ends"), (GRADED, "graded")):
            for dt in STEPS:
                error = rms(r.peer_errors(peer, dt, what))
                a = r.cheapest(error)
                if what == GRADED and dt == FINEST or a is None:
                    continue
                print(f"| {peer.name} | {1000 * dt:g} ms | {name} | {100 * error:.2g} % | {100 * a:g} % | "
                      f"{100 * rms(r.depth_errors(a)):.2g} % | {r.ratio(peer, dt, a, 0):.3g} | {r.ratio(peer, dt, a, 1):.3g} |")
    print()
    for peer in PEERS:
        print(f"For a depth within {100 * ENOUGH:g} % r.m.s. {peer.name} needs " + " and ".join(needed(r, peer)) + ".")
        share = statistics.median(1 - w / t[0] for w, t in zip(r.without_drag[peer], r.times[peer, 1e-3]))
        print(f"{peer.name} spends {100 * share:.0f} % of its time on the drag, a formula of its input file evaluated at every step "
              f"(the package has no quadratic drag); with a drag in compiled code that cost nothing, ratios would be {1 / (1 - share):.1f} "
              "times smaller.\n")


def check_table(r):
    print("### Do they agree\n")
    print("All have rigid discs with a disc's inertia, spring and dashpot per pair, no tension, viscous Coulomb friction and the drag. "
          "One thing differs: the peers put the contact into the middle of the overlap, so that friction turns a floe with the arm R - d/2 "
          "(LIGGGHTS also takes the slip there), in floewear with R. With rotation locked nothing differs: "
          "that row is a check of floewear by other people's code.\n")
    print("| limit of | rotation | normal impulse against floewear 0.01 % | depth, graded sum |")
    print("|---|---|---|---|")
    for peer in PEERS:
        print(f"| {peer.name} at {1000 * LOCKED_STEP:g} ms | locked | {spread(r.locked_errors(peer, IMPULSE, 1))} | "
              f"{spread(r.locked_errors(peer, GRADED, 0))} |")
        print(f"| {peer.name} at {1000 * FINEST:g} ms | free | {spread(r.peer_errors(peer, FINEST, IMPULSE, 1))} | "
              f"{spread(r.peer_errors(peer, FINEST, GRADED, 0))} |")
    print()


def full(program):
    with tempfile.TemporaryDirectory() as folder:
        r = Results(program, pathlib.Path(folder))
    limits = [r.states[PEERS[0], f, FINEST, scene.DURATION, True] for f in FIELDS]
    print("### Scene\n")
    print(f"The paper's example: {scene.AREA_LENGTH:g} m x {scene.AREA_WIDTH:g} m, 40 %, {scene.SPEED:g} m/s, structure of "
          f"{2 * scene.STRUCTURE:g} m, {scene.DURATION:g} s, nothing flows in; {len(FIELDS)} fields of "
          f"{min(len(scene.make(f)) for f in FIELDS)}-{max(len(scene.make(f)) for f in FIELDS)} floes, the same floes in all programs; "
          f"normal impulse {min(h[IMPULSE] for h in limits) / 1e6:.1f}-{max(h[IMPULSE] for h in limits) / 1e6:.1f} MN s.")
    print("Programs: " + "; ".join(f"{p.name} {version(p)}, Debian's `{p.program if p.program != 'lmp' else 'lammps'}`" for p in PEERS) +
          "; one process each. To measure again: `apt-get install lammps liggghts python3-numpy`, then `tests/bench/run peers`.\n")
    cost_table(r)
    ratio_table(r)
    check_table(r)
    bad = [f"{p.name}: {what} differs by {100 * max(map(abs, errors)):.2g} %" for p in PEERS for what, errors, limit in
           (("impulse, rotation locked,", r.locked_errors(p, IMPULSE, 1), 1e-3),
            ("depth, rotation locked,", r.locked_errors(p, GRADED, 0), 1e-3),
            ("impulse", r.peer_errors(p, FINEST, IMPULSE, 1), 2e-2)) if max(map(abs, errors)) > limit]
    return bad


def quick(program):
    """The first 20 s of one field at 1 ms."""
    bad = []
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scene.yaml"
        file.write_text(scene.yaml(scene.make(1), 20.0))
        for rotates, limit in ((False, 2e-3), (True, 2e-2)):
            want = floewear(program, str(file), 0.001, *(() if rotates else LOCKED))
            for peer in PEERS:
                got = states((peer, 1, 1e-3, 20.0, rotates))
                for name, x, y in (("impulse", got[IMPULSE], want[1]), ("depth", got[GRADED], want[0])):
                    print(f"{peer.name}, rotation {'free' if rotates else 'locked'}: {name} {x:.6g}, floewear {y:.6g}")
                    if not abs(x / y - 1) <= limit:
                        bad.append(f"{peer.name}: {name} {x} against {y}")
    return bad


def main():
    arguments = [a for a in sys.argv[1:] if a != "--quick"]
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    if not PEERS:
        print("neither LAMMPS nor LIGGGHTS is installed: apt-get install lammps liggghts", file=sys.stderr)
        return MISSING
    bad = (quick if "--quick" in sys.argv else full)(arguments[0])
    for line in bad:
        print(line, file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
