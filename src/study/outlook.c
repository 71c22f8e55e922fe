#include "study/outlook.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/outlook_inside.h"

enum { VIRTUAL = 400, FEWEST_VIRTUAL = 100, FIRST_LOOK = 100 };
/* What another design has to pay more than plain sampling. */
static const double PAYS = 1.1;

#define SAY(o, ...)                                           \
    do {                                                      \
        char words_[120];                                     \
        snprintf(words_, sizeof words_, __VA_ARGS__);         \
        if ((o)->say) (o)->say((o)->say_self, words_);        \
    } while (0)

/* ---- made-up campaigns ------------------------------------------------------------------------------------------- */

typedef struct made_up {
    fw_campaign               campaign; /* a copy that owns nothing: another seed, another design */
    const fw_outlook_windows *windows;
    double                    evaluations; /* of all that were read */
} made_up;

static fw_status read_made_up(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    made_up    *u = self;
    fw_scenario s;
    double      cost;
    u->windows->o->scenario(&u->campaign, id, &s);
    fw_outlook_windows_draw(u->windows, &s, 0, r);
    FW_TRY(fw_outlook_windows_cost(u->windows, &s, &cost, m));
    u->evaluations += cost;
    r->force_evaluations = cost;
    return FW_OK;
}

/* The median half-width of a few campaigns: one that has no interval yet must not spoil it. */
static fw_status try_design(fw_outlook *x, const fw_outlook_windows *w, fw_outlook_design *design, fw_reached *last, fw_msg *m)
{
    made_up u = {.campaign = *w->campaign, .windows = w};
    double  widths[FW_OUTLOOK_CAMPAIGNS];
    u.campaign.sampling = design->sampling;
    for (int i = 0; i < FW_OUTLOOK_CAMPAIGNS; i++) {
        u.campaign.seed = w->campaign->seed + 1 + (uint64_t)i;
        fw_answer_source source = {.records = {.n = x->n_virtual, .read = read_made_up, .self = &u}, .law = w->o->law};
        FW_TRY(fw_answer_reached_beside(&u.campaign, &source, w->strip, last, m));
        widths[i] = last->half_width;
    }
    gsl_sort(widths, 1, FW_OUTLOOK_CAMPAIGNS);
    design->half_width = 0.5 * (widths[FW_OUTLOOK_CAMPAIGNS / 2 - 1] + widths[FW_OUTLOOK_CAMPAIGNS / 2]);
    design->evaluations = u.evaluations / ((double)FW_OUTLOOK_CAMPAIGNS * (double)x->n_virtual);
    return FW_OK;
}

/* ---- designs ----------------------------------------------------------------------------------------------------- */

static void add_design(fw_outlook *x, const char *name, fw_sampling sampling)
{
    fw_outlook_design *d = &x->design[x->n_designs++];
    snprintf(d->name, sizeof d->name, "%s", name);
    d->sampling = sampling;
}

/* More designs than plain sampling make no sense where there is one scenario. */
static void list_designs(fw_outlook *x, const fw_campaign *c, size_t n_strata, bool has_allocation)
{
    fw_sampling s = c->sampling;
    s.allocation = NULL, s.n_allocation = 0;
    s.design = FW_DESIGN_PLAIN, add_design(x, "plain", s);
    s.design = FW_DESIGN_STRATIFIED, add_design(x, "stratified", s);
    if (has_allocation) {
        s.allocation = x->allocation, s.n_allocation = n_strata;
        add_design(x, "stratified, allocated", s);
        s.allocation = NULL, s.n_allocation = 0;
    }
    s.design = FW_DESIGN_LATIN, add_design(x, "latin_hypercube", s);
    s.design = FW_DESIGN_SOBOL, add_design(x, "sobol", s);
}

static void choose(fw_outlook *x, const fw_campaign *c)
{
    const fw_outlook_design *plain = &x->design[0];
    char                     quantity[32] = "the mean";
    double                   of_plain = plain->half_width * plain->half_width * plain->evaluations, best = PAYS;
    if (c->precision.quantity == FW_QUANTITY_PERCENTILE) snprintf(quantity, sizeof quantity, "P%g", c->precision.percentile);
    for (size_t i = 0; i < x->n_designs; i++) {
        fw_outlook_design *d = &x->design[i];
        double             own = d->half_width * d->half_width * d->evaluations;
        d->pays = isfinite(of_plain) && own > 0 ? of_plain / own : isfinite(own) ? INFINITY : NAN;
        if (i == 0) d->pays = 1;
        if (d->pays > best) best = d->pays, x->chosen = i;
    }
    if (x->chosen > 0 && isfinite(best))
        snprintf(x->reason, sizeof x->reason, "%s of %s takes 1/%.2g of plain sampling's CPU hours for the same half-width", x->design[x->chosen].name,
                 quantity, best);
    else if (x->chosen > 0)
        snprintf(x->reason, sizeof x->reason, "%s gives %s an interval after %zu realisations, and plain sampling does not", x->design[x->chosen].name,
                 quantity, x->n_virtual);
    else
        snprintf(x->reason, sizeof x->reason, "no other design gives %s for 1/%.2g of its CPU hours", quantity, PAYS);
}

static fw_status try_all(fw_outlook *x, const fw_outlook_windows *w, fw_msg *m)
{
    const fw_campaign *c = w->campaign;
    fw_reached         reached = {.point = 1};
    size_t             n_strata = w->o->n_strata(c);
    bool               has_allocation = n_strata > 1 && n_strata <= FW_MAX_STRATA;
    x->n_virtual = (size_t)fmin(VIRTUAL, fmax(FEWEST_VIRTUAL, (double)c->precision.max_realisations));
    if (has_allocation) FW_TRY(fw_alloc(&x->allocation, n_strata, sizeof *x->allocation, "allocation", m));
    list_designs(x, c, n_strata, has_allocation);
    for (size_t i = 0; i < x->n_designs; i++) {
        fw_outlook_design *d = &x->design[i];
        SAY(w->o, "design: %s", d->name);
        if (d->sampling.allocation) /* x and point are those of plain sampling's last campaign */
            FW_TRY(fw_outlook_allocate(w, c->points.bearing[reached.point - 1], reached.value_mm, n_strata, x->allocation, m));
        fw_reached last;
        FW_TRY(try_design(x, w, d, &last, m));
        if (i == 0) reached = last;
    }
    choose(x, c);
    return FW_OK;
}

static void take_costs(fw_outlook *x, size_t n, const fw_record *pilot)
{
    double cpu = 0, evaluations = 0;
    for (size_t i = 0; i < n; i++) {
        x->n_failed += pilot[i].status != FW_OK;
        cpu += pilot[i].host_cpu_s, evaluations += pilot[i].force_evaluations;
        x->cpu_most = fmax(x->cpu_most, pilot[i].host_cpu_s);
    }
    x->cpu_mean = n ? cpu / (double)n : NAN;
    x->cpu_s_per_evaluation = evaluations > 0 ? cpu / evaluations : NAN;
}

fw_status fw_outlook_make(fw_outlook *out, const fw_campaign *c, size_t n, const fw_record *pilot, const fw_outlook_options *o, fw_msg *m)
{
    fw_sanity          strip;
    fw_outlook_windows w = {0};
    memset(out, 0, sizeof *out);
    out->n_pilot = n;
    take_costs(out, n, pilot);
    if (n < FW_OUTLOOK_FEWEST) return FW_OK;
    FW_TRY(fw_sanity_begin(&strip, c, 0, m));
    fw_status s = fw_outlook_windows_make(&w, c, n, pilot, &strip, o, m);
    if (s == FW_OK) out->emulator = w.emulator, out->emulator.strip = NULL;
    out->is_known = s == FW_OK && w.emulator.n_functions > 0;
    if (out->is_known) s = try_all(out, &w, m);
    fw_outlook_windows_free(&w);
    fw_sanity_free(&strip);
    if (s != FW_OK) fw_outlook_free(out);
    return s;
}

void fw_outlook_free(fw_outlook *x)
{
    if (!x) return;
    free(x->allocation);
    memset(x, 0, sizeof *x);
}

double fw_outlook_half_width(const fw_outlook *x, double n)
{
    return x->is_known ? x->design[x->chosen].half_width * sqrt((double)x->n_virtual / n) : NAN;
}

double fw_outlook_cpu_s(const fw_outlook *x, double n)
{
    return x->is_known ? n * x->design[x->chosen].evaluations * x->cpu_s_per_evaluation : n * x->cpu_mean;
}

double fw_outlook_wanted(const fw_outlook *x, double half_width)
{
    if (!x->is_known) return NAN;
    double ratio = x->design[x->chosen].half_width / half_width;
    return fmax(FIRST_LOOK, ceil((double)x->n_virtual * ratio * ratio));
}
