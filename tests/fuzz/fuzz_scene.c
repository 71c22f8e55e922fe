/* Scene files and their --set: whatever the bytes, a refusal that says why, or a scene that can be run. */
#include <math.h>

#include "cli/config.h"
#include "fuzz/config_input.h"
#include "fuzz/fuzz.h"
#include "realisation/facts.h"

static const char *const files[] = {"made.yaml", "table.csv", NULL};

static bool is_finite_floe(const fw_floe *f)
{
    return isfinite(f->x) && isfinite(f->y) && isfinite(f->vx) && isfinite(f->vy) && isfinite(f->spin) &&
           f->diameter > 0 && isfinite(f->diameter) && f->thickness > 0 && isfinite(f->thickness);
}

static void check_accepted(const fw_scene *s)
{
    fw_msg m = {""};
    FUZZ_LAW(fw_model_check(&s->model, &m) == FW_OK, "%s", m.text);
    FUZZ_LAW(s->speed >= 0 && isfinite(s->speed) && s->duration > 0 && isfinite(s->duration), "speed %g, duration %g",
             s->speed, s->duration);
    FUZZ_LAW(s->temperature < 0 && isfinite(s->temperature), "temperature %g", s->temperature);
    FUZZ_LAW(s->wind_speed >= 0 && isfinite(s->wind_speed) && isfinite(s->wind_angle) && isfinite(s->tide_phase), "wind %g m/s at %g, phase %g",
             s->wind_speed, s->wind_angle, s->tide_phase);
    fw_scene_facts facts;
    fw_facts_scene(s, &facts);
    fuzz_check_effects(&s->model, &facts);
    for (size_t i = 0; i < s->n_floes; i++) {
        const fw_floe *f = &s->floes[i];
        FUZZ_LAW(is_finite_floe(f), "floe %zu", i + 1);
        FUZZ_LAW(hypot(f->x, f->y) >= s->model.structure_radius + f->diameter / 2 - 1e-6, "floe %zu in the structure",
                 i + 1);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_config in;
    fw_scene    s;
    fw_msg      m = {""};
    char        path[FUZZ_PATH];

    fuzz_enter_folder(files);
    fuzz_path(path, "made.yaml");
    fuzz_config_take(&in, data, size);
    fuzz_save(path, in.text, in.n_text);
    fuzz_save_table(&in);

    double    started = fw_cpu_seconds();
    fw_status status = fw_config_scene(&s, path, in.n_sets, in.set_list, &m);
    if (status == FW_OK) {
        check_accepted(&s);
        fw_scene_free(&s);
    } else {
        fuzz_check_config_refusal(&in, status, &m, "made.yaml", started);
    }
    fuzz_config_free(&in);
    return 0;
}
