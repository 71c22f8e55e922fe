#include "floewear/campaign.h"

#include <stdlib.h>
#include <string.h>

void fw_campaign_free(fw_campaign *c)
{
    if (!c) return;
    free(c->text);
    free(c->settings);
    free(c->points.bearing);
    free(c->not_applied);
    free(c->sampling.allocation);
    free(c->precision.points);
    for (size_t i = 0; i < c->n_sets; i++) free(c->sets[i]);
    free(c->sets);
    fw_site_free(&c->site);
    free(c->model.tide.rows);
    fw_distribution_free(&c->after.water_level);
    fw_distribution_free(&c->after.law_scatter);
    fw_distribution_free(&c->after.law_coefficient);
    fw_distribution_free(&c->after.law_exponent);
    free(c->service.table);
    memset(c, 0, sizeof *c);
}
