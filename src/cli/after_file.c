#include "cli/after_file.h"

#include <math.h>
#include <string.h>

#include "cli/distribution_file.h"
#include "cli/tables.h"

/* Metres about the mean: beyond every tide and surge, and surely a wrong unit or datum. */
static const double FARTHEST = 50;

/* A median farther off than this is a rate (mm/km is a number to a unit parser) or a wrong parameter, no factor on a rate. */
static const double MOST_SCATTER = 1000;

static const char *const KEYS[][2] = {{"water", "level"}, {"abrasion", "scatter"}, {"abrasion", "uncertainty"}};

static const fw_node *find(const fw_reader *r, size_t i) { return fw_yaml_get(fw_yaml_get(r->root, KEYS[i][0]), KEYS[i][1]); }

static fw_status read_level(const fw_reader *r, const fw_node *n, const fw_model *model, fw_after *out)
{
    if (!n) return FW_OK;
    FW_TRY(fw_read_distribution(r, n, "water.level", "m", &out->water_level));
    out->has_water_level = true;
    if (!(model->ice_density < model->water_density)) {
        return fw_yaml_fail(n, r->m, "water.level: ice of %g kg/m3 does not float in water of %g kg/m3, so that it touches at no height",
                            model->ice_density, model->water_density);
    }
    double low = fw_distribution_quantile(&out->water_level, 1e-3), high = fw_distribution_quantile(&out->water_level, 1 - 1e-3);
    if (!(low >= -FARTHEST && high <= FARTHEST)) {
        return fw_yaml_fail(n, r->m, "water.level reaches from %g m to %g m, wanted at most %g m from the mean level", low, high, FARTHEST);
    }
    return FW_OK;
}

static fw_status read_factor(const fw_reader *r, const fw_node *n, const char *path, bool *is_given, fw_distribution *out)
{
    if (!n) return FW_OK;
    FW_TRY(fw_read_distribution(r, n, path, "1", out));
    *is_given = true;
    double low = fw_distribution_min(out), median = fw_distribution_quantile(out, 0.5);
    if (isinf(low)) return fw_yaml_fail(n, r->m, "%s has no lower end, wanted a factor of at least 0 (give min)", path);
    if (!(low >= 0)) return fw_yaml_fail(n, r->m, "%s reaches down to %g, wanted a factor of at least 0", path, low);
    if (!(median >= 1 / MOST_SCATTER && median <= MOST_SCATTER)) {
        return fw_yaml_fail(n, r->m, "%s has the median %g, wanted a factor on the law's rate, %g to %g", path, median, 1 / MOST_SCATTER,
                            MOST_SCATTER);
    }
    return FW_OK;
}

/* Wear loads of other exponents are there only where the campaign has laws with them. */
static fw_status read_exponent(const fw_reader *r, const fw_node *n, const fw_model *model, fw_after *out)
{
    if (!n) return FW_OK;
    FW_TRY(fw_read_distribution(r, n, "abrasion.uncertainty.exponent", "1", &out->law_exponent));
    out->has_law_exponent = true;
    double low = fw_distribution_min(&out->law_exponent), high = fw_distribution_max(&out->law_exponent), least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < model->n_laws; i++) {
        if (model->laws[i].uses_temperature != model->laws[0].uses_temperature) continue;
        least = fmin(least, model->laws[i].exponent), most = fmax(most, model->laws[i].exponent);
    }
    if (low >= least && high <= most) return FW_OK;
    return fw_yaml_fail(n, r->m,
                        "abrasion.uncertainty.exponent reaches from %g to %g%s; the laws of abrasion.laws with the temperature of the first one have "
                        "exponents from %g to %g: wanted laws on either side, like {power: {coefficient: .., exponent: .., uses_temperature: %s}}",
                        low, high, isinf(low) || isinf(high) ? " (give min and max)" : "", least, most,
                        model->laws[0].uses_temperature ? "on" : "off");
}

static fw_status read_uncertainty(const fw_reader *r, const fw_node *map, const fw_model *model, fw_after *out)
{
    if (!map) return FW_OK;
    FW_TRY(fw_read_section(r, &fw_table_uncertainty, "abrasion.uncertainty", map, NULL, NULL));
    FW_TRY(read_factor(r, fw_yaml_get(map, "coefficient"), "abrasion.uncertainty.coefficient", &out->has_law_coefficient, &out->law_coefficient));
    return read_exponent(r, fw_yaml_get(map, "exponent"), model, out);
}

fw_status fw_file_read_after(const fw_reader *r, const fw_model *model, fw_after *out)
{
    memset(out, 0, sizeof *out);
    fw_status status = read_level(r, find(r, 0), model, out);
    if (status == FW_OK) status = read_factor(r, find(r, 1), "abrasion.scatter", &out->has_law_scatter, &out->law_scatter);
    if (status == FW_OK) status = read_uncertainty(r, find(r, 2), model, out);
    if (status != FW_OK) {
        fw_distribution_free(&out->water_level);
        fw_distribution_free(&out->law_scatter);
        fw_distribution_free(&out->law_coefficient);
        fw_distribution_free(&out->law_exponent);
    }
    return status;
}

fw_status fw_file_refuse_after(const fw_reader *r)
{
    for (size_t i = 0; i < sizeof KEYS / sizeof KEYS[0]; i++) {
        const fw_node *n = find(r, i);
        if (n)
            return fw_yaml_fail(n, r->m, "%s.%s: acts on the answers of a campaign, after its run; a scene has none", KEYS[i][0], KEYS[i][1]);
    }
    return FW_OK;
}
