/* Windows and a hit with no optional effect, for their instructions to be counted. One argument: 1 or 2, how often: the difference is without what a program
 * does before and after. */
#include <stdio.h>
#include <stdlib.h>

#include "floewear/realisation.h"

static int window(double concentration, double length, uint64_t id)
{
    fw_model    model;
    fw_scenario scenario = {.seed = 1, .id = id, .concentration = concentration, .speed = 2};
    fw_record   r;
    fw_msg      m = {""};
    fw_model_defaults(&model);
    model.window = length;
    if (fw_realise(&model, &scenario, NULL, &r, &m) != FW_OK) {
        fprintf(stderr, "%s\n", m.text);
        return 1;
    }
    int is_bad = r.status != FW_OK;
    if (is_bad) fprintf(stderr, "%s\n", r.cause);
    printf("%g %% ice: %.17g force evaluations, impulse %.17g N s\n", 100 * concentration, r.force_evaluations, r.normal_impulse);
    fw_record_free(&r);
    return is_bad;
}

int main(int argc, char **argv)
{
    int n = argc > 1 ? atoi(argv[1]) : 1, is_bad = 0;
    for (int i = 0; i < n; i++) {
        is_bad |= window(0.1, 1200, 1);
        is_bad |= window(0.4, 300, 2);
        is_bad |= window(0.6, 60, 3);
    }
    return is_bad;
}
