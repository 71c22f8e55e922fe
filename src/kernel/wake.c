#include "kernel/wake.h"

double fw_kernel_floe_mass(const fw_setup *s, double radius, double thickness)
{
    return s->ice_density * 3.14159265358979323846 * radius * radius * thickness;
}

fw_body fw_kernel_floe(const fw_setup *s, double radius, double thickness)
{
    double mass = fw_kernel_floe_mass(s, radius, thickness);
    return (fw_body){.radius = radius,
                     .thickness = thickness,
                     .inv_mass = 1 / mass,
                     .inv_inertia = s->has_rotation ? 2 / (mass * radius * radius) : 0,
                     .drag = s->drag_per_area * 2 * radius * thickness};
}

fw_status fw_wake(const fw_setup *s, fw_world *w, size_t block, size_t row, fw_msg *m)
{
    fw_block *b = &w->blocks[block];
    fw_body   body = fw_kernel_floe(s, b->radius[row], b->thickness[row]);
    body.x = b->x[row] + w->drift, body.y = b->y[row], body.vx = s->speed;
    body.name = b->first_name + row;
    b->is_taken[row] = true;
    b->n_left--;
    return fw_world_add_body(w, &body, m);
}
