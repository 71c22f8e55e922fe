"""LIGGGHTS on the scene: Debian's `liggghts`, contact model hooke/stiffness with absolute damping."""
import lammps_peer
import scene

PROGRAM = "liggghts"


def disc(floe):
    """Density per area: in 2D this program gives a particle the area of a disc."""
    return scene.ICE * floe.thickness


def matrix(values):
    """A symmetric table by pair of types, as LIGGGHTS reads it."""
    return f"{len(values)} " + " ".join(f"{v:.17g}" for row in values for v in row)


def inputs(floes, dt, n_steps, with_dump):
    """Files of one run; particles as for LAMMPS, whose fork this is."""
    files = lammps_peer.inputs(floes, dt, n_steps, with_dump, disc)
    n = len(floes)
    masses = [f.mass for f in floes]

    def dashpot(i, j):
        if i == n or j == n:
            m = masses[min(i, j)] if i != j else 1.0
        else:
            m = masses[i] * masses[j] / (masses[i] + masses[j])
        return scene.damping(m)

    damping = matrix([[dashpot(i, j) for j in range(n + 1)] for i in range(n + 1)])

    def same(v):
        return matrix([[v] * (n + 1)] * (n + 1))

    text = files["in"]
    start, end = text.index("pair_style"), text.index("variable drag")
    contact = f"""fix p1 all property/global kn peratomtypepair {same(scene.STIFFNESS)}
fix p2 all property/global kt peratomtypepair {same(0.0)}
fix p3 all property/global gamman_abs peratomtypepair {damping}
fix p4 all property/global gammat_abs peratomtypepair {damping}
fix p5 all property/global coefficientFriction peratomtypepair {same(scene.FRICTION)}
pair_style gran model hooke/stiffness tangential no_history tangential_damping on absolute_damping on limitForce on
pair_coeff * *
"""
    text = text[:start] + contact + text[end:]
    text = text.replace("atom_style sphere", "atom_style granular").replace("comm_modify vel yes", "communicate single vel yes")
    text = text.replace("nve/sphere disc", "nve/sphere")
    files["in"] = text
    del files["pairs"]
    return files


def run(folder, floes, dt, duration, with_dump=False):
    return lammps_peer.run(folder, floes, dt, duration, with_dump, PROGRAM, inputs)
