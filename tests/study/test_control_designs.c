/* Control variates under designs in randomisations: estimates and intervals as in test_control.c. */
#include "study/repeats.h"

/* What a design has gained already cannot be gained again: Sobol points know P50 twice as well as plain ones to begin with. */
static void designs(void **state)
{
    enum { REPEATS = 500, FEWER = 100, N = 256 };
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    (void)state;
    for (int way = 1; way < SITE_WAYS; way++) {
        repeats with = repeat(&c, (site_way)way, N, &SITE, REPEATS), without = repeat(&c, (site_way)way, N, NULL, FEWER);
        is_unbiased(&with, SITE_WAY[way], spread_over(&without, MEAN));
        is_unbiased(&without, SITE_WAY[way], 0);
        is_covered(&with, SITE_WAY[way]);
        is_narrower(&with, &without, SITE_WAY[way], 0.65);
    }
    fw_site_free(&c.site);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(designs)};
    return cmocka_run_group_tests(tests, find_truth, NULL);
}
