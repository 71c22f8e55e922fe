#include "realisation/facts.h"

#include <math.h>
#include <string.h>

#include "effects/floe_contact.h"
#include "field/sizes.h"

static const fw_range NOTHING = {INFINITY, -INFINITY};

static void reach(fw_range *r, double low, double high)
{
    r->low = fmin(r->low, low), r->high = fmax(r->high, high);
}

static void settle(fw_range *r)
{
    if (!(r->low <= r->high)) *r = (fw_range){0, 0};
}

static void begin(fw_scene_facts *f, const fw_model *m)
{
    memset(f, 0, sizeof *f);
    f->given = m->given;
    f->speed = f->concentration = f->thickness = f->diameter = f->aspect = NOTHING;
}

static void end(fw_scene_facts *f)
{
    settle(&f->speed), settle(&f->concentration), settle(&f->thickness), settle(&f->diameter), settle(&f->aspect);
}

static fw_status add_mix(fw_scene_facts *f, const fw_model *m, const fw_thickness_mix *mix, fw_msg *msg)
{
    fw_sizes s;
    FW_TRY(fw_sizes_init(&s, mix, m->size_law, m->size_a, m->size_b, msg));
    for (size_t i = 0; i < s.n; i++) {
        const fw_sizes_class *c = &s.classes[i];
        reach(&f->thickness, c->thickness, c->thickness);
        reach(&f->diameter, c->low, c->high);
        reach(&f->aspect, 2 * c->thickness / c->high, 2 * c->thickness / c->low);
    }
    f->encounters = fmax(f->encounters,
                         fw_floe_contact_encounters(f->concentration.high, m->structure_radius, s.mean_diameter, s.mean_area));
    return FW_OK;
}

fw_status fw_facts_campaign(const fw_model *m, const fw_site *site, fw_scene_facts *f, fw_msg *msg)
{
    begin(f, m);
    for (size_t i = 0; i < site->n_cells; i++) {
        const fw_site_cell *c = &site->cells[i];
        if (!(c->probability > 0)) continue;
        reach(&f->speed, c->speed, c->speed);
        reach(&f->concentration, c->concentration, c->concentration);
    }
    if (site->n_cells == 0) {
        reach(&f->speed, fw_distribution_min(&site->speed), fw_distribution_max(&site->speed));
        reach(&f->concentration, fw_distribution_min(&site->concentration), fw_distribution_max(&site->concentration));
    }
    if (f->given & FW_GIVEN_WIND_SPEED)
        f->wind_speed = (fw_range){fw_distribution_min(&site->wind_speed), fw_distribution_max(&site->wind_speed)};
    for (size_t i = 0; i < m->n_mixes; i++)
        if (m->mixes[i].probability > 0) FW_TRY(add_mix(f, m, &m->mixes[i], msg));
    end(f);
    return FW_OK;
}

void fw_facts_scene(const fw_scene *s, fw_scene_facts *f)
{
    begin(f, &s->model);
    f->n_floes = s->n_floes;
    reach(&f->speed, s->speed, s->speed);
    for (size_t i = 0; i < s->n_floes; i++) {
        const fw_floe *b = &s->floes[i];
        reach(&f->thickness, b->thickness, b->thickness);
        reach(&f->diameter, b->diameter, b->diameter);
        reach(&f->aspect, 2 * b->thickness / b->diameter, 2 * b->thickness / b->diameter);
    }
    f->wind_speed = (fw_range){s->wind_speed, s->wind_speed};
    end(f);
}
