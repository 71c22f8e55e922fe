"""LIGGGHTS on the scene: Debian's `liggghts`, contact model hooke/stiffness. A fork of LAMMPS, so most input is the same."""
import lammps_peer
import scene


def disc(floe):
    """Mass per area: in 2D this program gives a particle the area of a disc, and the inertia of one."""
    return scene.ICE * floe.thickness


def table(n, value):
    """Values by pair of types, as LIGGGHTS reads them."""
    return f"peratomtypepair {n} " + " ".join(f"{value(min(i, j), max(i, j)):.17g}" for i in range(n) for j in range(n))


class Liggghts:
    program, name = "liggghts", "LIGGGHTS"

    @staticmethod
    def inputs(floes, dt, n_steps, with_dump, rotates):
        """Files of one run, by name."""
        n = len(floes) + 1
        damping = table(n, lambda i, j: lammps_peer.dashpot(floes, i, j))
        contact = f"""fix p1 all property/global kn {table(n, lambda i, j: scene.STIFFNESS)}
fix p2 all property/global kt {table(n, lambda i, j: 0)}
fix p3 all property/global gamman_abs {damping}
fix p4 all property/global gammat_abs {damping}
fix p5 all property/global coefficientFriction {table(n, lambda i, j: scene.FRICTION)}
pair_style gran model hooke/stiffness tangential no_history tangential_damping on absolute_damping on limitForce on
pair_coeff * *"""
        files = lammps_peer.common(floes, dt, n_steps, with_dump, rotates,
                                   {"style": "granular", "velocities": "communicate single vel yes", "turning": "nve/sphere",
                                    "contact": contact})
        return {**files, "data": lammps_peer.particles(floes, disc)}
