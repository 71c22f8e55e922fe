/* The report's four forms of one answer: CSV and JSON carry the same bits, an end that does not exist is named as
 * such. */
#include "cli/report_table.h"

#include <stdlib.h>
#include <string.h>

#include "study/made_up.h"

static void write_to_text(void (*print)(FILE *, const fw_campaign *, const fw_answer *), const fw_campaign *c,
                          const fw_answer *a, char **text)
{
    size_t size;
    FILE  *to = open_memstream(text, &size);
    assert_non_null(to);
    print(to, c, a);
    fclose(to);
}

/* The number after the nth occurrence of "key": in a JSON text. */
static double json_number(const char *json, const char *key, int nth)
{
    const char *at = json;
    for (int i = 0; i <= nth && at; i++) at = strstr(i ? at + 1 : at, key);
    assert_non_null(at);
    return strtod(at + strlen(key), NULL);
}

static void all_forms_say_the_same(void **state)
{
    (void)state;
    double            bearings[24];
    fw_campaign       c = made_up_campaign(bearings);
    made_up           s = {.campaign = &c, .sigma = 1};
    fw_answer_source  source = made_up_source(&s, 100);
    const size_t      points[] = {13, 6};
    fw_answer_options o = {.n_points = 2, .points = points};
    fw_answer         a;
    char             *json, *csv, *table, *together, text[128];
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    write_to_text(fw_report_print_json, &c, &a, &json);
    write_to_text(fw_report_print_csv, &c, &a, &csv);
    write_to_text(fw_report_print_table, &c, &a, &table);
    write_to_text(fw_report_print_simultaneous, &c, &a, &together);

    assert_true(json_number(json, "\"n\": ", 0) == 100 && json_number(json, "\"failed\": ", 0) == 0);
    for (int i = 0; i < 8; i++) {
        assert_true(json_number(json, "\"depth_mm\": ", i) == a.percentiles[i].depth_mm);
        assert_true(json_number(json, "\"low_mm\": ", i) == a.percentiles[i].low_mm);
        assert_true(json_number(json, "\"coverage\": ", i) == a.percentiles[i].coverage);
        assert_true(json_number(json, "\"band_low_mm\": ", i) == a.percentiles[i].band_low_mm);
        assert_true(json_number(json, "\"n_effective\": ", i) == 100);
    }
    assert_non_null(strstr(json, "\"high_mm\": null")); /* P99 of 100 */
    assert_non_null(strstr(json, "\"independent windows\""));
    const char *names[] = {"\"campaign\"", "\"percentiles\"",  "\"points\"",       "\"service_life\"",
                           "\"ledger\"",   "\"point\"",        "\"bearing_deg\"",  "\"percentile\"",
                           "\"mean_mm\"",  "\"path_km\"",      "\"impact_share\"", "\"row\"",
                           "\"amount\"",   "\"shrinks_with\"", "\"cost_to_halve\"", "\"swept_strip\"", "\"ring_ratio\": null"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) assert_non_null(strstr(json, names[i]));

    char *line = strchr(csv, '\n') + 1; /* after the heading: point,bearing,percentile,depth,... */
    for (int i = 0; i < 8; i++) {
        char *end;
        assert_true(strtod(line, &end) == (double)a.percentiles[i].point);
        assert_true(strtod(end + 1, &end) == a.percentiles[i].bearing_deg);
        assert_true(strtod(end + 1, &end) == a.percentiles[i].percentile);
        assert_true(strtod(end + 1, &end) == a.percentiles[i].depth_mm);
        line = strchr(line, '\n') + 1;
    }
    assert_int_equal(*line, 0); /* eight lines and no more */
    assert_non_null(strstr(table, "none]"));
    snprintf(text, sizeof text, "all 2 points together (95 %%): P90 at the governing point [%.3g, %.3g] mm\n", a.percentiles[1].band_low_mm,
             a.percentiles[1].band_high_mm);
    assert_non_null(strstr(table, text));
    assert_non_null(strstr(together, text));
    assert_null(strstr(table, "all points together]"));
    assert_non_null(strstr(together, "all points together]"));
    assert_non_null(strstr(table, "order statistics"));
    assert_non_null(strstr(table, "governing: point 13"));
    assert_non_null(strstr(table, "20000 independent windows"));
    assert_non_null(strstr(table, "not modelled: level-ice crushing"));
    assert_non_null(strstr(table, "sanity check: no swept strip: structure radius")); /* made up, without one */
    free(json);
    free(csv);
    free(table);
    free(together);
    fw_answer_free(&a);
}

static void swept_strip_in_all_forms(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer_source source = made_up_source(&s, 40);
    fw_sanity_row    rows[24] = {{0}};
    fw_answer        a;
    char            *json, *table;
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    for (size_t i = 0; i < 24; i++) rows[i] = (fw_sanity_row){.point = i + 1, .strip_mm = 0.5, .law_mm = 0.25, .ratio = i == 23 ? NAN : 1.75};
    a.n_swept = 24, a.swept = rows, a.swept_ring = (fw_sanity_ring){1.75, 1.875, 0.5};
    write_to_text(fw_report_print_json, &c, &a, &json);
    write_to_text(fw_report_print_table, &c, &a, &table);
    assert_true(json_number(json, "\"ring_ratio\": ", 0) == 1.75 && json_number(json, "\"usual_ratio\": ", 0) == 1.875);
    assert_true(json_number(json, "\"law_over_sample\": ", 0) == 0.5 && json_number(json, "\"strip_mm\": ", 23) == 0.5);
    assert_true(json_number(json, "\"law_mm\": ", 5) == 0.25 && json_number(json, "\"ratio\": ", 22) == 1.75);
    assert_non_null(strstr(json, "\"ratio\": null"));
    assert_non_null(strstr(table, "1.75 times as much as the swept strip"));
    free(json);
    free(table);
    a.swept = NULL, a.n_swept = 0;
    fw_answer_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_forms_say_the_same), cmocka_unit_test(swept_strip_in_all_forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
