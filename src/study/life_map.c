/* Life depth over bearing and height. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "study/service_run.h"

/* The heights are those of all windows that wore anything, the same for every point. thickness, part (n): scratch. */
static fw_status add(fw_service_answer *out, const fw_campaign *c, const fw_window *w, const fw_life_row *life, double *thickness, double *part, fw_msg *m)
{
    const fw_depth *d = w->depth;
    double          afloat = c->model.ice_density / c->model.water_density, height[FW_MAP_HEIGHTS], share[FW_MAP_HEIGHTS];
    fw_water_level  all;
    for (size_t i = 0; i < d->n; i++) thickness[i] = part[i] = d->row[i].thickness; /* weights of the heights do not matter */
    FW_TRY(fw_water_level_make(&all, &c->after.water_level, afloat, d->n, thickness, part, m));
    if (all.n == 0) return FW_OK;
    for (size_t k = 0; k < FW_MAP_HEIGHTS; k++)
        height[k] = all.height[0] + (all.height[all.n - 1] - all.height[0]) * (double)k / (FW_MAP_HEIGHTS - 1);
    for (size_t i = 0; i < d->n; i++) part[i] = fmax(0, d->units.weight[i]) * w->means[i];
    FW_TRY(fw_water_level_shares(&c->after.water_level, afloat, d->n, thickness, part, FW_MAP_HEIGHTS, height, share, m));
    for (size_t k = 0; k < FW_MAP_HEIGHTS; k++)
        out->map[out->n_map++] = (fw_map_row){life->point, life->bearing_deg, height[k], life->percentile, life->depth_mm * share[k]};
    return FW_OK;
}

fw_status fw_life_map_add(fw_service_answer *out, const fw_campaign *c, const fw_window *w, const fw_life_row *life, fw_msg *m)
{
    double *scratch = NULL;
    if (!c->after.has_water_level) return FW_OK;
    FW_TRY(fw_alloc(&scratch, 2 * w->depth->n, sizeof *scratch, "thicknesses of records", m));
    fw_status s = add(out, c, w, life, scratch, scratch + w->depth->n, m);
    free(scratch);
    return s;
}
