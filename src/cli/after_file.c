#include "cli/after_file.h"

#include <math.h>
#include <string.h>

#include "cli/distribution_file.h"

/* Metres about the mean: beyond every tide and surge, and surely a wrong unit or datum. */
static const double FARTHEST = 50;

/* A median farther off than this is a rate (mm/km is a number to a unit parser) or a wrong parameter, no factor on a rate. */
static const double MOST_SCATTER = 1000;

static const char *const KEYS[][2] = {{"water", "level"}, {"abrasion", "scatter"}};

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

static fw_status read_scatter(const fw_reader *r, const fw_node *n, fw_after *out)
{
    if (!n) return FW_OK;
    FW_TRY(fw_read_distribution(r, n, "abrasion.scatter", "1", &out->law_scatter));
    out->has_law_scatter = true;
    double low = fw_distribution_min(&out->law_scatter), median = fw_distribution_quantile(&out->law_scatter, 0.5);
    if (isinf(low)) return fw_yaml_fail(n, r->m, "abrasion.scatter has no lower end, wanted a factor of at least 0 (give min)");
    if (!(low >= 0)) return fw_yaml_fail(n, r->m, "abrasion.scatter reaches down to %g, wanted a factor of at least 0", low);
    if (!(median >= 1 / MOST_SCATTER && median <= MOST_SCATTER)) {
        return fw_yaml_fail(n, r->m, "abrasion.scatter has the median %g, wanted a factor on the law's rate, %g to %g", median, 1 / MOST_SCATTER,
                            MOST_SCATTER);
    }
    return FW_OK;
}

fw_status fw_file_read_after(const fw_reader *r, const fw_model *model, fw_after *out)
{
    memset(out, 0, sizeof *out);
    fw_status status = read_level(r, find(r, 0), model, out);
    if (status == FW_OK) status = read_scatter(r, find(r, 1), out);
    if (status != FW_OK) {
        fw_distribution_free(&out->water_level);
        fw_distribution_free(&out->law_scatter);
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
