#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "base/version.h"

static void version_and_revision_have_their_form(void **state)
{
    int  major, minor, patch;
    char rest;
    (void)state;

    assert_int_equal(sscanf(fw_version(), "%d.%d.%d%c", &major, &minor, &patch, &rest), 3);
    const char *r = fw_git_revision();
    if (strcmp(r, "unknown") != 0) assert_true(strspn(r, "0123456789abcdef") >= 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(version_and_revision_have_their_form)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
