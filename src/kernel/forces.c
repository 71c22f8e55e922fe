#include "kernel/forces.h"

void fw_forces_start(fw_cluster *c, const fw_setup *set)
{
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member    *m = &c->members[i];
        const double *v = m->y0 + FW_VX;
        fw_water_at(set, m->y0[FW_X], m->y0[FW_Y], &m->ux, &m->uy);
        double speed = fw_relative_speed(m, v[0], v[1]), rate = m->drag_per_mass * speed;
        m->drag[0][0] = rate * (m->ux - v[0]), m->drag[0][1] = rate * (m->uy - v[1]), m->drag[0][2] = 0;
        if (fw_has_wind(set)) {
            double air = fw_wind_rate(set, m->air_per_mass, v[0], v[1]);
            m->drag[0][0] += air * (set->flow.wind_x - v[0]), m->drag[0][1] += air * (set->flow.wind_y - v[1]);
        }
        if (fw_has_spin_drag(set)) m->drag[0][2] = -fw_skin_drag_torque_rate(m->spin_per_inertia, m->radius, speed, v[2]) * v[2];
        for (int q = 0; q < 3; q++) m->k[0][FW_VX + q] = m->drag[0][q];
    }
}

void fw_forces_predict(fw_cluster *c, const fw_setup *set, double hg)
{
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        fw_water_at(set, m->X, m->Y, &m->ux, &m->uy);
        double speed = fw_relative_speed(m, m->U[0], m->U[1]);
        if (fw_has_wind(set)) m->air_rate = fw_wind_rate(set, m->air_per_mass, m->U[0], m->U[1]);
        fw_free_velocity(set, m, hg, speed, fw_has_wind(set));
        if (!fw_has_spin_drag(set)) continue;
        /* at the predicted state: it is slow, and of third order all the same */
        m->spin_slows = -fw_skin_drag_torque_rate(m->spin_per_inertia, m->radius, speed, m->U[2]) * m->U[2];
        m->V[2] += hg * m->spin_slows;
    }
}

void fw_forces_end(fw_cluster *c, const fw_setup *set, size_t s)
{
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        if (fw_has_wind(set))
            m->drag[s][0] += m->air_rate * (set->flow.wind_x - m->V[0]), m->drag[s][1] += m->air_rate * (set->flow.wind_y - m->V[1]);
        m->drag[s][2] = fw_has_spin_drag(set) ? m->spin_slows : 0;
    }
}

void fw_forces_weigh(fw_cluster *c, const fw_setup *set, double h)
{
    const fw_method *me = set->method;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     slows = 0, work = 0;
        for (size_t s = 0; s < me->n_stages; s++) {
            double gained = h * me->b[s] * m->drag[s][2];
            slows += gained, work += gained * m->k[s][2];
        }
        c->tried.drag_work += work * m->inertia;
        m->gained[2] = slows, m->twisted = fabs(slows);
    }
}
