/* Every kind of bad input: its status, one clear message that names the place, and an answer within a second.
 *
 * The corpus is tests/cli/bad. The first line of each file says what is wanted: a status and pieces of the message, all
 * of them literal: "# wants: FW_E_INPUT | :3:22: | structure.diameter | has no unit". Files that cannot carry a comment
 * (empty, binary, huge) are made here. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/config.h"

enum { MAX_PIECES = 12 };

/* Processor time: a busy machine must not fail the test. */
#ifdef __SANITIZE_ADDRESS__
static const double LIMIT = 5; /* every access is checked there */
#else
static const double LIMIT = 1;
#endif

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static fw_status read_path(const char *path, bool is_scene, fw_msg *m)
{
    if (is_scene) {
        fw_scene  s;
        fw_status status = fw_config_scene(&s, path, 0, NULL, m);
        if (status == FW_OK) fw_scene_free(&s);
        return status;
    }
    fw_campaign c;
    fw_status   status = fw_config_campaign(&c, path, 0, NULL, -1, m);
    if (status == FW_OK) fw_campaign_free(&c);
    return status;
}

static void read_timed(const char *path, bool is_scene, fw_status *status, fw_msg *m)
{
    double start = seconds();

    memset(m, 0, sizeof *m);
    *status = read_path(path, is_scene, m);
    if (seconds() - start > LIMIT) fail_msg("%s took %g s", path, seconds() - start);
}

static size_t cut_pieces(char *line, char *pieces[MAX_PIECES])
{
    size_t n = 0;

    line[strcspn(line, "\n")] = '\0';
    for (char *p = line + strlen("# wants: "); p && n < MAX_PIECES; n++) {
        char *bar = strstr(p, " | ");
        if (bar) *bar = '\0';
        pieces[n] = p;
        p = bar ? bar + 3 : NULL;
    }
    return n;
}

/* Number of complaints, printed. */
static int check_file(const char *folder, const char *name)
{
    char      path[512], line[1024] = "", *pieces[MAX_PIECES];
    fw_status status;
    fw_msg    m;

    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    assert_non_null(fgets(line, sizeof line, f));
    fclose(f);
    assert_memory_equal(line, "# wants: ", 9);
    size_t n = cut_pieces(line, pieces);
    read_timed(path, strncmp(name, "scene-", 6) == 0, &status, &m);
    int  code = fw_status_exit_code(status), wrong = 0;
    bool names_table = n > 1 && strstr(pieces[1], ".csv");
    if (strcmp(fw_status_name(status), pieces[0]) != 0 || (code != 2 && code != 4)) wrong++;
    if (!names_table && !strstr(m.text, name)) wrong++;
    for (size_t i = 1; i < n; i++) {
        if (!strstr(m.text, pieces[i])) {
            print_error("%s: \"%s\" is not in:\n", name, pieces[i]);
            wrong++;
        }
    }
    if (strchr(m.text, '\n')) wrong++;
    if (wrong) print_error("%s: %s, %s\n", name, fw_status_name(status), m.text);
    return wrong;
}

static void corpus(void **state)
{
    const char    *folder = FW_SOURCE_DIR "/tests/cli/bad";
    DIR           *d = opendir(folder);
    struct dirent *e;
    int            n = 0, wrong = 0;
    (void)state;

    assert_non_null(d);
    while ((e = readdir(d))) {
        size_t length = strlen(e->d_name);
        if (length < 5 || strcmp(e->d_name + length - 5, ".yaml") != 0) continue;
        wrong += check_file(folder, e->d_name);
        n++;
    }
    closedir(d);
    assert_int_equal(wrong, 0);
    assert_true(n >= 120);
}

/* ---- files that are made ---------------------------------------------------------------------------------------- */

static char scratch[] = "floewear-bad-XXXXXX";

static int make_scratch(void **state)
{
    (void)state;
    int fd = mkstemp(scratch);
    return fd < 0 ? -1 : close(fd);
}

static int remove_scratch(void **state)
{
    (void)state;
    return unlink(scratch);
}

static void write_scratch(const char *bytes, size_t n, size_t times)
{
    FILE *f = fopen(scratch, "wb");

    assert_non_null(f);
    for (size_t i = 0; i < times; i++) assert_int_equal(fwrite(bytes, 1, n, f), n);
    assert_int_equal(fclose(f), 0);
}

static void refuse_scratch(const char *piece)
{
    for (int is_scene = 0; is_scene < 2; is_scene++) {
        fw_status status;
        fw_msg    m;
        read_timed(scratch, is_scene, &status, &m);
        if (status != FW_E_INPUT) fail_msg("%s: %s", fw_status_name(status), m.text);
        if (!strstr(m.text, piece) || !strstr(m.text, scratch)) fail_msg("\"%s\" is not in: %s", piece, m.text);
    }
}

static void empty_files(void **state)
{
    (void)state;
    write_scratch("", 0, 1);
    refuse_scratch(":1:1: the file is empty");
    write_scratch(" \n\t\n", 4, 10);
    refuse_scratch(":1:1: the file is empty");
    write_scratch("---\n", 4, 1);
    refuse_scratch("no map of keys");
    write_scratch("\xef\xbb\xbf", 3, 1);
    refuse_scratch(":1:");
}

static void binary_files(void **state)
{
    char junk[4096];
    (void)state;

    write_scratch("name: x\nice: \0oops\n", 19, 1);
    refuse_scratch(":2:6: byte 0x00 is no text");
    write_scratch("name: caf\xe9\n", 11, 1); /* Latin-1 */
    refuse_scratch(":1:10: byte 0xe9 is no text");
    write_scratch("\x7f"
                  "ELF\x02\x01\x01",
                  7, 100);
    refuse_scratch(":1:1: byte 0x7f is no text");
    write_scratch("\xff\xfen\0a\0m\0e\0:\0", 12, 1); /* UTF-16 */
    refuse_scratch(":1:1: byte 0xff is no text");
    write_scratch("a: \xed\xa0\x80\n", 7, 1); /* a surrogate */
    refuse_scratch(":1:4: byte 0xed is no text");
    write_scratch("a: \xc0\xaf\n", 6, 1); /* overlong */
    refuse_scratch(":1:4: byte 0xc0 is no text");
    for (size_t i = 0; i < sizeof junk; i++) junk[i] = (char)(i * 2654435761u >> 13);
    write_scratch(junk, sizeof junk, 50);
    refuse_scratch("is no text");
    write_scratch("a: \"\\0\"\n", 8, 1); /* an escaped NUL inside quotes */
    refuse_scratch(":1:4: a NUL");
}

static void huge_and_deep_files(void **state)
{
    static const struct {
        const char *piece;
        size_t      times;
        const char *wants;
    } rows[] = {
        {"[", 10 << 20, "longer than 1024 KiB"},
        {"[", 1 << 20, "deeper than 32"},
        {"{", 1 << 20, "deeper than 32"},
        {"- ", 500000, "deeper than 32"},
        {"? ", 500000, "deeper than 32"},
        {"{a: ", 250000, "deeper than 32"},
        {"a: [", 100000, ":1:"},
        {"[],", 300000, ":1:"},
        {"a,", 500000, ":1:"},
        {"a: b\n", 200000, "more than 200000 values"},
        {"'", 1000000, ":1:"},
        {"\"a", 500000, ":1:"},
        {"&a ", 300000, ":1:"},
        {"*a ", 300000, ":1:"},
        {"!", 1000000, ":1:"},
        {"%", 1000000, ":1:"},
        {"--- ", 250000, ":1:"},
        {"---\n", 250000, ":"},
        {"#", 1000000, "comments only"},
        {"a", 1000000, ":1:1:"},
        {"|\n ", 300000, ":1:"},
        {"a:\n", 300000, "more than 200000 values"},
        {"- a\n", 250000, "more than 200000 values"},
        {"\n", 1000000, "empty"},
    };
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        write_scratch(rows[i].piece, strlen(rows[i].piece), rows[i].times);
        refuse_scratch(rows[i].wants);
    }
}

/* Wide but shallow files inside a map's value: each must be answered in a second as well. */
static void wide_files(void **state)
{
    static const char *const heads[] = {"floes: [", "ice: {concentration: {values: [", "current: {direction: {rose: {"};
    static const char *const items[] = {"{x: 1 m},", "1 %,", "1 deg: 1,", "[[[[[[[[[]]]]]]]]],", "{a: {b: {c: d}}},"};
    (void)state;

    for (size_t h = 0; h < sizeof heads / sizeof heads[0]; h++) {
        for (size_t k = 0; k < sizeof items / sizeof items[0]; k++) {
            FILE *f = fopen(scratch, "wb");
            assert_non_null(f);
            fputs(heads[h], f);
            for (size_t i = 0; i < 900000 / strlen(items[k]); i++) fputs(items[k], f);
            fputs(h == 0 ? "]\n" : h == 1 ? "]}}\n" : "}}}\n", f);
            assert_int_equal(fclose(f), 0);
            refuse_scratch(":1:");
        }
    }
}

static void unreadable_files(void **state)
{
    fw_status status;
    fw_msg    m;
    (void)state;

    read_timed("no/such/file.yaml", false, &status, &m);
    assert_int_equal(status, FW_E_IO);
    assert_non_null(strstr(m.text, "no/such/file.yaml"));
    read_timed("no/such/file.yaml", true, &status, &m);
    assert_int_equal(status, FW_E_IO);
    read_timed(FW_SOURCE_DIR "/tests", false, &status, &m); /* a folder */
    assert_int_equal(status, FW_E_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corpus),       cmocka_unit_test(empty_files),
        cmocka_unit_test(binary_files), cmocka_unit_test(huge_and_deep_files),
        cmocka_unit_test(wide_files),   cmocka_unit_test(unreadable_files),
    };
    return cmocka_run_group_tests(tests, make_scratch, remove_scratch);
}
