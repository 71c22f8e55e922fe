/* The contact law: spring and dashpot without tension, viscous Coulomb friction.
 *
 *   N  = max(0, k d + c d'),  c = zeta 2 sqrt(k m_eff)
 *   Ft = -sign(vt) min(ct |vt|, mu N),  ct = slip_damping_ratio c
 *
 * d overlap [m], d' its rate (closing is positive), vt slip [m/s]. Source: the source paper (critical damping, mu 0.1);
 * the damped slip below the Coulomb cap and ct = c are this project's reading, with a key. */
#ifndef FW_PHYSICS_CONTACT_H
#define FW_PHYSICS_CONTACT_H

typedef struct fw_contact_law {
    double stiffness;          /* k [N/m] */
    double damping_ratio;      /* zeta */
    double friction;           /* mu */
    double slip_damping_ratio; /* ct / c */
} fw_contact_law;

typedef struct fw_contact_constants {
    double k, c, ct, mu;
    double omega; /* sqrt(k / m_eff) [rad/s] */
} fw_contact_constants;

/* m_eff: the floe's mass on the structure, mi mj / (mi + mj) between floes [kg]. */
fw_contact_constants fw_contact_law_apply(const fw_contact_law *law, double m_eff);

/* Forces at one instant. */
static inline double fw_contact_normal(const fw_contact_constants *c, double d, double rate)
{
    double n = c->k * d + c->c * rate;
    return n > 0 ? n : 0;
}
static inline double fw_contact_friction(const fw_contact_constants *c, double normal, double slip)
{
    double f = -c->ct * slip, cap = c->mu * normal;
    return f > cap ? cap : f < -cap ? -cap : f;
}

/* Closed form for zeta = 1, head-on, no other force, first touch at t = 0 with closing speed v:
 * d = v t exp(-wt), N = m w v exp(-wt) (2 - wt) while wt < 2, else 0 and the floe leaves with -v e^-2. */
double fw_contact_critical_depth(double omega, double v, double t);
double fw_contact_critical_force(double m, double omega, double v, double t);

#endif
