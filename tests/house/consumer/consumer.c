/* One floe against the structure, through the public headers alone. Ends with 0 when the answer keeps the laws that hold
 * whatever the numerics: the floe hits, wears where it hits, and the wear of two identical runs has the same bits. */
#include <floewear/realisation.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int run(fw_scene_result *out)
{
    static fw_floe floe = {.x = -5.2, .y = 0.6, .diameter = 2.5, .thickness = 0.5, .vx = 2.0};
    fw_scene scene = {.speed = 2.0, .temperature = -10.0, .duration = 4.0, .n_floes = 1, .floes = &floe};
    fw_msg msg = {{0}};

    fw_model_defaults(&scene.model);
    const fw_status status = fw_scene_run(&scene, NULL, NULL, out, &msg);
    if (status != FW_OK) fprintf(stderr, "%s: %s\n", fw_status_name(status), msg.text);
    return status == FW_OK;
}

int main(void)
{
    fw_scene_result one = {0}, two = {0};
    if (!run(&one) || !run(&two)) return 1;

    const double depth = one.depth_along_contact;
    printf("depth along the contact %.6e mm, path %.6e m, peak force %.4e N\n", depth, one.path, one.record.peak_force);
    const int hits = one.record.peak_force > 0.0 && isfinite(depth) && depth > 0.0 && one.path > 0.0;
    const int same = memcmp(&depth, &two.depth_along_contact, sizeof depth) == 0;
    fw_scene_result_free(&one);
    fw_scene_result_free(&two);
    return hits && same ? 0 : 1;
}
