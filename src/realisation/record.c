/* The result of one realisation and its bytes (include/floewear/record.h).
 *
 *   offset  bytes               what (all little-endian)
 *   0       4                   n_arcs
 *   4       4                   n_laws
 *   8       8                   id
 *   16      4                   status, number in FW_STATUS_LIST
 *   20      200                 cause, filled up with NUL
 *   220     8 x n_columns       FW_RECORD_LIST in its order, IEEE 754
 *   ...     8 x n_rings         path, then per law load, load_impact, load_high; zeros when the realisation failed
 *
 * The sizes come first so that a message between ranks of different builds or campaigns is refused, not misread. */
#include "floewear/record.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { OFFSET_ID = 8, OFFSET_STATUS = 16, OFFSET_CAUSE = 20, N_CAUSE = 200, OFFSET_COLUMNS = OFFSET_CAUSE + N_CAUSE };

_Static_assert(sizeof((fw_record *)0)->cause == N_CAUSE, "the packed cause has the size of the field");
_Static_assert(sizeof(double) == 8, "IEEE 754 binary64");

const fw_record_column fw_record_columns[] = {
#define X(name, unit, long_name) {#name, unit, long_name, offsetof(fw_record, name)},
    FW_RECORD_LIST(X)
#undef X
};
const size_t fw_n_record_columns = sizeof fw_record_columns / sizeof fw_record_columns[0];

/* More than any campaign has by orders of magnitude; keeps every product of sizes below far from overflow. */
enum { MAX_ARCS = 1 << 24 };

void fw_record_take_scenario(fw_record *r, const fw_scenario *s)
{
    r->id = s->id;
    r->concentration = s->concentration, r->speed = s->speed, r->mix = s->mix, r->cell = s->cell;
    r->wind_speed = s->wind_speed, r->wind_angle = s->wind_angle, r->tide_phase = s->tide_phase;
    r->weight = s->weight, r->randomisation = s->randomisation;
}

fw_scenario fw_record_scenario(const fw_record *r, uint64_t seed)
{
    return (fw_scenario){.seed = seed,
                         .id = r->id,
                         .concentration = r->concentration,
                         .speed = r->speed,
                         .mix = (uint32_t)r->mix,
                         .cell = (uint32_t)r->cell,
                         .wind_speed = r->wind_speed,
                         .wind_angle = r->wind_angle,
                         .tide_phase = r->tide_phase,
                         .weight = r->weight,
                         .randomisation = (int32_t)r->randomisation};
}

double fw_record_mean_load(const fw_record *r, size_t law)
{
    double        sum = 0;
    const double *load = fw_record_load(r, law, FW_RING_LOAD);
    for (size_t k = 0; k < r->n_arcs; k++) sum += load[k];
    return r->n_arcs ? sum / (double)r->n_arcs : 0;
}

fw_status fw_record_init(fw_record *r, size_t n_arcs, size_t n_laws, fw_msg *m)
{
    memset(r, 0, sizeof *r);
    FW_CHECK(n_arcs <= MAX_ARCS && n_laws <= FW_MAX_LAWS, m, FW_E_ARG,
             "a record of %zu arcs and %zu laws: at most %d arcs and %d laws are possible", n_arcs, n_laws,
             (int)MAX_ARCS, (int)FW_MAX_LAWS);
    FW_TRY(fw_alloc(&r->rings, fw_record_n_rings(n_arcs, n_laws), sizeof *r->rings, "rings of a record", m));
    r->n_arcs = n_arcs;
    r->n_laws = n_laws;
    return FW_OK;
}

void fw_record_free(fw_record *r)
{
    if (r == NULL) { return; }
    free(r->rings);
    r->rings = NULL;
    r->n_arcs = 0;
    r->n_laws = 0;
}

size_t fw_record_packed_size(size_t n_arcs, size_t n_laws)
{
    return OFFSET_COLUMNS + 8 * (fw_n_record_columns + fw_record_n_rings(n_arcs, n_laws));
}

static void put_u32(unsigned char *to, uint32_t v)
{
    for (int i = 0; i < 4; i++) { to[i] = (unsigned char)(v >> (8 * i)); }
}

static void put_u64(unsigned char *to, uint64_t v)
{
    for (int i = 0; i < 8; i++) { to[i] = (unsigned char)(v >> (8 * i)); }
}

static uint32_t get_u32(const unsigned char *from)
{
    uint32_t v = 0;
    for (int i = 0; i < 4; i++) { v |= (uint32_t)from[i] << (8 * i); }
    return v;
}

static uint64_t get_u64(const unsigned char *from)
{
    uint64_t v = 0;
    for (int i = 0; i < 8; i++) { v |= (uint64_t)from[i] << (8 * i); }
    return v;
}

static void put_double(unsigned char *to, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    put_u64(to, bits);
}

static double get_double(const unsigned char *from)
{
    uint64_t bits = get_u64(from);
    double   v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

void fw_record_pack(const fw_record *r, unsigned char *bytes)
{
    put_u32(bytes, (uint32_t)r->n_arcs);
    put_u32(bytes + 4, (uint32_t)r->n_laws);
    put_u64(bytes + OFFSET_ID, r->id);
    put_u32(bytes + OFFSET_STATUS, (uint32_t)r->status);
    /* Only up to the NUL: what lies behind it in the array is left over from an earlier sentence, and bytes that differ
     * from run to run would make two equal records differ. */
    memset(bytes + OFFSET_CAUSE, 0, N_CAUSE);
    memcpy(bytes + OFFSET_CAUSE, r->cause, strnlen(r->cause, N_CAUSE - 1));
    unsigned char *at = bytes + OFFSET_COLUMNS;
    for (size_t i = 0; i < fw_n_record_columns; i++, at += 8) {
        double v;
        memcpy(&v, (const char *)r + fw_record_columns[i].offset, sizeof v);
        put_double(at, v);
    }
    size_t n_rings = fw_record_n_rings(r->n_arcs, r->n_laws);
    if (r->status != FW_OK || r->rings == NULL) {
        /* What a broken run had collected so far depends on where it broke; statistics count it as unknown. */
        memset(at, 0, 8 * n_rings);
        return;
    }
    for (size_t i = 0; i < n_rings; i++, at += 8) { put_double(at, r->rings[i]); }
}

fw_status fw_record_unpack(fw_record *r, const unsigned char *bytes, size_t n_bytes, fw_msg *m)
{
    size_t wanted = fw_record_packed_size(r->n_arcs, r->n_laws);
    FW_CHECK(n_bytes == wanted, m, FW_E_FORMAT, "a packed record of %zu bytes; %zu arcs and %zu laws need %zu", n_bytes,
             r->n_arcs, r->n_laws, wanted);
    FW_CHECK(get_u32(bytes) == r->n_arcs && get_u32(bytes + 4) == r->n_laws, m, FW_E_FORMAT,
             "a packed record of %u arcs and %u laws where %zu and %zu are wanted", get_u32(bytes), get_u32(bytes + 4),
             r->n_arcs, r->n_laws);
    uint32_t status = get_u32(bytes + OFFSET_STATUS);
    FW_CHECK(status < FW_N_STATUS, m, FW_E_FORMAT, "a packed record with the unknown status %u; known are 0 to %d",
             status, (int)FW_N_STATUS - 1);
    FW_CHECK(memchr(bytes + OFFSET_CAUSE, 0, N_CAUSE) != NULL, m, FW_E_FORMAT,
             "a packed record whose cause has no end");
    r->id = get_u64(bytes + OFFSET_ID);
    r->status = (fw_status)status;
    memcpy(r->cause, bytes + OFFSET_CAUSE, N_CAUSE);
    const unsigned char *at = bytes + OFFSET_COLUMNS;
    for (size_t i = 0; i < fw_n_record_columns; i++, at += 8) {
        double v = get_double(at);
        memcpy((char *)r + fw_record_columns[i].offset, &v, sizeof v);
    }
    size_t n_rings = fw_record_n_rings(r->n_arcs, r->n_laws);
    for (size_t i = 0; i < n_rings; i++, at += 8) { r->rings[i] = get_double(at); }
    return FW_OK;
}
