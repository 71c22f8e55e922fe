/* Random damage to good files: whatever comes out, a status and a message, no crash and no leak (run with the
 * sanitizers on). Damage: bytes changed, cut, doubled, swapped in from other files, words and numbers replaced. The
 * numbers come from Philox with a fixed seed, so a failure repeats; FLOEWEAR_FUZZ gives another number of rounds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/random.h"
#include "cli/config_check.h"

enum { MAX_TEXT = 8192, ROUNDS = 300 };

static const char *const FILES[] = {GOOD "sketch.yaml", GOOD "minimal.yaml", GOOD "joint.yaml", GOOD "scene.yaml"};
static const char *const WORDS[] = {"[",        "]",
                                    "{",        "}",
                                    ": ",       "- ",
                                    "\n",       "'",
                                    "\"",       "&a ",
                                    "*a ",      "!!x ",
                                    "nan",      "1e999",
                                    "-",        "0 m",
                                    "m",        " %",
                                    "~",        "null",
                                    "|\n",      "? ",
                                    ",",        "#",
                                    "--- ",     "\t",
                                    "\xc3\xa4", "\xff",
                                    "auto",     "{uniform: [1, 2]}",
                                    "values",   "99999999999999999999",
                                    "1e308 km", "\\",
                                    "=",        "."};

static uint32_t below(fw_random *r, size_t n) { return (uint32_t)(fw_random_u32(r) % (n ? n : 1)); }

static size_t load(const char *path, char *text)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    size_t n = fread(text, 1, MAX_TEXT / 2, f);
    fclose(f);
    return n;
}

static size_t damage(fw_random *r, char *text, size_t n)
{
    size_t at = below(r, n), length = 1 + below(r, 12), room = MAX_TEXT - n;

    if (at + length > n) length = n - at;
    switch (below(r, 6)) {
    case 0: /* one byte */
        if (n) text[at] = (char)fw_random_u32(r);
        return n;
    case 1: /* cut a piece */ memmove(text + at, text + at + length, n - at - length); return n - length;
    case 2: /* cut the end */ return below(r, 4) ? n : at;
    case 3: /* double a piece elsewhere */
        if (length < room && n) {
            char   piece[16];
            size_t to = below(r, n);
            memcpy(piece, text + at, length);
            memmove(text + to + length, text + to, n - to);
            memcpy(text + to, piece, length);
            return n + length;
        }
        return n;
    default: { /* put a word in */
        const char *word = WORDS[below(r, sizeof WORDS / sizeof WORDS[0])];
        size_t      k = strlen(word);
        if (k >= room) return n;
        memmove(text + at + k, text + at, n - at);
        memcpy(text + at, word, k);
        return n + k;
    }
    }
}

static void damaged_files(void **state)
{
    static char scratch[] = "floewear-fuzz-XXXXXX";
    const char *asked = getenv("FLOEWEAR_FUZZ");
    long        rounds = asked ? atol(asked) : ROUNDS, n_read = 0;
    (void)state;

    int fd = mkstemp(scratch);
    assert_true(fd >= 0 && close(fd) == 0);
    for (long i = 0; i < rounds; i++) {
        fw_random r;
        char      text[MAX_TEXT + 1];
        size_t    which, n;
        fw_msg    m = {""};
        fw_status status;
        fw_random_stream(&r, 1, FW_STREAM_TEST, (uint64_t)i, 0);
        which = below(&r, sizeof FILES / sizeof FILES[0]);
        n = load(FILES[which], text);
        for (uint32_t k = 1 + below(&r, 4); k > 0; k--) n = damage(&r, text, n);
        if (which == 3) {
            fw_scene s;
            FILE    *f = fopen(scratch, "wb");
            assert_non_null(f);
            fwrite(text, 1, n, f);
            assert_int_equal(fclose(f), 0);
            status = fw_config_scene(&s, scratch, 0, NULL, &m);
            if (status == FW_OK) fw_scene_free(&s);
        } else {
            fw_campaign c;
            status = fw_config_campaign_text(&c, FILES[which], text, n, 0, NULL, -1, &m);
            if (status == FW_OK) fw_campaign_free(&c);
        }
        n_read += status == FW_OK;
        int code = fw_status_exit_code(status);
        if (code != 0 && code != 2 && code != 4) fail_msg("round %ld: %s, %s", i, fw_status_name(status), m.text);
        if (status != FW_OK && strlen(m.text) < 10) fail_msg("round %ld: no message", i);
    }
    assert_int_equal(unlink(scratch), 0);
    assert_true(rounds < 100 || (n_read > 0 && n_read < rounds)); /* some damage is harmless, most is not */
}

/* Damaged tables by the same means. */
static void damaged_tables(void **state)
{
    static char path[] = "floewear-fuzz-table-XXXXXX", set[64];
    const char *asked = getenv("FLOEWEAR_FUZZ");
    long        rounds = (asked ? atol(asked) : ROUNDS) / 3;
    (void)state;

    int fd = mkstemp(path);
    assert_true(fd >= 0 && close(fd) == 0);
    char folder[512], name[600];
    assert_non_null(getcwd(folder, sizeof folder));
    snprintf(name, sizeof name, "%s/x.yaml", folder);
    snprintf(set, sizeof set, "current.joint=%s", path);
    const char *const sets[] = {set};
    for (long i = 0; i < rounds; i++) {
        fw_random   r;
        char        text[MAX_TEXT + 1];
        fw_campaign c;
        fw_msg      m = {""};
        const char *campaign = "ice: {temperature: -10 degC}\ncurrent: {}\n";
        fw_random_stream(&r, 2, FW_STREAM_TEST, (uint64_t)i, 0);
        size_t n = load(i % 2 ? GOOD "joint.csv" : GOOD "joint-thickness.csv", text);
        for (uint32_t k = 1 + below(&r, 3); k > 0; k--) n = damage(&r, text, n);
        FILE *f = fopen(path, "wb");
        assert_non_null(f);
        fwrite(text, 1, n, f);
        assert_int_equal(fclose(f), 0);
        fw_status status = fw_config_campaign_text(&c, name, campaign, strlen(campaign), 1, sets, -1, &m);
        if (status == FW_OK) fw_campaign_free(&c);
        if (status != FW_OK && status != FW_E_INPUT) fail_msg("round %ld: %s, %s", i, fw_status_name(status), m.text);
        if (status != FW_OK && strlen(m.text) < 10) fail_msg("round %ld: no message", i);
    }
    assert_int_equal(unlink(path), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(damaged_files), cmocka_unit_test(damaged_tables)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
