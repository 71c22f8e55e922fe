"""LAMMPS on the scene: package GRANULAR of Debian's `lammps`."""
import re
import resource
import subprocess

import dump
import scene
import wear

PROGRAM = "lmp"
COLUMNS = "id x y vx vy omegaz"


def sphere(floe):
    """Density that makes the mass a disc's: the program gives every particle the volume of a sphere, in 2D too."""
    return scene.ICE * 0.75 * floe.thickness / floe.radius


def inputs(floes, dt, n_steps, with_dump, density=sphere, skin=1.0):
    """Files of one run. A type per floe, so that every pair has its own dashpot; the last type is the structure."""
    n = len(floes)
    masses = [f.mass for f in floes]
    data = ["floes", "", f"{n + 1} atoms", f"{n + 1} atom types", "-200 200 xlo xhi", "-100 100 ylo yhi", "-0.5 0.5 zlo zhi",
            "", "Atoms # sphere", ""]
    for i, f in enumerate(floes, 1):
        data.append(f"{i} {i} {2 * f.radius:.3f} {density(f):.17g} {f.x:.3f} {f.y:.3f} 0")
    data.append(f"{n + 1} {n + 1} {2 * scene.STRUCTURE} 1000 0 0 0")
    data += ["", "Velocities", ""] + [f"{i} {scene.SPEED if i <= n else 0} 0 0 0 0 0" for i in range(1, n + 2)]
    pairs = []
    for i in range(n + 1):
        for j in range(i, n + 1):
            m = masses[i] if j == n and i < n else masses[i] * masses[j] / (masses[i] + masses[j]) if i < n else 1.0
            pairs.append(f"pair_coeff {i + 1} {j + 1} hooke {scene.STIFFNESS} {scene.damping(m):.17g} "
                         f"tangential linear_nohistory 1.0 {scene.FRICTION} damping velocity limit_damping")
    text = f"""units si
dimension 2
boundary f f p
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
read_data data
neighbor {skin} bin
group floes id <= {n}
pair_style granular
include pairs
variable drag atomfile drag
variable s atom v_drag*sqrt(({scene.SPEED}-vx)*({scene.SPEED}-vx)+vy*vy)
variable fx atom v_s*({scene.SPEED}-vx)
variable fy atom -v_s*vy
fix drag floes addforce v_fx v_fy 0
fix move floes nve/sphere disc
fix flat all enforce2d
thermo {n_steps}
thermo_style custom step
timestep {dt}
"""
    if with_dump:
        text += f"""variable reach atomfile reach
variable gap atom sqrt(x*x+y*y)-v_reach
dump states floes custom 1 states.bin {COLUMNS}
dump_modify states thresh v_gap < 0
"""
    numbers = {"drag": [f.drag for f in floes] + [0.0], "reach": [f.radius + scene.STRUCTURE for f in floes] + [0.0]}
    files = {name: "\n".join([str(n + 1)] + [f"{i} {v:.17g}" for i, v in enumerate(values, 1)]) + "\n"
             for name, values in numbers.items()}
    files.update({"data": "\n".join(data) + "\n", "pairs": "\n".join(pairs) + "\n", "in": text + f"run {n_steps}\n"})
    return files


def call(folder, files, program):
    """Loop CPU seconds as the program's log tells, and CPU seconds of the whole process."""
    for name, text in files.items():
        (folder / name).write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "-in", "in", "-log", "log", "-screen", "none"], cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    log = (folder / "log").read_text()
    loop = re.search(r"Loop time of (\S+) on 1 procs", log)
    if done.returncode or not loop:
        raise RuntimeError(f"{program} failed:\n{done.stderr}{log[-2000:]}")
    share = re.search(r"([\d.]+)% CPU use", log)
    process = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return float(loop[1]) * (float(share[1]) / 100 if share else 1), process


def run(folder, floes, dt, duration, with_dump=False, program=PROGRAM, make=inputs):
    """(loop CPU s, process CPU s, sums or None)"""
    loop, process = call(folder, make(floes, dt, round(duration / dt), with_dump), program)
    if not with_dump:
        return loop, process, None
    steps, rows = dump.read(folder / "states.bin", len(COLUMNS.split()))
    (folder / "states.bin").unlink()
    return loop, process, wear.sums(floes, steps, rows[:, 0].astype(int), rows[:, 1:], dt)
