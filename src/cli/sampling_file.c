#include "cli/sampling_file.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "campaign/strata.h"

/* The order of the words in SAMPLING of tables.c. */
enum { WORD_AUTO, WORD_PLAIN, WORD_STRATIFIED, WORD_LATIN, WORD_SOBOL };

static fw_design design_of(int word)
{
    switch (word) {
    case WORD_STRATIFIED: return FW_DESIGN_STRATIFIED;
    case WORD_LATIN: return FW_DESIGN_LATIN;
    case WORD_SOBOL: return FW_DESIGN_SOBOL;
    default: return FW_DESIGN_PLAIN;
    }
}

static const char ALLOCATION[] = "sampling.allocation", POINTS[] = "precision.points";

/* A stratum that is met once in a million times as it should be is one that is never met. */
static const double MOST_WEIGHT = 1e6;

/* Shares of the realisations, divided by their sum. A stratum that happens must be drawn. */
static fw_status read_allocation(const fw_reader *r, const fw_node *n, const fw_model *model, const fw_site *site, fw_sampling *out)
{
    fw_strata strata;
    double    sum = 0;

    fw_strata_make(&strata, model, site);
    if (n->kind != FW_NODE_LIST) return fw_yaml_fail(n, r->m, "%s: wanted a list of %zu shares, or nothing: proportional", ALLOCATION, strata.n);
    if (n->n != strata.n) return fw_yaml_fail(n, r->m, "%s has %zu shares; this site has %zu strata", ALLOCATION, n->n, strata.n);
    if (strata.n > FW_MAX_STRATA) return fw_yaml_fail(n, r->m, "%s: at most %d strata can have one, this site has %zu", ALLOCATION, (int)FW_MAX_STRATA, strata.n);
    FW_TRY(fw_alloc(&out->allocation, strata.n, sizeof *out->allocation, ALLOCATION, r->m));
    out->n_allocation = strata.n;
    for (size_t i = 0; i < strata.n; i++) {
        const fw_node *item = n->values[i];
        FW_TRY(fw_read_quantity(r, item, ALLOCATION, "1", &out->allocation[i]));
        bool happens = fw_strata_share(&strata, i) > 0;
        if (!(out->allocation[i] >= 0 && isfinite(out->allocation[i])) || (happens && !(out->allocation[i] > 0)))
            return fw_yaml_fail(item, r->m, "%s: %g for stratum %zu, wanted more than 0: what is never drawn has no weight", ALLOCATION, out->allocation[i],
                                i + 1);
        if (!happens) out->allocation[i] = 0;
        sum += out->allocation[i];
    }
    if (!isfinite(sum)) return fw_yaml_fail(n, r->m, "%s: these shares do not add up to a number", ALLOCATION);
    for (size_t i = 0; i < strata.n; i++) {
        out->allocation[i] /= sum;
        if (out->allocation[i] < fw_strata_share(&strata, i) / MOST_WEIGHT)
            return fw_yaml_fail(n->values[i], r->m, "%s: stratum %zu is drawn %.2g times as often as the site has it, wanted at least %g times", ALLOCATION, i + 1,
                                out->allocation[i] / fw_strata_share(&strata, i), 1 / MOST_WEIGHT);
    }
    return FW_OK;
}

fw_status fw_file_read_sampling(const fw_reader *r, fw_values *v, const fw_model *model, const fw_site *site, fw_sampling *out)
{
    const fw_node *map = fw_yaml_get(r->root, "sampling"), *allocation = fw_yaml_get(map, "allocation");
    uint64_t       given = 0;

    FW_TRY(fw_read_section(r, &fw_table_sampling, "sampling", map, v, &given));
    out->is_auto = v->design == WORD_AUTO;
    out->design = design_of(v->design);
    out->is_shifted = v->scramble == 1;
    out->n_randomisations = (uint32_t)v->n_randomisations;
    if (!allocation) return FW_OK;
    if (out->design != FW_DESIGN_STRATIFIED)
        return fw_yaml_fail(allocation, r->m, "%s acts with design: stratified alone", ALLOCATION);
    return read_allocation(r, allocation, model, site, out);
}

/* ---- precision --------------------------------------------------------------------------------------------------- */

static fw_status read_points(const fw_reader *r, const fw_node *n, size_t n_points, fw_precision *out)
{
    if (!n) return FW_OK;
    if (n->kind != FW_NODE_LIST || n->n == 0 || n->n > n_points)
        return fw_yaml_fail(n, r->m, "%s: wanted a list of measuring points, as in [1, 6], of 1 .. %zu", POINTS, n_points);
    FW_TRY(fw_alloc(&out->points, n->n, sizeof *out->points, POINTS, r->m));
    for (size_t i = 0; i < n->n; i++) {
        double at;
        FW_TRY(fw_read_quantity(r, n->values[i], POINTS, "1", &at));
        if (!(at >= 1 && at <= (double)n_points && at == floor(at)))
            return fw_yaml_fail(n->values[i], r->m, "%s: there is no measuring point %g, wanted 1 .. %zu", POINTS, at, n_points);
        for (size_t k = 0; k < i; k++)
            if (out->points[k] == (size_t)at) return fw_yaml_fail(n->values[i], r->m, "%s names point %g twice", POINTS, at);
        out->points[out->n_points++] = (size_t)at;
    }
    return FW_OK;
}

fw_status fw_file_read_precision(const fw_reader *r, fw_values *v, size_t n_points, fw_precision *out)
{
    const fw_node *map = fw_yaml_get(r->root, "precision");
    uint64_t       given = 0;

    FW_TRY(fw_read_section(r, &fw_table_precision, "precision", map, v, &given));
    FW_TRY(read_points(r, fw_yaml_get(map, "points"), n_points, out));
    out->half_width = v->half_width;
    out->confidence = v->confidence;
    out->max_realisations = v->max_realisations;
    out->max_failed = v->max_failed;
    if (!fw_read_is_given(&fw_table_precision, given, "max_failed")) {
        out->max_failed = v->max_realisations / 100 > 1 ? v->max_realisations / 100 : 1;
    }
    out->quantity = FW_QUANTITY_MEAN;
    if (strcmp(v->quantity, "mean") == 0) return FW_OK;
    out->quantity = FW_QUANTITY_PERCENTILE;
    bool is_p = v->quantity[0] == 'P' || v->quantity[0] == 'p';
    if (is_p && fw_units_number(v->quantity + 1, &out->percentile, NULL) == FW_OK && out->percentile > 0 &&
        out->percentile < 100) {
        return FW_OK;
    }
    return fw_yaml_fail(fw_yaml_get(map, "quantity"), r->m,
                        "precision.quantity = \"%.40s\": wanted mean, or a percentile between P0 and P100 like P90",
                        v->quantity);
}
