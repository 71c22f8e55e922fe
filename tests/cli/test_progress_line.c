#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "cli/progress_line.h"

static void test_format(void **state)
{
    fw_progress_line l = {.is_terminal = true};
    fw_progress      p = {.done = 12, .failed = 1, .total = 400, .elapsed_s = 30, .rate_per_s = 0.4, .eta_s = 970};
    char             text[200], small[20];

    (void)state;
    fw_progress_line_format(&l, &p, text, sizeof text);
    assert_string_equal(text, "12/400 done, 1 failed, 24/min, 16 min to go"); /* 0.4/s = 24/min, 970 s = 16.2 min */
    snprintf(l.estimate, sizeof l.estimate, "P90 2.31e-04 mm +- 12 %%, point 5");
    l.is_terminal = false;
    fw_progress_line_format(&l, &p, text, sizeof text);
    assert_string_equal(text, "30 s: 12/400 done, 1 failed, 24/min, 16 min to go; P90 2.31e-04 mm +- 12 %, point 5");
    fw_progress_line_format(&l, &p, small, sizeof small); /* a narrow terminal cuts it */
    assert_int_equal(strlen(small), sizeof small - 1);
    l = (fw_progress_line){.is_terminal = true};
    p = (fw_progress){.total = 3, .eta_s = INFINITY}; /* nothing done yet: no pace to speak of */
    fw_progress_line_format(&l, &p, text, sizeof text);
    assert_string_equal(text, "0/3 done, 0 failed");
}

static void show_five_minutes(fw_progress_line *l)
{
    for (int i = 0; i <= 1500; i++) fw_progress_line_show(l, &(fw_progress){.total = 9, .elapsed_s = 0.2 * i});
}

static int lines_in(FILE *f)
{
    int n = 0, c;

    rewind(f);
    while ((c = fgetc(f)) != EOF) n += c == '\n';
    return n;
}

/* A log gets a line when there is an estimate (from 10 s on), else at 50 s, then one a minute. */
static void test_log_lines(void **state)
{
    for (int has_estimate = 0; has_estimate < 2; has_estimate++) {
        FILE            *f = tmpfile();
        fw_progress_line l;

        assert_non_null(f);
        fw_progress_line_start(&l, f, false);
        assert_false(l.is_terminal);
        if (has_estimate) snprintf(l.estimate, sizeof l.estimate, "P90");
        show_five_minutes(&l);
        fw_progress_line_end(&l);
        /* 10, 70, 130, 190, 250 s against 50, 110, 170, 230, 290 s */
        assert_int_equal(lines_in(f), 5);
        assert_true(has_estimate ? l.last_s < 251.0 : l.last_s > 289.0);
        fclose(f);
    }
    (void)state;
}

static void test_quiet(void **state)
{
    FILE            *f = tmpfile();
    fw_progress_line l;

    (void)state;
    assert_non_null(f);
    fw_progress_line_start(&l, f, true);
    show_five_minutes(&l);
    fw_progress_line_end(&l);
    assert_int_equal(ftell(f), 0);
    fclose(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_format),
        cmocka_unit_test(test_log_lines),
        cmocka_unit_test(test_quiet),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
