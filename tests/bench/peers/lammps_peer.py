"""LAMMPS on the scene: package GRANULAR of Debian's `lammps`."""
import resource
import subprocess

import dump
import scene
import wear

COLUMNS = "id x y vx vy omegaz"


def sphere(floe):
    """Density that makes the mass a disc's: the program gives every particle the volume of a sphere, in 2D too."""
    return scene.ICE * 0.75 * floe.thickness / floe.radius


def particles(floes, density):
    """The data file: a type per floe, so that every pair can have its own dashpot; the last type is the structure."""
    n = len(floes)
    lines = ["floes", "", f"{n + 1} atoms", f"{n + 1} atom types", "-200 200 xlo xhi", "-100 100 ylo yhi", "-0.5 0.5 zlo zhi",
             "", "Atoms", ""]
    for i, f in enumerate(floes, 1):
        lines.append(f"{i} {i} {2 * f.radius:.3f} {density(f):.17g} {f.x:.3f} {f.y:.3f} 0")
    lines.append(f"{n + 1} {n + 1} {2 * scene.STRUCTURE} 1000 0 0 0")
    lines += ["", "Velocities", ""] + [f"{i} {scene.SPEED if i <= n else 0} 0 0 0 0 0" for i in range(1, n + 2)]
    return "\n".join(lines) + "\n"


def dashpot(floes, i, j):
    """Of types i <= j, counted from 0."""
    n = len(floes)
    if i == n:
        return 1.0  # the structure with itself: asked for, never used
    m = floes[i].mass
    return scene.damping(m if j == n else m * floes[j].mass / (m + floes[j].mass))


def per_floe(values):
    """A file of an atomfile-style variable."""
    return "\n".join([str(len(values))] + [f"{i} {v:.17g}" for i, v in enumerate(values, 1)]) + "\n"


def common(floes, dt, n_steps, with_dump, rotates, words):
    """The input script; words: what the two programs call differently. No skin from 0.3 to 4 m is faster."""
    u = scene.SPEED
    text = f"""units si
dimension 2
boundary f f p
atom_style {words['style']}
atom_modify map array
newton off
{words['velocities']}
read_data data
neighbor 1.0 bin
group floes id <= {len(floes)}
{words['contact']}
variable drag atomfile drag
variable s atom v_drag*sqrt(({u}-vx)*({u}-vx)+vy*vy)
variable fx atom v_s*({u}-vx)
variable fy atom -v_s*vy
fix drag floes addforce v_fx v_fy 0
fix move floes {words['turning'] if rotates else 'nve'}
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
    return {"in": text + f"run {n_steps}\n", "drag": per_floe([f.drag for f in floes] + [0.0]),
            "reach": per_floe([f.radius + scene.STRUCTURE for f in floes] + [0.0])}


class Lammps:
    program, name = "lmp", "LAMMPS"

    @staticmethod
    def inputs(floes, dt, n_steps, with_dump, rotates):
        """Files of one run, by name."""
        n = len(floes)
        pairs = [f"pair_coeff {i + 1} {j + 1} hooke {scene.STIFFNESS} {dashpot(floes, i, j):.17g} tangential linear_nohistory 1.0 "
                 f"{scene.FRICTION} damping velocity limit_damping" for i in range(n + 1) for j in range(i, n + 1)]
        files = common(floes, dt, n_steps, with_dump, rotates,
                       {"style": "sphere", "velocities": "comm_modify vel yes", "turning": "nve/sphere disc",
                        "contact": "pair_style granular\ninclude pairs"})
        return {**files, "data": particles(floes, sphere), "pairs": "\n".join(pairs) + "\n"}


def run(peer, folder, floes, dt, duration, with_dump=False, rotates=True):
    """(CPU s of the process, wear.Sums of a dump or None)"""
    for name, text in peer.inputs(floes, dt, round(duration / dt), with_dump, rotates).items():
        (folder / name).write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([peer.program, "-in", "in", "-log", "log", "-screen", "none"], cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    log = (folder / "log").read_text() if (folder / "log").exists() else ""
    if done.returncode or "Loop time of" not in log:
        raise RuntimeError(f"{peer.name} failed:\n{done.stdout[-500:]}{done.stderr[-500:]}{log[-1000:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if not with_dump:
        return cpu, None
    steps, rows = dump.read(folder / "states.bin", len(COLUMNS.split()))
    (folder / "states.bin").unlink()
    return cpu, wear.sums(floes, steps, rows[:, 0].astype(int), rows[:, 1:], dt)
