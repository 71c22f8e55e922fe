#include "realisation/floes.h"

#include "field/sizes.h"

fw_status fw_floes_of_mix(const fw_model *model, size_t mix, size_t n_at, const double *at, fw_floe_mix *out, double *diameter, fw_msg *m)
{
    fw_sizes sizes;
    FW_TRY(fw_sizes_init(&sizes, &model->mixes[mix], model->size_law, model->size_a, model->size_b, m));
    *out = (fw_floe_mix){.n = sizes.n, .mean_diameter = sizes.mean_diameter, .mean_area = sizes.mean_area};
    for (size_t k = 0; k < sizes.n; k++) {
        out->thickness[k] = sizes.classes[k].thickness, out->share[k] = sizes.classes[k].share;
        for (size_t j = 0; j < n_at; j++) diameter[k * n_at + j] = fw_sizes_quantile(&sizes, k, at[j]);
    }
    return FW_OK;
}
