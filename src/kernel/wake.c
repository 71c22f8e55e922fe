#include "kernel/wake.h"

fw_status fw_wake(const fw_setup *s, fw_world *w, size_t block, size_t row, fw_msg *m)
{
    fw_block *b = &w->blocks[block];
    double    r = b->radius[row], h = b->thickness[row], mass = s->ice_density * 3.14159265358979323846 * r * r * h;
    fw_body   body = {.x = b->x[row] + w->drift,
                      .y = b->y[row],
                      .vx = s->speed,
                      .radius = r,
                      .thickness = h,
                      .inv_mass = 1 / mass,
                      .inv_inertia = s->has_rotation ? 2 / (mass * r * r) : 0,
                      .drag = s->drag_per_area * 2 * r * h,
                      .name = b->first_name + row};
    b->is_taken[row] = true;
    b->n_left--;
    return fw_world_add_body(w, &body, m);
}
