/* Rows of the ledger: the abrasion law, and the years of a life. */
#include <gsl/gsl_sort.h>
#include <stdlib.h>

#include "base/memory.h"
#include "study/ledger_inside.h"

/* The scatter alone is exact; coefficient and exponent come in draws. */
static fw_status take_law(const fw_campaign *c, const fw_law_factor *law, size_t i, fw_law_scatter *out, fw_msg *m)
{
    const fw_distribution *f = &c->after.law_scatter;
    double                *factor = NULL;
    if (law->n == 0 || !(c->after.has_law_coefficient || c->after.has_law_exponent)) {
        *out = (fw_law_scatter){true, fw_distribution_mean(f), fw_distribution_quantile(f, 0.5), fw_distribution_quantile(f, 0.025),
                                fw_distribution_quantile(f, 0.975)};
        return FW_OK;
    }
    FW_TRY(fw_alloc(&factor, law->n, sizeof *factor, "draws of a law", m));
    fw_law_factor_of_point(law, i, factor);
    *out = (fw_law_scatter){.is_given = true};
    for (size_t k = 0; k < law->n; k++) out->mean += factor[k] / (double)law->n;
    gsl_sort(factor, 1, law->n);
    out->median = fw_order_percentile(law->n, factor, 0.5);
    out->low = fw_order_percentile(law->n, factor, 0.025);
    out->high = fw_order_percentile(law->n, factor, 0.975);
    free(factor);
    return FW_OK;
}

fw_status fw_ledger_law(fw_ledger_row *row, const fw_campaign *c, const fw_law_factor *law, size_t i, fw_law_scatter *out,
                        const fw_percentile_row *g, fw_msg *m)
{
    if (!c->after.has_law_scatter && law->n == 0) {
        fw_ledger_unmeasured(row, "law and its scatter", "laboratory and field data (a published fit has R2 66 %)");
        return FW_OK;
    }
    FW_TRY(take_law(c, law, i, out, m));
    SAY(row->row, "law and its scatter");
    row->amount = (out->high - out->low) / (2 * out->median);
    SAY(row->shrinks_with, "laboratory and field data: factor of mean %.3g, 95 %% of it in %.3g .. %.3g, which makes P%g %.3g .. %.3g mm", out->mean,
        out->low, out->high, g->percentile, out->low * g->depth_mm, out->high * g->depth_mm);
    SAY(row->cost_to_halve, "not known: no computation shrinks it");
    return FW_OK;
}

/* Half of what 95 % of a normal law with this coefficient of variation spans. */
static double half_of(double cv) { return 1.96 * cv; }

void fw_ledger_persistence(fw_ledger_row *row, const fw_campaign *c, const fw_life_point *p)
{
    if (!(c->service.persistence > 0)) {
        fw_ledger_unmeasured(row, "life: independent windows", "windows that resemble their neighbours scatter a life more (service.persistence)");
        return;
    }
    SAY(row->row, "life: persistence");
    row->amount = half_of(p->cv_persistence);
    SAY(row->shrinks_with, "nothing: persistence %g spreads lives this much and is in their percentiles, beside %.2g %% of independent windows",
        c->service.persistence, 100 * half_of(p->cv_windows));
    SAY(row->cost_to_halve, "none: it is scatter, no error");
    row->is_scatter = true;
}

void fw_ledger_years(fw_ledger_row *row, const fw_campaign *c, const fw_life_point *p)
{
    const fw_service *q = &c->service;
    SAY(row->row, "between years");
    if (q->n_table) {
        row->amount = p->years_half_width;
        SAY(row->shrinks_with, "more years than the %zu of the table: half-width for not knowing the law of years, in the interval of the life; years that "
            "differ spread lives by %.2g %%", q->n_table, 100 * half_of(p->cv_years));
        SAY(row->cost_to_halve, "%zu years more of the site's record", 3 * q->n_table);
        return;
    }
    if (!(q->year_to_year_cv > 0)) {
        fw_ledger_unmeasured(row, "between years", "no year_to_year_cv and no table of years is given");
        return;
    }
    row->amount = half_of(p->cv_years);
    SAY(row->shrinks_with, "nothing: year_to_year_cv %g spreads lives this much and is in their percentiles; a record of whole years (service.years) "
        "says whether it is true", q->year_to_year_cv);
    SAY(row->cost_to_halve, "none: it is scatter, no error");
    row->is_scatter = true;
}
