#include "cli/settings.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/memory.h"
#include "effects/effects.h"

/* Longer lists are given by count and hash: the text is compared line by line and stored with every journal. */
enum { MAX_SHOWN = 32 };

typedef struct text {
    char     *bytes;
    size_t    n, capacity;
    fw_status status;
    fw_msg   *m;
} text;

static void put(text *t, const char *fmt, ...) __attribute__((format(printf, 2, 3)));

static void put(text *t, const char *fmt, ...)
{
    char    piece[512];
    va_list ap;

    if (t->status != FW_OK) return;
    va_start(ap, fmt);
    int n = vsnprintf(piece, sizeof piece, fmt, ap);
    va_end(ap);
    if (n < 0 || (size_t)n >= sizeof piece) {
        t->status = fw_fail(t->m, FW_E_INTERNAL, "a settings line is too long");
        return;
    }
    t->status = fw_grow(&t->bytes, &t->capacity, t->n + (size_t)n + 1, 1, "settings", t->m);
    if (t->status != FW_OK) return;
    memcpy(t->bytes + t->n, piece, (size_t)n + 1);
    t->n += (size_t)n;
}

static void put_key(text *t, const fw_section *s, const char *key, const fw_values *v)
{
    char line[256];

    if (fw_keys_print(s, fw_keys_find(s, key), v, line, sizeof line) > 0) put(t, "%s", line);
}

static void put_keys(text *t, const fw_section *s, const fw_values *v)
{
    for (size_t i = 0; i < s->n_keys; i++) {
        if (s->keys[i].kind != FW_KEY_SHAPED) put_key(t, s, s->keys[i].name, v);
    }
}

/* ---- distributions ---------------------------------------------------------------------------------------------- */

static uint64_t hash_values(const fw_distribution *d)
{
    uint64_t parts[2] = {fw_fnv1a64(d->values, d->n * sizeof *d->values),
                         fw_fnv1a64(d->weights, d->n * sizeof *d->weights)};

    return fw_fnv1a64(parts, sizeof parts);
}

static void put_law(text *t, const char *key, const fw_distribution *d, const char *unit)
{
    if (d->kind == FW_DIST_CONSTANT) {
        put(t, "%s = %.17g%s%s\n", key, d->a, *unit ? " " : "", unit);
        return;
    }
    put(t, "%s = %s", key, fw_distribution_kind_name(d->kind));
    if (d->kind != FW_DIST_VALUES) {
        put(t, " %.17g %.17g %.17g %.17g", d->a, d->b, d->c, d->d);
    } else if (d->n > MAX_SHOWN) {
        put(t, " %zu of hash %016" PRIx64, d->n, hash_values(d));
    } else {
        for (size_t i = 0; i < d->n; i++) put(t, " %.17g:%.17g", d->values[i], d->weights[i]);
    }
    put(t, " in [%.17g, %.17g]%s%s\n", d->low, d->high, *unit ? " " : "", unit);
}

static uint64_t hash_cells(const fw_site *s)
{
    uint64_t h = 0;

    for (size_t i = 0; i < s->n_cells; i++) {
        const fw_site_cell *c = &s->cells[i];
        uint64_t            parts[6] = {h, c->mix, hash_values(&c->direction)};
        memcpy(&parts[3], &c->probability, sizeof(double));
        memcpy(&parts[4], &c->speed, sizeof(double));
        memcpy(&parts[5], &c->concentration, sizeof(double));
        h = fw_fnv1a64(parts, sizeof parts);
    }
    return h;
}

static void put_cells(text *t, const fw_site *s)
{
    put(t, "current.joint = %zu cells of hash %016" PRIx64 "\n", s->n_cells, hash_cells(s));
    for (size_t i = 0; i < s->n_cells && s->n_cells <= MAX_SHOWN; i++) {
        const fw_site_cell *c = &s->cells[i];
        put(t, "current.joint[%zu] = %.17g m/s %.17g mix %" PRIu32 " probability %.17g\n", i + 1, c->speed,
            c->concentration, c->mix + 1, c->probability);
    }
}

/* ---- the rest --------------------------------------------------------------------------------------------------- */

static void put_mixes(text *t, const fw_model *m)
{
    for (size_t i = 0; i < m->n_mixes; i++) {
        const fw_thickness_mix *mix = &m->mixes[i];
        put(t, "ice.thickness_mixes[%zu] = probability %.17g by %s", i + 1, mix->probability,
            mix->by_area ? "area" : "number");
        for (size_t k = 0; k < mix->n_classes; k++)
            put(t, ", %.17g m: %.17g", mix->classes[k].thickness, mix->classes[k].share);
        put(t, "\n");
    }
}

static void put_floe_diameter(text *t, const fw_values *v)
{
    put_key(t, &fw_table_floe_diameter, "distribution", v);
    if (v->floe_distribution == FW_SIZE_POWER_LAW) put_key(t, &fw_table_floe_diameter, "exponent", v);
    if (v->floe_distribution == FW_SIZE_LOGNORMAL) {
        put_key(t, &fw_table_floe_diameter, "median", v);
        put_key(t, &fw_table_floe_diameter, "sigma", v);
    }
}

static void put_effects(text *t, const fw_model *m)
{
    const fw_effect *const *effects;
    size_t                  n = fw_effects_list(&effects);

    put(t, "effects =");
    for (size_t i = 0; i < n; i++) {
        if (m->effects & (uint32_t)effects[i]->bit) put(t, " %s", effects[i]->name);
    }
    put(t, "\n");
}

/* What an effect acts with stands here while it is on: a campaign without it is the campaign that it was before there was the effect. */
static void put_contact(text *t, const fw_model *m, const fw_values *v)
{
    static const char *const always[] = {"stiffness", "damping_ratio", "friction", "slip_damping_ratio"};
    const fw_section        *s = &fw_table_contact;
    bool                     is_crush = fw_effects_have(m, FW_EFFECT_CRUSH_CONTACT);

    put(t, "contact.law = %s\n", is_crush ? "crush" : "spring");
    for (size_t i = 0; i < sizeof always / sizeof always[0]; i++) put_key(t, s, always[i], v);
    if (is_crush || m->stiffness_from_pressure) put_key(t, s, "pressure", v), put_key(t, s, "pressure_exponent", v);
    if (is_crush) put_key(t, s, "flat", v), put_key(t, s, "unloading_stiffness", v);
    if (fw_effects_have(m, FW_EFFECT_ICE_ON_ICE)) put_key(t, s, "floe_stiffness", v), put_key(t, s, "floe_friction", v);
}

static void put_water(text *t, const fw_model *m, const fw_values *v)
{
    put_key(t, &fw_table_water, "density", v);
    put_key(t, &fw_table_water, "form_drag", v);
    if (fw_effects_have(m, FW_EFFECT_SKIN_DRAG)) put_key(t, &fw_table_water, "skin_drag", v);
}

static void put_wind(text *t, const fw_campaign *c, const fw_values *v)
{
    if (!fw_effects_have(&c->model, FW_EFFECT_WIND)) return;
    put_law(t, "wind.speed", &c->site.wind_speed, "m/s");
    put_law(t, "wind.angle", &c->site.wind_angle, "deg");
    put_keys(t, &fw_table_wind, v);
}

static void put_tide(text *t, const fw_model *m, const fw_values *v)
{
    const fw_tide *tide = &m->tide;

    if (!fw_effects_have(m, FW_EFFECT_TIDE)) return;
    if (tide->n_rows == 0) {
        put_keys(t, &fw_table_tide, v);
        return;
    }
    put(t, "current.course = %zu rows of hash %016" PRIx64 "\n", tide->n_rows, fw_fnv1a64(tide->rows, tide->n_rows * sizeof *tide->rows));
    for (size_t i = 0; i < tide->n_rows && tide->n_rows <= MAX_SHOWN; i++)
        put(t, "current.course[%zu] = %.17g s %.17g %.17g rad\n", i + 1, tide->rows[i].time, tide->rows[i].factor, tide->rows[i].turn);
}

static void put_crushing_limit(text *t, const fw_model *m)
{
    if (!fw_effects_have(m, FW_EFFECT_CRUSHING_LIMIT)) return;
    put(t, "abrasion.crushing_limit.pressure = %.17g Pa\nabrasion.crushing_limit.exponent = %.17g\n", m->crushing_limit.pressure,
        m->crushing_limit.exponent);
}

/* Plain sampling is what campaigns had before there was another. */
static void put_sampling(text *t, const fw_sampling *a)
{
    static const char *const names[] = {"plain", "stratified", "latin_hypercube", "sobol"};

    if (a->design == FW_DESIGN_PLAIN) return;
    put(t, "sampling.design = %s\nsampling.randomisations = %" PRIu32 "\n", names[a->design], a->n_randomisations);
    if (a->design == FW_DESIGN_SOBOL) put(t, "sampling.scramble = %s\n", a->is_shifted ? "digital_shift" : "owen");
    if (a->n_allocation)
        put(t, "sampling.allocation = %zu of hash %016" PRIx64 "\n", a->n_allocation, fw_fnv1a64(a->allocation, a->n_allocation * sizeof *a->allocation));
}

/* Only what is given: a campaign without this section is the campaign that it was before there was one. */
static void put_numerics(text *t, const fw_values *v)
{
    if (v->order >= 0) put_key(t, &fw_table_numerics, "order", v);
    if (v->tolerance >= 0) put_key(t, &fw_table_numerics, "tolerance", v);
    if (v->wear_tolerance >= 0) put_key(t, &fw_table_numerics, "wear_tolerance", v);
    if (v->first_step >= 0) put_key(t, &fw_table_numerics, "first_step", v);
    if (v->growth >= 0) put_key(t, &fw_table_numerics, "growth", v);
}

fw_status fw_settings_make(fw_campaign *c, const fw_values *v, fw_msg *m)
{
    text t = {NULL, 0, 0, FW_OK, m};

    put(&t, "records of generation = %d\n", FW_RECORD_GENERATION);
    put_key(&t, &fw_table_campaign, "seed", v);
    put_key(&t, &fw_table_campaign, "accuracy", v);
    put_key(&t, &fw_table_structure, "diameter", v);
    put_key(&t, &fw_table_ice, "density", v);
    put_mixes(&t, &c->model);
    put_floe_diameter(&t, v);
    if (c->site.n_cells) {
        put_cells(&t, &c->site);
    } else {
        put_law(&t, "ice.concentration", &c->site.concentration, "");
        put_law(&t, "current.speed", &c->site.speed, "m/s");
    }
    put_contact(&t, &c->model, v);
    put_water(&t, &c->model, v);
    put_wind(&t, c, v);
    put_tide(&t, &c->model, v);
    put_effects(&t, &c->model);
    for (size_t i = 0; i < c->model.n_laws; i++)
        put(&t, "abrasion.laws[%zu].exponent = %.17g\n", i + 1, c->model.laws[i].exponent);
    put_crushing_limit(&t, &c->model);
    put_keys(&t, &fw_table_exposure, v);
    put_keys(&t, &fw_table_field, v);
    put_keys(&t, &fw_table_ring, v);
    put_numerics(&t, v);
    put_sampling(&t, &c->sampling);
    if (t.status != FW_OK) {
        free(t.bytes);
        return t.status;
    }
    c->settings = t.bytes;
    c->hash = fw_fnv1a64(t.bytes, t.n);
    return FW_OK;
}
