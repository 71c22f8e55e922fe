/* CSV and JSON of an answer. */
#include <math.h>

#include "cli/effects_print.h"
#include "cli/json.h"
#include "cli/report_table.h"

static size_t percentiles_per_point(const fw_answer *a) { return a->n_points ? a->n_percentiles / a->n_points : 0; }

static void csv_number(FILE *to, double x)
{
    if (isfinite(x)) {
        fprintf(to, ",%.17g", x);
    } else {
        fputc(',', to);
    }
}

void fw_report_print_csv(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    (void)c;
    size_t n = percentiles_per_point(a);
    fprintf(
        to,
        "point,bearing_deg,percentile,depth_mm,low_mm,high_mm,coverage,method,mean_mm,mean_low_mm,mean_high_mm,path_km,"
        "impact_share,high_share,life_depth_mm,life_low_mm,life_high_mm,life_windows,allowance_year,"
        "with_law_depth_mm,with_law_low_mm,with_law_high_mm,band_low_mm,band_high_mm,n_effective\n");
    for (size_t i = 0; i < a->n_percentiles; i++) {
        const fw_percentile_row *row = &a->percentiles[i];
        const fw_point_row      *p = &a->points[i / n];
        const fw_life_row        none = {
                   .depth_mm = NAN, .low_mm = NAN, .high_mm = NAN, .windows = NAN, .allowance_year = NAN, .with_law_depth_mm = NAN,
                   .with_law_low_mm = NAN, .with_law_high_mm = NAN};
        const fw_life_row *life = a->n_life ? &a->life[i] : &none;
        fprintf(to, "%zu", row->point);
        csv_number(to, row->bearing_deg);
        csv_number(to, row->percentile);
        csv_number(to, row->depth_mm);
        csv_number(to, row->low_mm);
        csv_number(to, row->high_mm);
        csv_number(to, row->coverage);
        fprintf(to, ",%s", row->method);
        csv_number(to, p->mean_mm);
        csv_number(to, p->mean_low_mm);
        csv_number(to, p->mean_high_mm);
        csv_number(to, p->path_km);
        csv_number(to, p->impact_share);
        csv_number(to, p->high_share);
        csv_number(to, life->depth_mm);
        csv_number(to, life->low_mm);
        csv_number(to, life->high_mm);
        csv_number(to, life->windows);
        csv_number(to, life->allowance_year);
        csv_number(to, life->with_law_depth_mm);
        csv_number(to, life->with_law_low_mm);
        csv_number(to, life->with_law_high_mm);
        csv_number(to, row->band_low_mm);
        csv_number(to, row->band_high_mm);
        csv_number(to, row->n_effective);
        fputc('\n', to);
    }
}

static void json_percentiles(fw_json *j, const fw_answer *a)
{
    fw_json_key(j, "percentiles");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_percentiles; i++) {
        const fw_percentile_row *row = &a->percentiles[i];
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)row->point);
        fw_json_put_number(j, "bearing_deg", row->bearing_deg);
        fw_json_put_number(j, "percentile", row->percentile);
        fw_json_put_number(j, "depth_mm", row->depth_mm);
        fw_json_put_number(j, "low_mm", row->low_mm);
        fw_json_put_number(j, "high_mm", row->high_mm);
        fw_json_put_number(j, "band_low_mm", row->band_low_mm);
        fw_json_put_number(j, "band_high_mm", row->band_high_mm);
        fw_json_put_number(j, "n_effective", row->n_effective);
        fw_json_put_number(j, "coverage", row->coverage);
        fw_json_put_string(j, "method", row->method);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_points(fw_json *j, const fw_answer *a)
{
    fw_json_key(j, "points");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_points; i++) {
        const fw_point_row *row = &a->points[i];
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)row->point);
        fw_json_put_number(j, "bearing_deg", row->bearing_deg);
        fw_json_put_number(j, "mean_mm", row->mean_mm);
        fw_json_put_number(j, "mean_low_mm", row->mean_low_mm);
        fw_json_put_number(j, "mean_high_mm", row->mean_high_mm);
        fw_json_put_number(j, "path_km", row->path_km);
        fw_json_put_number(j, "impact_share", row->impact_share);
        fw_json_put_number(j, "high_share", row->high_share);
        fw_json_put_string(j, "dominated_by", row->dominated_by);
        fw_json_put_number(j, "dominating_amount", row->dominating_amount);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_life(fw_json *j, const fw_answer *a)
{
    fw_json_key(j, "service_life");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_life; i++) {
        const fw_life_row *row = &a->life[i];
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)row->point);
        fw_json_put_number(j, "bearing_deg", row->bearing_deg);
        fw_json_put_number(j, "percentile", row->percentile);
        fw_json_put_number(j, "depth_mm", row->depth_mm);
        fw_json_put_number(j, "low_mm", row->low_mm);
        fw_json_put_number(j, "high_mm", row->high_mm);
        fw_json_put_number(j, "windows", row->windows);
        fw_json_put_number(j, "allowance_year", row->allowance_year);
        fw_json_put_number(j, "with_law_depth_mm", row->with_law_depth_mm);
        fw_json_put_number(j, "with_law_low_mm", row->with_law_low_mm);
        fw_json_put_number(j, "with_law_high_mm", row->with_law_high_mm);
        fw_json_put_string(j, "assumption", a->service.assumption);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_life_points(fw_json *j, const fw_answer *a)
{
    fw_json_key(j, "life_points");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->service.n_points; i++) {
        const fw_life_point *p = &a->service.points[i];
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)p->point);
        fw_json_put_number(j, "bearing_deg", p->bearing_deg);
        fw_json_put_number(j, "mean_mm", p->mean_mm);
        fw_json_put_number(j, "cv", p->cv);
        fw_json_put_number(j, "cv_windows", p->cv_windows);
        fw_json_put_number(j, "cv_persistence", p->cv_persistence);
        fw_json_put_number(j, "cv_years", p->cv_years);
        fw_json_put_number(j, "years_half_width", p->years_half_width);
        fw_json_put_number(j, "allowance_mm", p->allowance_mm);
        fw_json_put_number(j, "never", p->never);
        fw_json_put_number(j, "with_law_never", p->with_law_never);
        fw_json_put_number(j, "allowance_year_p5", p->allowance_year_p5);
        fw_json_put_number(j, "allowance_year_p50", p->allowance_year_p50);
        fw_json_put_number(j, "allowance_year_p95", p->allowance_year_p95);
        fw_json_end(j);
    }
    fw_json_end(j);
}

/* Year by year at the point that governs the life; NAME.h5 has all of them. */
static void json_years(fw_json *j, const fw_answer *a)
{
    fw_json_key(j, "life_fan");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->service.n_fan; i++) {
        const fw_fan_row *row = &a->service.fan[i];
        if (row->point != a->service.governing_point) continue;
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)row->point);
        fw_json_put_number(j, "year", row->year);
        fw_json_put_number(j, "percentile", row->percentile);
        fw_json_put_number(j, "depth_mm", row->depth_mm);
        fw_json_put_number(j, "with_law_depth_mm", row->with_law_depth_mm);
        fw_json_end(j);
    }
    fw_json_end(j);
    fw_json_key(j, "allowance_year");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->service.n_allowance; i++) {
        const fw_allowance_row *row = &a->service.allowance[i];
        if (row->point != a->service.governing_point) continue;
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)row->point);
        fw_json_put_number(j, "year", row->year);
        fw_json_put_number(j, "probability", row->probability);
        fw_json_put_number(j, "by_then", row->by_then);
        fw_json_put_number(j, "with_law_probability", row->with_law_probability);
        fw_json_put_number(j, "with_law_by_then", row->with_law_by_then);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_ledger(fw_json *j, const fw_answer *a)
{
    fw_json_key(j, "ledger");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_ledger; i++) {
        const fw_ledger_row *row = &a->ledger[i];
        fw_json_begin_object(j);
        fw_json_put_string(j, "row", row->row);
        fw_json_put_number(j, "amount", row->amount);
        fw_json_put_string(j, "shrinks_with", row->shrinks_with);
        fw_json_put_string(j, "cost_to_halve", row->cost_to_halve);
        fw_json_put_number(j, "cost_to_halve_cpu_s", row->cost_to_halve_cpu_s);
        fw_json_put_bool(j, "is_sum", row->is_sum);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_advice(fw_json *j, const fw_answer *a)
{
    const fw_advice *v = &a->advice;
    fw_json_key(j, "cpu_advice"); /* which row pays best follows from a clock */
    fw_json_begin_object(j);
    fw_json_put_number(j, "doubt", v->total);
    fw_json_put_string(j, "largest", v->largest < a->n_ledger ? a->ledger[v->largest].row : "");
    fw_json_put_string(j, "best_paid", v->best_paid < a->n_ledger ? a->ledger[v->best_paid].row : "");
    fw_json_put_number(j, "doubt_after", v->total_after);
    fw_json_end(j);
}

static void json_swept(fw_json *j, const fw_answer *a)
{
    bool is_there = a->n_swept > 0;
    fw_json_key(j, "swept_strip");
    fw_json_begin_object(j);
    fw_json_put_number(j, "ring_ratio", is_there ? a->swept_ring.ratio : NAN);
    fw_json_put_number(j, "usual_ratio", is_there ? a->swept_ring.usual : NAN);
    fw_json_put_number(j, "law_over_sample", is_there ? a->swept_ring.law_over_sample : NAN);
    fw_json_put_string(j, "why_not", is_there ? NULL : a->swept_why);
    fw_json_key(j, "points");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_swept; i++) {
        const fw_sanity_row *row = &a->swept[i];
        fw_json_begin_object(j);
        fw_json_put_integer(j, "point", (int64_t)row->point);
        fw_json_put_number(j, "bearing_deg", row->bearing_deg);
        fw_json_put_number(j, "strip_mm", row->strip_mm);
        fw_json_put_number(j, "law_mm", row->law_mm);
        fw_json_put_number(j, "ratio", row->ratio);
        fw_json_end(j);
    }
    fw_json_end(j);
    fw_json_end(j);
}

/* Only what the campaign asks for. */
static void json_after(fw_json *j, const fw_campaign *c, const fw_answer *a)
{
    const fw_water_level *w = &a->water_level;
    if (a->law_scatter.is_given) {
        fw_json_key(j, "law_scatter");
        fw_json_begin_object(j);
        fw_json_put_number(j, "mean", a->law_scatter.mean);
        fw_json_put_number(j, "median", a->law_scatter.median);
        fw_json_put_number(j, "low", a->law_scatter.low);
        fw_json_put_number(j, "high", a->law_scatter.high);
        fw_json_end(j);
    }
    if (!c->after.has_water_level) return;
    fw_json_key(j, "water_level");
    fw_json_begin_object(j);
    fw_json_put_integer(j, "point", (int64_t)a->governing_point);
    fw_json_put_number(j, "thickness_m", w->n ? w->thickness : NAN);
    fw_json_put_number(j, "most_height_m", w->n ? w->most_height : NAN);
    fw_json_put_number(j, "most_share", w->n ? w->most_share : NAN);
    fw_json_put_number(j, "band_low_m", w->n ? w->band_low : NAN);
    fw_json_put_number(j, "band_high_m", w->n ? w->band_high : NAN);
    fw_json_key(j, "height_m");
    fw_json_begin_array(j);
    for (size_t i = 0; i < w->n; i++) fw_json_number(j, w->height[i]);
    fw_json_end(j);
    fw_json_key(j, "share");
    fw_json_begin_array(j);
    for (size_t i = 0; i < w->n; i++) fw_json_number(j, w->share[i]);
    fw_json_end(j);
    fw_json_end(j);
}

void fw_report_print_json(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    fw_json j = fw_json_onto(to);
    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", c->name);
    fw_json_put_integer(&j, "n", (int64_t)a->n);
    fw_json_put_integer(&j, "failed", (int64_t)a->n_failed);
    fw_json_put_integer(&j, "first_id", (int64_t)a->span.first);
    fw_json_put_integer(&j, "last_id", (int64_t)(a->span.end ? a->span.end : a->n) - 1);
    fw_json_put_integer(&j, "seed", (int64_t)c->seed);
    fw_json_put_number(&j, "window_s", c->model.window);
    fw_json_put_number(&j, "confidence", a->confidence);
    fw_json_put_number(&j, "design_percentile", a->design_percentile);
    fw_json_put_integer(&j, "governing_point", (int64_t)a->governing_point);
    fw_json_put_number(&j, "half_width", a->half_width);
    json_percentiles(&j, a);
    json_points(&j, a);
    json_life(&j, a);
    if (a->n_life) {
        fw_json_put_integer(&j, "life_governing_point", (int64_t)a->service.governing_point);
        json_life_points(&j, a);
        json_years(&j, a);
    }
    json_ledger(&j, a);
    json_advice(&j, a);
    json_swept(&j, a);
    fw_json_key(&j, "effects_ledger"), fw_effects_json_rows(&j, &a->effects);
    fw_json_put_string(&j, "effects_measured", a->effects.n_rows ? a->effects.origin : "nowhere");
    json_after(&j, c, a);
    fw_json_key(&j, "not_applied");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < c->n_not_applied; i++) fw_json_string(&j, c->not_applied[i]);
    fw_json_end(&j);
    fw_json_put_string(&j, "not_modelled", "level-ice crushing at MPa; published field rates of 0.2-7 mm/year include it");
    fw_json_end(&j);
}
