/* Order of packing. Where a tile is packed against finished neighbours, its large floes keep off the border, where
 * small ones of the neighbours sit already, and a lane shows. So the large floes of all tiles come first: every tile is
 * placed in N_LEVELS batches of equal area, largest first, and a batch sees its neighbours' batches up to its own:
 *
 *   level 1: even columns, then odd columns; level 2: odd columns, then even ones; level 3: even, then odd ...
 *
 * (colours swapped from level to level, so that neither parity is favoured). Tile (c, r) at level k therefore needs its
 * two neighbours at level k or k - 1, which need theirs at k - 1 or k - 2 ...: a finished tile draws on at most
 * N_LEVELS columns on either side, whatever was made before. No neighbour can be further on than the batch wants to see
 * it, because going on would have needed this very batch; so the batches are placed in place and the result depends on
 * no order of calls.
 *
 *   row 0      | c - 2 | c - 1 |   c   | c + 1 | c + 2 |     even rows: wrap in y, neighbours left and right only
 *   row 1      |       |  x x  |  x x  |  x x  |       |     odd rows: also the six finished tiles above and below
 *
 * Even rows never look at odd ones. Each wraps in y while it is packed: its floes keep clear of their own images one
 * tile length above and below, so the row is exactly homogeneous in y and has no loose rim, as one without neighbours
 * would.
 *
 * Pushing fails where the floes are large or nearly alike: then the tile starts afresh and its floes grow (growing.h).
 *
 * Measured, five classes, row 0, 6000 tiles at 60 %, concentration by position in the tile in bins of 2 m, as deviation
 * from the mean in points: 1 level -2.3..+0.9 (even columns hold 58.4 %, odd ones 61.6 %: large floes of odd columns
 * are ten times rarer than the mean within 5 m of a border); 2 levels -1.3..+0.6; 4: -0.5..+0.2; 8: within the sampling
 * error of +-0.25. Cost of 8 levels against 1: +5 % at 60 %. Odd rows cannot be treated so, being last: within 4 m of a
 * row's border the concentration is lower (34 % of 40 %, 52 % of 60 %) and the odd rows' inner part 1 point higher. A
 * straight current uses row 0 alone and does not see it. */
#include "field/field.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"
#include "field/growing.h"
#include "field/packing.h"
#include "field/sizes.h"

enum { N_LEVELS = 8, FRESH_STARTS = 4 };
static const double  TILE_LENGTH = 100.0;      /* [m] */
/* A straight current through dense ice stays in row 0, and of a larger tile less lies along rims that do not give way. */
static const double  DENSE = 0.65, DENSE_TILE_LENGTH = 200.0;
static const double  DIAMETERS_PER_TILE = 7.5; /* a tile is at least this many of the largest diameter long */
static const int64_t MAX_INDEX = 1 << 20; /* of a column or row: 1e8 m, where doubles still resolve 1.5e-8 m */

/* A tile, finished at level N_LEVELS. Coordinates of floes beyond end[level] are not set yet. */
typedef struct tile {
    fw_tile public;
    fw_uniforms random;
    int         level;             /* batches placed */
    size_t      end[N_LEVELS + 1]; /* floes [end[k - 1], end[k]) are batch k */
    double      block[];           /* x, y, radius, thickness of public */
} tile;

typedef struct floe_size {
    double diameter, thickness;
} floe_size;

struct fw_field {
    fw_field_settings settings;
    fw_sizes          sizes;
    double            length; /* L [m] */
    fw_packing        packing;
    uint64_t          n_tries[N_LEVELS]; /* of the last batch of each level */
    floe_size        *sizes_drawn;       /* workspace */
    size_t            sizes_capacity;
    tile            **table; /* open addressing by (column, row)  (table_size, a power of two) */
    size_t            table_size, n_tiles;
    int64_t           forgotten; /* tiles of this column and beyond may have been dropped; INT64_MAX: none */
    fw_field_census   census;
};

/* --- settings ---------------------------------------------------------------------------------------------------- */

fw_status fw_field_create(fw_field **out, const fw_field_settings *s, fw_msg *m)
{
    fw_sizes sizes;
    *out = NULL;
    FW_CHECK(s->concentration > 0.0 && s->concentration <= FW_MAX_CONCENTRATION, m, FW_E_ARG,
             "ice concentration %g %% is outside (0, %g] %%", 100.0 * s->concentration, 100.0 * FW_MAX_CONCENTRATION);
    FW_TRY(fw_sizes_init(&sizes, s->mix, s->size_law, s->size_a, s->size_b, m));

    fw_field *f;
    FW_TRY(fw_alloc(&f, 1, sizeof *f, "ice field", m));
    f->settings = *s;
    f->settings.mix = NULL; /* borrowed for this call only: sizes holds what matters */
    f->sizes = sizes;
    f->length = fmax(s->concentration > DENSE ? DENSE_TILE_LENGTH : TILE_LENGTH, DIAMETERS_PER_TILE * sizes.max_diameter);
    f->forgotten = INT64_MAX;
    *out = f;
    return FW_OK;
}

void fw_field_destroy(fw_field *f)
{
    if (!f) return;
    for (size_t k = 0; k < f->table_size; k++) free(f->table[k]);
    free(f->table);
    free(f->sizes_drawn);
    fw_packing_free(&f->packing);
    free(f);
}

double          fw_field_tile_length(const fw_field *f) { return f->length; }
double          fw_field_max_radius(const fw_field *f) { return 0.5 * f->sizes.max_diameter; }
fw_field_census fw_field_count(const fw_field *f)
{
    fw_field_census c = f->census;
    c.mean_diameter_wanted = f->sizes.mean_diameter;
    return c;
}

/* --- table of tiles ---------------------------------------------------------------------------------------------- */

static uint64_t zigzag(int64_t i) { return i < 0 ? 2 * (uint64_t)(-(i + 1)) + 1 : 2 * (uint64_t)i; }

/* 32 + 32 bits, injective for |column|, |row| < 2^31; bits 54 and above are 0 for tiles that one can ask for */
static uint64_t name_of(int64_t column, int64_t row) { return zigzag(column) << 32 | zigzag(row); }

static size_t slot_of(const fw_field *f, int64_t column, int64_t row)
{
    uint64_t h = name_of(column, row) * 0x9E3779B97F4A7C15u; /* Fibonacci hashing */
    size_t   k = (size_t)(h >> 32) & (f->table_size - 1);
    while (f->table[k] && (f->table[k]->public.column != column || f->table[k]->public.row != row)) {
        k = (k + 1) & (f->table_size - 1);
    }
    return k;
}

static tile *find_tile(const fw_field *f, int64_t column, int64_t row)
{
    return f->table_size ? f->table[slot_of(f, column, row)] : NULL;
}

/* New table of the given size with the tiles of column < keep_below; the others are freed. */
static fw_status rebuild_table(fw_field *f, size_t size, int64_t keep_below, fw_msg *m)
{
    tile **old = f->table, **table;
    size_t old_size = f->table_size;
    FW_TRY(fw_alloc(&table, size, sizeof(tile *), "table of ice tiles", m));
    f->table = table;
    f->table_size = size;
    f->n_tiles = 0;
    for (size_t k = 0; k < old_size; k++) {
        tile *t = old[k];
        if (!t) continue;
        if (t->public.column >= keep_below) {
            free(t);
            continue;
        }
        table[slot_of(f, t->public.column, t->public.row)] = t;
        f->n_tiles++;
    }
    free(old);
    return FW_OK;
}

/* --- making a tile ----------------------------------------------------------------------------------------------- */

/* Larger diameter first, then thicker; floes that are alike in both are the same floe. */
static bool comes_before(floe_size a, floe_size b)
{
    return a.diameter != b.diameter ? a.diameter > b.diameter : a.thickness > b.thickness;
}

/* Radii and thicknesses of the drawn floes, largest first. They were drawn class by class with growing diameters, so the
 * classes' ends are merged. */
static void sort_by_size(tile *t, const floe_size *drawn)
{
    fw_tile *p = &t->public;
    size_t   run_begin[FW_MAX_CLASSES], run_end[FW_MAX_CLASSES], n_runs = 0;
    for (size_t i = 0; i < p->n_floes; i++) {
        if (i > 0 && drawn[i].thickness == drawn[i - 1].thickness) {
            run_end[n_runs - 1]++;
        } else {
            run_begin[n_runs] = i;
            run_end[n_runs++] = i + 1;
        }
    }
    for (size_t i = 0; i < p->n_floes; i++) {
        size_t first = 0;
        for (size_t k = 1; k < n_runs; k++) {
            if (comes_before(drawn[run_end[k] - 1], drawn[run_end[first] - 1])) first = k;
        }
        floe_size next = drawn[--run_end[first]];
        if (run_end[first] == run_begin[first]) { /* used up: the last run takes its number */
            run_begin[first] = run_begin[--n_runs];
            run_end[first] = run_end[n_runs];
        }
        /* Steps back only where two neighbours of a class fell by rounding or two classes are equally thick. */
        size_t at = i;
        for (; at > 0 && comes_before(next, (floe_size){2.0 * p->radius[at - 1], p->thickness[at - 1]}); at--) {
            p->radius[at] = p->radius[at - 1];
            p->thickness[at] = p->thickness[at - 1];
        }
        p->radius[at] = 0.5 * next.diameter;
        p->thickness[at] = next.thickness;
    }
}

/* Batch k ends where k / N_LEVELS of the tile's ice area is down: the same sizes, nearly, in every tile. */
static void split_into_batches(tile *t)
{
    double total = 0.0, sum = 0.0;
    size_t i = 0, n = t->public.n_floes;
    for (size_t k = 0; k < n; k++) total += t->public.radius[k] * t->public.radius[k];
    for (int level = 1; level < N_LEVELS; level++) {
        while (i < n && sum < total * level / N_LEVELS) {
            sum += t->public.radius[i] * t->public.radius[i];
            i++;
        }
        t->end[level] = i;
    }
    t->end[N_LEVELS] = n;
}

/* A tile with the multiset of its floes: n = C L^2 / E[area] rounded at random, n stratified quantiles of the joint law. */
static fw_status draw_floes(fw_field *f, int64_t column, int64_t row, tile **out, fw_msg *m)
{
    const fw_field_settings *s = &f->settings;
    fw_uniforms              random;
    tile                    *t;
    fw_uniforms_stream(&random, s->seed, FW_STREAM_FIELD, s->id, name_of(column, row));
    double mean = s->concentration * f->length * f->length / f->sizes.mean_area;
    size_t n = (size_t)(mean + fw_uniforms_next(&random));
    FW_TRY(fw_grow(&f->sizes_drawn, &f->sizes_capacity, n, sizeof *f->sizes_drawn, "floes of an ice tile", m));
    FW_TRY(fw_alloc(&t, 1, sizeof *t + 4 * n * sizeof *t->block, "floes of an ice tile", m));
    t->public = (fw_tile){.column = column,
                          .row = row,
                          .n_floes = n,
                          .x = t->block,
                          .y = t->block + n,
                          .radius = t->block + 2 * n,
                          .thickness = t->block + 3 * n};
    for (size_t i = 0; i < n; i++) {
        double q = ((double)i + fw_uniforms_next(&random)) / (double)n;
        fw_sizes_draw(&f->sizes, q, &f->sizes_drawn[i].diameter, &f->sizes_drawn[i].thickness);
    }
    t->random = random;
    sort_by_size(t, f->sizes_drawn);
    split_into_batches(t);
    *out = t;
    return FW_OK;
}

static fw_status new_tile(fw_field *f, int64_t column, int64_t row, tile **out, fw_msg *m)
{
    if (2 * (f->n_tiles + 1) > f->table_size) {
        FW_TRY(rebuild_table(f, f->table_size ? 2 * f->table_size : 64, INT64_MAX, m));
    }
    FW_TRY(draw_floes(f, column, row, out, m));
    f->table[slot_of(f, column, row)] = *out;
    f->n_tiles++;
    return FW_OK;
}

/* --- order of packing -------------------------------------------------------------------------------------------- */

typedef struct neighbour {
    int64_t     column, row;
    int         level; /* batches it must have, no more and no less, when the tile's next batch is placed */
    const tile *tile;  /* NULL when that is none */
} neighbour;

static bool is_odd(int64_t i) { return (i & 1) != 0; }

static int list_neighbours(const tile *t, int level, neighbour list[8])
{
    int64_t c = t->public.column, r = t->public.row;
    int     n = 0, beside = is_odd(c) == is_odd(level) ? level : level - 1;
    list[n++] = (neighbour){c - 1, r, beside, NULL};
    list[n++] = (neighbour){c + 1, r, beside, NULL};
    if (is_odd(r)) {
        for (int64_t i = -1; i <= 1; i++) {
            list[n++] = (neighbour){c + i, r - 1, N_LEVELS, NULL};
            list[n++] = (neighbour){c + i, r + 1, N_LEVELS, NULL};
        }
    }
    return n;
}

/* The tile with its next batch packed anew: all its floes may move, because no neighbour has built on where they were.
 * Each start has random numbers of its own; the first is quick, the others grow the floes slowly. */
static fw_status start_afresh(fw_field *f, const tile *t, fw_msg *m)
{
    fw_packing *p = &f->packing;
    int64_t     column = t->public.column, row = t->public.row;
    double      size = 0.0, largest_size = 0.0, area = 0.0;
    for (uint64_t start = 1; start <= FRESH_STARTS; start++) {
        fw_uniforms random;
        uint64_t    name = name_of(column, row) | (start * N_LEVELS + (uint64_t)t->level) << 54;
        fw_uniforms_stream(&random, f->settings.seed, FW_STREAM_FIELD, f->settings.id, name);
        FW_TRY(fw_growing_pack(p, start == 1 ? 1 : 4, &random, &size, m));
        if (size == 1.0) return FW_OK;
        largest_size = fmax(largest_size, size);
    }
    for (size_t i = 0; i < p->n_own; i++) area += M_PI * p->r[i] * p->r[i];
    return fw_fail(m, FW_E_NUMERIC,
                   "ice field: tile (%lld, %lld) was to be packed to %.1f %%, reached without overlap: %.2f %%; wanted: "
                   "a lower concentration or more unlike floe sizes",
                   (long long)column, (long long)row, 100.0 * f->settings.concentration,
                   100.0 * area / (f->length * f->length) * largest_size * largest_size);
}

static fw_status place_batch(fw_field *f, tile *t, const neighbour *list, int n, fw_msg *m)
{
    fw_packing    *p = &f->packing;
    fw_tile       *self = &t->public;
    double         L = f->length;
    fw_packing_box box = {.x0 = (double)self->column * L,
                          .x1 = (double)(self->column + 1) * L,
                          .y0 = ((double)self->row - 0.5) * L,
                          .y1 = ((double)self->row + 0.5) * L,
                          .wraps_y = !is_odd(self->row)};
    double         cell = 1.2 * sqrt(f->sizes.mean_area); /* flat optimum: 1 to 2 cost the same, 0.4 a third more */
    FW_TRY(fw_packing_begin(p, &box, self->n_floes, 0.5 * f->sizes.max_diameter, cell, m));
    size_t      begin = t->end[t->level], end = t->end[t->level + 1], n_left;
    fw_uniforms random = t->random; /* a batch that fails leaves the tile as it was: it fails again when asked again */
    FW_TRY(fw_packing_own(p, begin, self->x, self->y, self->radius, m));
    for (int k = 0; k < n; k++) {
        const tile *other = list[k].tile;
        if (!other) continue;
        FW_CHECK(other->level == list[k].level, m, FW_E_INTERNAL, "ice tile (%lld, %lld) is at batch %d, wanted %d",
                 (long long)list[k].column, (long long)list[k].row, other->level, list[k].level);
        FW_TRY(fw_packing_obstacles(p, other->end[other->level], other->public.x, other->public.y,
                                    other->public.radius, m));
    }
    uint64_t *n_expected = &f->n_tries[t->level], n_before = p->cost.n_tries;
    FW_TRY(fw_packing_place(p, end - begin, self->radius + begin, *n_expected, &random, &n_left, m));
    *n_expected = p->cost.n_tries - n_before;
    if (n_left > 0) FW_TRY(start_afresh(f, t, m));
    t->random = random;
    if (end > 0) { /* an empty workspace may have no arrays at all */
        memcpy(self->x, p->x, end * sizeof *self->x);
        memcpy(self->y, p->y, end * sizeof *self->y);
    }
    t->level++;
    return FW_OK;
}

static void count_tile(fw_field *f, const tile *t)
{
    fw_field_census *c = &f->census;
    if (t->public.column >= f->forgotten) return; /* made again: it may have been counted */
    c->n_tiles++;
    c->n_floes += t->public.n_floes;
    c->tile_area += f->length * f->length;
    for (size_t i = 0; i < t->public.n_floes; i++) {
        double r = t->public.radius[i];
        c->ice_area += M_PI * r * r;
        c->sum_diameter += 2.0 * r;
    }
}

/* Bring tile (column, row) to `level` batches, its neighbours first. */
static fw_status advance(fw_field *f, int64_t column, int64_t row, int level, tile **out, fw_msg *m)
{
    tile *t = find_tile(f, column, row);
    if (!t) FW_TRY(new_tile(f, column, row, &t, m));
    while (t->level < level) {
        neighbour list[8];
        int       n = list_neighbours(t, t->level + 1, list);
        for (int k = 0; k < n; k++) {
            if (list[k].level == 0) continue;
            tile *beside;
            FW_TRY(advance(f, list[k].column, list[k].row, list[k].level, &beside, m));
            list[k].tile = beside;
        }
        FW_TRY(place_batch(f, t, list, n, m));
        if (t->level == N_LEVELS) count_tile(f, t);
    }
    *out = t;
    return FW_OK;
}

fw_status fw_field_tile(fw_field *f, int64_t column, int64_t row, const fw_tile **out, fw_msg *m)
{
    tile *t;
    FW_CHECK(column >= -MAX_INDEX && column <= MAX_INDEX && row >= -MAX_INDEX && row <= MAX_INDEX, m, FW_E_ARG,
             "ice tile (%lld, %lld) is outside -%lld..%lld", (long long)column, (long long)row, (long long)MAX_INDEX,
             (long long)MAX_INDEX);
    FW_TRY(advance(f, column, row, N_LEVELS, &t, m));
    *out = &t->public;
    return FW_OK;
}

void fw_field_forget(fw_field *f, int64_t first_forgotten)
{
    if (first_forgotten > MAX_INDEX) return;
    /* What smaller columns may still draw on: N_LEVELS columns in their own row, and, for an odd row, the rows beside
     * it one column further with N_LEVELS columns of their own. */
    int64_t keep_below = first_forgotten + 2 * N_LEVELS + 1;
    if (keep_below >= f->forgotten) return;
    f->forgotten = keep_below;
    if (f->table_size) (void)rebuild_table(f, f->table_size, keep_below, NULL); /* without memory nothing is dropped */
}
