#include "cli/plan_design.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/report_summary.h"
#include "realisation/cost.h"

static const double PILOT_S = 200; /* expected of all its windows */
enum { FEWEST_PILOT = 24 };

/* ---- running ----------------------------------------------------------------------------------------------------- */

size_t fw_plan_pilot_size(const fw_campaign *c, long n)
{
    uint64_t part = c->precision.max_realisations / 8; /* a pilot is not the campaign */
    if (n >= 0) return (size_t)n;
    return part > FW_OUTLOOK_PILOT ? FW_OUTLOOK_PILOT : part < FEWEST_PILOT ? FEWEST_PILOT : (size_t)part;
}

fw_status fw_plan_pilot(const fw_campaign *c, long n, bool is_quiet, fw_record **pilot, size_t *n_pilot, fw_msg *m)
{
    size_t    most = fw_plan_pilot_size(c, n);
    double    evaluations = 0;
    fw_status s = FW_OK;
    *n_pilot = 0;
    FW_TRY(fw_alloc(pilot, most, sizeof **pilot, "records of the pilot", m));
    while (*n_pilot < most && s == FW_OK) {
        fw_scenario sc;
        double      one;
        fw_campaign_plain_scenario(c, *n_pilot, &sc);
        s = fw_cost_expected(&c->model, &sc, &one, m);
        evaluations += one;
        if (n < 0 && evaluations > PILOT_S * FW_PLAN_EVALUATIONS_PER_S) break;
        if (s == FW_OK) s = fw_realise(&c->model, &sc, NULL, &(*pilot)[*n_pilot], m);
        if (s == FW_OK) ++*n_pilot;
        if (!is_quiet && *n_pilot % 16 == 0) fprintf(stderr, "pilot: %zu of %zu windows\n", *n_pilot, most);
    }
    if (s == FW_OK) return FW_OK;
    for (size_t i = 0; i < *n_pilot; i++) fw_record_free(&(*pilot)[i]);
    free(*pilot);
    *pilot = NULL, *n_pilot = 0;
    return s;
}

static void say(void *self, const char *what)
{
    (void)self;
    fprintf(stderr, "%s\n", what);
}

fw_status fw_plan_outlook(fw_outlook *out, const fw_campaign *c, size_t n, const fw_record *pilot, bool is_quiet, fw_msg *m)
{
    fw_outlook_options o = {.scenario = fw_campaign_scenario,
                            .n_strata = fw_campaign_n_strata,
                            .stratum = fw_campaign_stratum,
                            .law = fw_campaign_law(c),
                            .say = is_quiet ? NULL : say};
    return fw_outlook_make(out, c, n, pilot, &o, m);
}

fw_plan_forecast fw_plan_forecast_make(const fw_campaign *c, const fw_outlook *x)
{
    fw_plan_forecast f = {.n = (double)c->precision.max_realisations, .n_wanted = NAN};
    if (x->is_known && c->precision.half_width > 0) {
        f.n_wanted = fw_outlook_wanted(x, c->precision.half_width);
        f.n = fmin(f.n, f.n_wanted);
    }
    f.half_width = fw_outlook_half_width(x, f.n);
    f.cpu_s = fw_outlook_cpu_s(x, f.n);
    return f;
}

/* ---- printing ---------------------------------------------------------------------------------------------------- */

static void print_pilot(FILE *to, const fw_outlook *x, size_t wanted)
{
    if (x->n_pilot < wanted)
        fprintf(to, "\npilot: %s; --pilot %zu runs %zu all the same\n",
                x->n_pilot ? "cut short, its next window may take minutes" : "none, its first window may take minutes", wanted, wanted);
    if (x->n_pilot == 0) return;
    fprintf(to, "\npilot of %zu realisations: %.3g CPU s each in the mean, %.3g at most, %zu failed\n", x->n_pilot, x->cpu_mean, x->cpu_most, x->n_failed);
    if (!x->is_known) {
        fprintf(to, "  too few of them wore for a forecast: at least %d are wanted\n", (int)FW_OUTLOOK_FEWEST);
        return;
    }
    const fw_emulator *e = &x->emulator;
    fprintf(to, "  wear load over the ring: scatter %.2f in its logarithm, of which speed, concentration, mix and the swept strip leave %.2f (held-out windows)\n",
            e->scatter, e->held_out);
    if (e->dry_share > 0) fprintf(to, "  without any wear: %.2g %%\n", 100 * e->dry_share);
}

static void print_width(FILE *to, double width)
{
    if (isfinite(width))
        fprintf(to, "%8.2f %%", 100 * width);
    else
        fprintf(to, "%10s", "none");
}

static void print_designs(FILE *to, const fw_campaign *c, const fw_outlook *x)
{
    fprintf(to, "\ndesign of the sampling, by %d made-up campaigns of %zu realisations each\n  %-24s half-width  evaluations  CPU hours for the same half-width\n",
            (int)FW_OUTLOOK_CAMPAIGNS,
            x->n_virtual, "");
    for (size_t i = 0; i < x->n_designs; i++) {
        const fw_outlook_design *d = &x->design[i];
        fprintf(to, "  %-24s", d->name);
        print_width(to, d->half_width);
        fprintf(to, "  %11.3g  x%.2g%s\n", d->evaluations, 1 / d->pays, i == x->chosen ? "   <- chosen" : "");
    }
    if (c->sampling.is_auto)
        fprintf(to, "  %s\n", x->reason);
    else
        fprintf(to, "  %s; the campaign names its design itself, and is run by that\n", x->reason);
}

static void print_hours(FILE *to, double cpu_s)
{
    static const int cores[] = {1, 2, 4, 16, 64};
    for (size_t i = 0; i < sizeof cores / sizeof cores[0]; i++) {
        double s = cpu_s / cores[i];
        fprintf(to, "%s%.3g %s on %d", i ? ", " : "", s >= 3600 ? s / 3600 : s, s >= 3600 ? "h" : "s", cores[i]);
    }
}

void fw_plan_design_print(FILE *to, const fw_campaign *c, const fw_outlook *x, const fw_plan_forecast *f, size_t n_wanted_pilot)
{
    char quantity[32];
    print_pilot(to, x, n_wanted_pilot);
    if (x->is_known) print_designs(to, c, x);
    if (x->n_pilot == 0) return;
    fprintf(to, "\nforecast\n");
    if (isfinite(f->n_wanted))
        fprintf(to, "  %.0f realisations reach a half-width of %.3g %% of %s at the worst of the points%s\n", f->n_wanted, 100 * c->precision.half_width,
                fw_report_quantity(c, quantity, sizeof quantity),
                f->n_wanted > (double)c->precision.max_realisations ? ": more than max_realisations" : "");
    fprintf(to, "  a run of %.0f realisations", f->n);
    if (isfinite(f->half_width)) fprintf(to, ": half-width about %.2g %%", 100 * f->half_width);
    fprintf(to, ", %.3g CPU hours: ", f->cpu_s / 3600);
    print_hours(to, f->cpu_s);
    fprintf(to, " cores\n");
}

void fw_plan_design_json(fw_json *j, const fw_campaign *c, const fw_outlook *x, const fw_plan_forecast *f)
{
    fw_json_key(j, "pilot");
    fw_json_begin_object(j);
    fw_json_put_integer(j, "n", (int64_t)x->n_pilot);
    fw_json_put_integer(j, "failed", (int64_t)x->n_failed);
    fw_json_put_number(j, "cpu_s_mean", x->n_pilot ? x->cpu_mean : NAN);
    fw_json_put_number(j, "cpu_s_max", x->n_pilot ? x->cpu_most : NAN);
    fw_json_put_number(j, "sd_of_log_load", x->is_known ? x->emulator.scatter : NAN);
    fw_json_put_number(j, "held_out_error", x->is_known ? x->emulator.held_out : NAN);
    fw_json_end(j);
    fw_json_key(j, "designs");
    fw_json_begin_array(j);
    for (size_t i = 0; i < x->n_designs; i++) {
        const fw_outlook_design *d = &x->design[i];
        fw_json_begin_object(j);
        fw_json_put_string(j, "name", d->name);
        fw_json_put_number(j, "half_width", d->half_width);
        fw_json_put_number(j, "force_evaluations", d->evaluations);
        fw_json_put_number(j, "pays", d->pays);
        fw_json_put_bool(j, "chosen", i == x->chosen);
        fw_json_end(j);
    }
    fw_json_end(j);
    fw_json_put_string(j, "design_reason", x->is_known ? x->reason : "");
    fw_json_key(j, "predicted");
    fw_json_begin_object(j);
    fw_json_put_number(j, "realisations", f->n);
    fw_json_put_number(j, "realisations_wanted", f->n_wanted);
    fw_json_put_number(j, "half_width", f->half_width);
    fw_json_put_number(j, "cpu_s", f->cpu_s);
    fw_json_put_integer(j, "max_realisations", (int64_t)c->precision.max_realisations);
    fw_json_end(j);
}
