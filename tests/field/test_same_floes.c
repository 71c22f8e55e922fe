/* The floes of a field are a promise: a later version makes the same record again, bit by bit. The checksums below were
 * taken from the first packing code, which asked one exact grid of lists at every draw; whatever makes packing faster
 * has to draw, place and order the same floes.
 *
 * Uniform diameters only: the other laws call exp and log, whose last bit is the C library's own. Where floes are
 * crowded (60 % and more), hypot is called when they are pushed apart; a C library that rounds it otherwise may change
 * those rows and no others. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/hash.h"
#include "field/field.h"
#include "field/field_mixes.h"

typedef struct strip {
    const char      *name;
    fw_thickness_mix mix;
    double           concentration;
    int64_t          first, last; /* columns, made from first down to last, forgotten behind */
    int64_t          rows;        /* rows -rows .. rows */
    uint32_t         checksum;
} strip;

static uint32_t add_tile(uint32_t crc, fw_field *f, int64_t column, int64_t row)
{
    const fw_tile *t;
    fw_msg         m = {{0}};
    if (fw_field_tile(f, column, row, &t, &m) != FW_OK) fail_msg("%s", m.text);
    size_t bytes = t->n_floes * sizeof *t->x;
    crc = fw_crc32c(crc, t->x, bytes);
    crc = fw_crc32c(crc, t->y, bytes);
    crc = fw_crc32c(crc, t->radius, bytes);
    return fw_crc32c(crc, t->thickness, bytes);
}

static void every_floe_has_the_bits_it_always_had(void **state)
{
    (void)state;
    const strip strips[] = {
        {"paper 1 %", mix_paper(false), 0.01, 20, -200, 0, 0x2b9a0796},
        {"paper 10 %", mix_paper(false), 0.1, 20, -200, 0, 0x5f43117a},
        {"paper 25 %", mix_paper(false), 0.25, 20, -100, 1, 0x2cc997cc},
        {"paper 40 %", mix_paper(false), 0.4, 20, -100, 1, 0x850634cd},
        {"paper 50 %", mix_paper(true), 0.5, 5, -30, 1, 0x044c8f1e},
        {"paper 60 %", mix_paper(false), 0.6, 5, -60, 0, 0x0c3e083f},
        {"paper 60 %, five rows", mix_paper(false), 0.6, 3, -3, 2, 0x1e4be7d5},
        {"paper 65 %", mix_paper(false), 0.65, 5, -20, 1, 0xa4967f64},
        {"thin 40 %", mix_thin(false), 0.4, 5, -20, 1, 0x934b4f1a},
        {"thin 65 %", mix_thin(false), 0.65, 2, -5, 1, 0x570e9a21},
        {"0.5 m 65 %", mix_single(0.5), 0.65, 2, -5, 0, 0x5032c1ac},
        {"8.04 m 60 %", mix_single(8.04), 0.6, 2, -10, 1, 0x3b9df6ae},
        {"0.0855 m 5 %", mix_single(0.0855), 0.05, 1, -1, 0, 0x0483b1f8},
        {"far away, 40 %", mix_paper(false), 0.4, -1048550, -1048560, 0, 0x1e486175},
        {"4 m 80 %, grown", mix_single(4.0), 0.8, 2, -1, 0, 0xf17e8911},
    };
    bool is_same = true;
    for (size_t k = 0; k < sizeof strips / sizeof *strips; k++) {
        const strip      *s = &strips[k];
        fw_field         *f;
        fw_msg            m;
        fw_field_settings settings = {.seed = 20260101, .id = k, .concentration = s->concentration, .mix = &s->mix};
        uint32_t          crc = 0;
        assert_int_equal(fw_field_create(&f, &settings, &m), FW_OK);
        for (int64_t c = s->first; c >= s->last; c--) {
            for (int64_t r = -s->rows; r <= s->rows; r++) crc = add_tile(crc, f, c, r);
            fw_field_forget(f, c + 3);
        }
        fw_field_destroy(f);
        if (crc == s->checksum) continue;
        print_error("%s: 0x%08x, wanted 0x%08x\n", s->name, (unsigned)crc, (unsigned)s->checksum);
        is_same = false;
    }
    assert_true(is_same);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_floe_has_the_bits_it_always_had)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
