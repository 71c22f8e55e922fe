/* One window of 40 % ice, plain, with ice that crushes or in a weather with every further effect, and one lone hit; says what the watch-dogs found. Linked with one mutated source of the library before it. */
#include <stdio.h>
#include <string.h>

#include "floewear/realisation.h"

static fw_status lone_hit(char *cause, size_t size)
{
    fw_floe         floe = {.x = -4.8, .y = 2, .diameter = 2.5, .thickness = 0.5, .vx = 2};
    fw_scene        scene = {.speed = 2, .temperature = -10, .duration = 5, .n_floes = 1, .floes = &floe};
    fw_scene_result out;
    fw_msg          m = {""};
    fw_model_defaults(&scene.model);
    fw_status s = fw_scene_run(&scene, NULL, NULL, &out, &m);
    snprintf(cause, size, "%s", m.text);
    fw_scene_result_free(&out);
    return s;
}

static fw_status window(const char *what, char *cause, size_t size)
{
    fw_model    model;
    fw_scenario scenario = {.seed = 1, .id = 1, .concentration = 0.4, .speed = 2};
    fw_record   r;
    fw_msg      m = {""};
    fw_model_defaults(&model);
    model.window = 120, model.warm_up = 10, model.max_evaluations = 1e7; /* a hundred times what it takes */
    if (strcmp(what, "crush") == 0) model.effects |= FW_EFFECT_CRUSH_CONTACT;
    if (strcmp(what, "weather") == 0) {
        model.effects |= FW_EFFECT_SKIN_DRAG | FW_EFFECT_WIND | FW_EFFECT_ADDED_MASS | FW_EFFECT_TIDE | FW_EFFECT_DEFLECTED_FLOW;
        model.tide = (fw_tide){.period = 600, .minor_ratio = 0.5};
        scenario.wind_speed = 20, scenario.wind_angle = 1, scenario.tide_phase = 0.3;
    }
    fw_status s = fw_realise(&model, &scenario, NULL, &r, &m);
    if (s != FW_OK) {
        snprintf(cause, size, "%s", m.text);
        return s;
    }
    s = r.status;
    snprintf(cause, size, "%s", r.cause);
    fw_record_free(&r);
    return s;
}

int main(int argc, char **argv)
{
    char      cause[1024] = "";
    fw_status s = argc > 1 && strcmp(argv[1], "hit") == 0 ? lone_hit(cause, sizeof cause) : window(argc > 1 ? argv[1] : "", cause, sizeof cause);
    printf("%s %s\n", fw_status_name(s), cause);
    return s == FW_OK ? 0 : 1;
}
