#include "cli/plan_strip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "statistics/scale.h"
#include "study/sanity.h"

/* Mean hits, and how much more than the strip floes wear that press one another, each condition by its load. */
static void average(fw_plan_strip *out, const fw_campaign *c, const fw_sanity *strip)
{
    fw_scenario_law law = fw_campaign_law(c);
    double          hits = 0, load = 0, crowded = 0;
    for (uint64_t i = 0; i < law.n; i++) {
        fw_scenario s;
        law.point(c, i, &s);
        double own = s.weight * exp(fw_sanity_ln_strip(strip, &s));
        hits += s.weight * fw_swept_hits(&strip->swept, &s);
        load += own, crowded += own * fw_swept_crowding(s.concentration);
    }
    out->hits_per_hour = hits * 3600 / c->model.window;
    out->usual = load > 0 ? crowded / load : NAN;
    out->evaluations = strip->swept.force_evaluations;
}

static fw_status points(fw_plan_strip *out, const fw_campaign *c, const fw_sanity *strip, fw_msg *m)
{
    const fw_abrasion_law *law = &c->model.laws[0];
    fw_directions          directions;
    fw_scale               scale;
    fw_sanity_row         *rows = NULL;
    fw_sanity_ring         ring;
    memset(&directions, 0, sizeof directions);
    FW_TRY(fw_scale_make(&scale, law->coefficient, law->exponent, law->uses_temperature ? &c->site.temperature : NULL, m));
    fw_status s = fw_directions_make(&directions, &c->site, c->model.n_arcs, c->points.n, c->points.bearing, m);
    if (s == FW_OK) s = fw_alloc(&rows, c->points.n, sizeof *rows, "rows of the swept strip", m);
    if (s == FW_OK) s = fw_sanity_end(strip, c, &directions, scale.moment[1], rows, &ring, m);
    for (size_t i = 0; i < c->points.n && s == FW_OK; i++) {
        out->mean_mm[i] = rows[i].law_mm;
        if (out->mean_mm[i] > out->mean_mm[out->most]) out->most = i;
    }
    free(rows);
    fw_directions_free(&directions);
    fw_scale_free(&scale);
    return s;
}

fw_status fw_plan_strip_make(fw_plan_strip *out, const fw_campaign *c, fw_msg *m)
{
    fw_sanity strip;
    *out = (fw_plan_strip){.n_points = c->points.n};
    FW_TRY(fw_sanity_begin(&strip, c, 0, m));
    memcpy(out->why, strip.why, sizeof out->why < sizeof strip.why ? sizeof out->why : sizeof strip.why);
    fw_status s = FW_OK;
    if (!out->why[0]) s = fw_alloc(&out->mean_mm, out->n_points, sizeof *out->mean_mm, "depths by the swept strip", m);
    if (!out->why[0] && s == FW_OK) average(out, c, &strip);
    if (!out->why[0] && s == FW_OK) s = points(out, c, &strip, m);
    fw_sanity_free(&strip);
    if (s != FW_OK) fw_plan_strip_free(out);
    return s;
}

void fw_plan_strip_free(fw_plan_strip *s)
{
    free(s->mean_mm);
    memset(s, 0, sizeof *s);
}

void fw_plan_strip_print(FILE *to, const fw_campaign *c, const fw_plan_strip *s)
{
    if (s->why[0]) {
        fprintf(to, "\nswept strip: none: %s\n", s->why);
        return;
    }
    fprintf(to, "\nswept strip (floes that hit one by one; %.2g force evaluations): %.3g hits an hour; mean depth of a window %.3g mm at most, at point %zu (%g deg);"
            "\n  floes that press one another usually wear %.2g times as much\n",
            s->evaluations, s->hits_per_hour, s->mean_mm[s->most], s->most + 1, c->points.bearing[s->most], s->usual);
}

void fw_plan_strip_json(fw_json *j, const fw_campaign *c, const fw_plan_strip *s)
{
    fw_json_key(j, "swept_strip");
    fw_json_begin_object(j);
    fw_json_put_string(j, "why_not", s->why);
    fw_json_put_number(j, "hits_per_hour", s->why[0] ? NAN : s->hits_per_hour);
    fw_json_put_number(j, "usual_ratio", s->why[0] ? NAN : s->usual);
    fw_json_put_number(j, "force_evaluations", s->why[0] ? NAN : s->evaluations);
    fw_json_key(j, "points");
    fw_json_begin_array(j);
    for (size_t i = 0; i < s->n_points && !s->why[0]; i++) {
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)i + 1);
        fw_json_put_number(j, "bearing_deg", c->points.bearing[i]);
        fw_json_put_number(j, "mean_mm", s->mean_mm[i]);
        fw_json_end(j);
    }
    fw_json_end(j);
    fw_json_end(j);
}
