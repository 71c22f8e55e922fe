/* Scene files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "cli/config_check.h"

static void sketch(void **state)
{
    static const char *const sets[] = {"effects=[friction, rotation]", "current.speed=1.5 m/s"};
    fw_scene                 s;
    fw_msg                   m = {""};
    (void)state;

    if (fw_config_scene(&s, GOOD "scene.yaml", 0, NULL, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(s.speed == 2 && s.temperature == -10 && s.duration == 8 && s.model.accuracy == 0.001);
    assert_true(s.model.structure_radius == 3.7 && s.model.stiffness == 2e6 && s.model.slip_damping_ratio == 1);
    assert_int_equal(s.n_floes, 1);
    assert_true(s.floes[0].x == -5.2 && s.floes[0].y == 0.6 && s.floes[0].diameter == 2.5 &&
                s.floes[0].thickness == 0.5);
    assert_true(s.floes[0].vx == 2 && s.floes[0].vy == 0 && s.floes[0].spin == 0);
    assert_int_equal(s.model.effects, FW_EFFECTS_CORE & ~FW_EFFECT_FLOE_CONTACT); /* one floe */
    fw_scene_free(&s);
    if (fw_config_scene(&s, GOOD "scene.yaml", 2, sets, &m) != FW_OK) fail_msg("%s", m.text);
    assert_int_equal(s.model.effects, FW_EFFECT_FRICTION | FW_EFFECT_ROTATION);
    assert_true(s.speed == 1.5);
    fw_scene_free(&s);
}

static char scratch[] = "floewear-scene-XXXXXX";

static fw_status read_floes(fw_scene *s, const char *floes, fw_msg *m)
{
    FILE *f = fopen(scratch, "w");

    assert_non_null(f);
    fprintf(f, "current: {speed: 0 m/s}\nduration: 1 s\nfloes: %s\n", floes);
    assert_int_equal(fclose(f), 0);
    return fw_config_scene(s, scratch, 0, NULL, m);
}

/* A touch is no overlap: 3.7 + 1.25 = 4.95 and 2.5 apart, in decimals that doubles do not hold. */
static void floes_may_touch(void **state)
{
    fw_scene s;
    fw_msg   m = {""};
    (void)state;

    int fd = mkstemp(scratch);
    assert_true(fd >= 0 && close(fd) == 0);
    fw_status status = read_floes(&s,
                                  "[{x: -4.95 m, y: 0 m, diameter: 2.5 m, thickness: 0.5 m}, "
                                  "{x: -7.45 m, y: 0 m, diameter: 2.5 m, thickness: 0.5 m}, "
                                  "{x: -7.45 m, y: 2.5 m, diameter: 2.5 m, thickness: 0.5 m}]",
                                  &m);
    if (status != FW_OK) fail_msg("%s", m.text);
    assert_int_equal(s.n_floes, 3);
    fw_scene_free(&s);
    assert_int_equal(read_floes(&s, "[{x: -4.949999998 m, y: 0 m, diameter: 2.5 m, thickness: 0.5 m}]", &m),
                     FW_E_INPUT);
    assert_int_equal(read_floes(&s, "[]", &m), FW_OK); /* open water */
    assert_int_equal(s.n_floes, 0);
    fw_scene_free(&s);
    /* the largest floe: sqrt(130 * 0.5 - 11) = sqrt(54) */
    assert_int_equal(read_floes(&s, "[{x: 50 m, y: 0 m, diameter: 7.3484692283495345 m, thickness: 0.5 m}]", &m),
                     FW_OK);
    fw_scene_free(&s);
    assert_int_equal(unlink(scratch), 0);
}

/* As many as a file may hold, the last one on the first: refused within a second of processor time. */
static void many_floes(void **state)
{
    enum { N = 21900, ROW = 200, LINE = 64 };
    fw_scene s;
    fw_msg   m = {""};
    size_t   n = 1;
    char    *list = malloc((N + 2) * LINE);
    (void)state;

    assert_non_null(list);
    list[0] = '[';
    for (int i = 0; i <= N; i++) {
        n += (size_t)snprintf(list + n, LINE, "{x: %dm,y: %dm,diameter: 2m,thickness: .5m},", 10 + 2 * (i % N % ROW),
                              2 * (i % N / ROW));
    }
    list[n - 1] = ']';
    list[n] = '\0';
    snprintf(scratch, sizeof scratch, "floewear-scene-XXXXXX");
    int fd = mkstemp(scratch);
    assert_true(fd >= 0 && close(fd) == 0);
    double started = fw_cpu_seconds();
    assert_int_equal(read_floes(&s, list, &m), FW_E_INPUT);
    double took = fw_cpu_seconds() - started;
    assert_non_null(strstr(m.text, "floes[1] and floes[21901] overlap"));
#ifndef __SANITIZE_ADDRESS__
    if (took > 1) fail_msg("%.2f s", took);
#else
    (void)took;
#endif
    assert_int_equal(unlink(scratch), 0);
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sketch), cmocka_unit_test(floes_may_touch),
                                       cmocka_unit_test(many_floes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
