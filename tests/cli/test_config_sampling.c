/* How scenarios are drawn, and for which points there have to be enough of them, as campaign files say it. Bad ones: tests/cli/bad. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>

#include "cli/config_check.h"

#define SITE "ice: {temperature: -10 degC, concentration: 40 %}\ncurrent: {speed: {weibull: {scale: 0.4 m/s, shape: 1.6, max: 2 m/s}}}\n"

static fw_campaign read_with(const char *lines)
{
    char        text[1024];
    fw_campaign c;
    fw_msg      m;
    snprintf(text, sizeof text, "%s%s\n", SITE, lines);
    if (read_campaign_text(&c, text, &m) != FW_OK) fail_msg("%s: %s", lines, m.text);
    return c;
}

static void designs(void **state)
{
    static const struct {
        const char *text;
        fw_design   design;
        bool        is_auto, is_shifted;
        uint32_t    n_randomisations;
    } rows[] = {
        {"", FW_DESIGN_PLAIN, true, false, 32}, /* left to a pilot; plain without one */
        {"sampling: {design: auto}", FW_DESIGN_PLAIN, true, false, 32},
        {"sampling: {design: plain}", FW_DESIGN_PLAIN, false, false, 32},
        {"sampling: {design: stratified}", FW_DESIGN_STRATIFIED, false, false, 32},
        {"sampling: {design: latin_hypercube, randomisations: 16}", FW_DESIGN_LATIN, false, false, 16},
        {"sampling: {design: sobol, randomisations: 1024}", FW_DESIGN_SOBOL, false, false, 1024},
        {"sampling: {design: sobol, scramble: digital_shift}", FW_DESIGN_SOBOL, false, true, 32},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fw_campaign        c = read_with(rows[i].text);
        const fw_sampling *a = &c.sampling;
        if (a->design != rows[i].design || a->is_auto != rows[i].is_auto || a->is_shifted != rows[i].is_shifted || a->n_allocation ||
            a->n_randomisations != rows[i].n_randomisations)
            fail_msg("%s: %d %d %d %u", rows[i].text, a->design, a->is_auto, a->is_shifted, (unsigned)a->n_randomisations);
        fw_campaign_free(&c);
    }
}

/* Shares are divided by their sum, here 16; per cent are shares too. */
static void allocations(void **state)
{
    fw_campaign c = read_with("sampling: {design: stratified, allocation: [1, 1, 1, 1, 2, 2, 4, 4]}");
    static const double share[8] = {1, 1, 1, 1, 2, 2, 4, 4};
    (void)state;
    assert_int_equal(c.sampling.n_allocation, 8);
    for (size_t i = 0; i < 8; i++) assert_true(c.sampling.allocation[i] == share[i] / 16);
    fw_campaign_free(&c);
    c = read_with("sampling: {design: stratified, allocation: [10 %, 10 %, 10 %, 10 %, 10 %, 10 %, 10 %, 30 %]}");
    assert_true(fabs(c.sampling.allocation[7] - 0.3) < 1e-15 && fabs(c.sampling.allocation[0] - 0.1) < 1e-15);
    fw_campaign_free(&c);
}

/* Plain sampling's settings are those of campaigns from before there was another; every other design, number, scramble and allocation has a hash of its
 * own. */
static void settings_name_the_design(void **state)
{
    static const char *const plain[] = {"sampling: {}", "sampling: {design: plain}", "sampling: {design: auto}",
                                        "sampling: {design: plain, randomisations: 64, scramble: digital_shift}", "precision: {points: [1]}"};
    static const char *const other[] = {
        "sampling: {design: stratified}",
        "sampling: {design: stratified, randomisations: 16}",
        "sampling: {design: stratified, allocation: [1, 1, 1, 1, 1, 1, 1, 1]}",
        "sampling: {design: stratified, allocation: [1, 1, 1, 1, 1, 1, 1, 2]}",
        "sampling: {design: latin_hypercube}",
        "sampling: {design: sobol}",
        "sampling: {design: sobol, scramble: digital_shift}",
        "sampling: {design: sobol, randomisations: 64}",
    };
    enum { N_PLAIN = sizeof plain / sizeof plain[0], N_OTHER = sizeof other / sizeof other[0] };
    fw_campaign base = read_with("");
    uint64_t    hashes[N_OTHER + 1] = {base.hash};
    (void)state;
    assert_null(strstr(base.settings, "sampling"));
    for (size_t i = 0; i < N_PLAIN; i++) {
        fw_campaign c = read_with(plain[i]);
        assert_string_equal(c.settings, base.settings);
        assert_true(c.hash == base.hash);
        fw_campaign_free(&c);
    }
    for (size_t i = 0; i < N_OTHER; i++) {
        fw_campaign c = read_with(other[i]);
        assert_non_null(strstr(c.settings, "\nsampling.design = "));
        for (size_t k = 0; k <= i; k++)
            if (hashes[k] == c.hash) fail_msg("%s: the hash of another design", other[i]);
        hashes[i + 1] = c.hash;
        fw_campaign_free(&c);
    }
    fw_campaign c = read_with("sampling: {design: sobol, scramble: digital_shift}");
    assert_non_null(strstr(c.settings, "sampling.design = sobol\nsampling.randomisations = 32\nsampling.scramble = digital_shift\n"));
    fw_campaign_free(&c);
    /* the same shares, written otherwise */
    fw_campaign a = read_with("sampling: {design: stratified, allocation: [1, 1, 1, 1, 1, 1, 1, 1]}");
    fw_campaign b = read_with("sampling: {design: stratified, allocation: [2, 2, 2, 2, 2, 2, 2, 2]}");
    assert_true(a.hash == b.hash);
    fw_campaign_free(&a);
    fw_campaign_free(&b);
    fw_campaign_free(&base);
}

static void sets(void **state)
{
    static const char *const set[] = {"sampling.design=sobol", "sampling.randomisations=16", "precision.points=[3, 1]"};
    fw_campaign              c, d;
    fw_msg                   m = {""};
    (void)state;
    assert_int_equal(fw_config_campaign(&c, GOOD "minimal.yaml", 3, set, -1, &m), FW_OK);
    assert_true(c.sampling.design == FW_DESIGN_SOBOL && c.sampling.n_randomisations == 16 && !c.sampling.is_auto);
    assert_true(c.precision.n_points == 2 && c.precision.points[0] == 3 && c.precision.points[1] == 1);
    /* text and sets give the same campaign again, as workers get it */
    assert_int_equal(fw_config_campaign_text(&d, GOOD "minimal.yaml", c.text, strlen(c.text), c.n_sets, (const char *const *)c.sets, -1, &m), FW_OK);
    assert_true(d.hash == c.hash && d.sampling.design == FW_DESIGN_SOBOL);
    fw_campaign_free(&c);
    fw_campaign_free(&d);
    static const char *const bad[] = {"sampling.design=sobel"};
    assert_int_equal(fw_config_campaign(&c, GOOD "minimal.yaml", 1, bad, -1, &m), FW_E_INPUT);
    assert_non_null(strstr(m.text, "--set sampling.design=sobel"));
}

/* A joint table's strata are its cells: two rows times the two thickness mixes, of which the file says nothing. */
static void joint_table(void **state)
{
    static const char *const good[] = {"sampling={design: stratified, allocation: [1, 1, 3, 3]}"}, *const bad[] = {"sampling={design: stratified, allocation: [1, 1, 1]}"};
    fw_campaign              c;
    fw_msg                   m = {""};
    (void)state;
    if (fw_config_campaign(&c, GOOD "joint.yaml", 1, good, -1, &m) != FW_OK) fail_msg("%s", m.text);
    assert_int_equal(c.site.n_cells, 4);
    assert_true(c.sampling.n_allocation == 4 && c.sampling.allocation[0] == 0.125 && c.sampling.allocation[3] == 0.375);
    fw_campaign_free(&c);
    assert_int_equal(fw_config_campaign(&c, GOOD "joint.yaml", 1, bad, -1, &m), FW_E_INPUT);
    assert_non_null(strstr(m.text, "3 shares; this site has 4 strata"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(designs), cmocka_unit_test(allocations), cmocka_unit_test(settings_name_the_design),
        cmocka_unit_test(sets),    cmocka_unit_test(joint_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
