/* Lives: sums of years, each a winter (winters.h) times a factor.
 *
 * Years are either given one after the other, with a lognormal factor of mean 1 that every year of every life draws, or drawn with
 * replacement from a table of whole years, each with its own length and factor. The draws are made once and serve every point.
 *
 * What of a life's mean and variance comes from where is exact:
 *     mean = windows E D,   variance = scatter var D + years (E D)^2
 * with windows = sum E F n,  scatter = sum E F^2 A(n), A(n) from fw_scores_sum,  years = sum var(F n). */
#ifndef FW_STATISTICS_LIVES_H
#define FW_STATISTICS_LIVES_H

#include <stdbool.h>
#include <stdint.h>

#include "statistics/scores.h"

typedef struct fw_year {
    size_t windows;
    double factor; /* on the year's depth, >= 0 */
} fw_year;

typedef struct fw_years {
    size_t         n_years; /* of a life */
    bool           is_table;
    size_t         n;       /* kinds: the rows of the table, else n_years */
    const fw_year *kinds;   /* (n) a table's rows, drawn evenly; else year after year; borrowed */
    double         cv;      /* of the lognormal factor of mean 1 that comes on top; 0 with a table */
} fw_years;

typedef struct fw_life_spread {
    double windows, scatter, years; /* see above */
} fw_life_spread;

fw_life_spread fw_life_spread_make(const fw_years *y, const fw_scores *s, double phi);
double         fw_life_spread_sd(const fw_life_spread *l, double mean, double variance); /* of a life, from those of a window */

typedef struct fw_lives {
    const fw_years *years; /* borrowed */
    size_t          n_lives, n_winters, n_lengths;
    size_t         *lengths; /* (n_lengths) different lengths of winters, ascending; owned */
    uint16_t       *length;  /* (years->n) which of them a kind of year has; owned */
    uint16_t       *winter;  /* (n_years x n_lives) place in the pool; owned */
    uint16_t       *kind;    /* (n_years x n_lives) of a table, else NULL; owned */
    uint16_t       *luck;    /* (n_years x n_lives) place in factors when cv > 0, else NULL; owned */
    double         *factors; /* (FW_LIVES_FACTORS) or NULL; owned */
} fw_lives;

enum { FW_LIVES_FACTORS = 4096, FW_LIVES_KINDS = 1000 };

/* Different lengths first, as they say how long a pool has to be; then the draws for a pool of n_winters (at most 65536).
 * FW_E_ARG: no year, more than FW_LIVES_KINDS in a table. */
size_t    fw_lives_count(const fw_years *years); /* lives that will be drawn */
fw_status fw_lives_make(fw_lives *out, const fw_years *years, fw_msg *m);
fw_status fw_lives_draw(fw_lives *l, uint64_t seed, size_t n_winters, fw_msg *m);
void      fw_lives_free(fw_lives *l);

/* What is asked of the lives of one point. */
typedef struct fw_lives_ask {
    size_t        n_percentiles;
    const double *percentiles; /* (n_percentiles) 0 < p < 1 */
    size_t        n_fan;
    const size_t *fan;         /* (n_fan) years, from 1, ascending */
    double        limit;       /* depth whose use is counted; <= 0: none */
    const double *scale;       /* (n_lives) a factor that stays the same over a life; NULL: none */
} fw_lives_ask;

/* sums      (n_lengths x n_winters) of the pool
 * work      (3 x n_lives) scratch
 * depths    (n_fan x n_percentiles) percentiles of the depth after a year; scaled: of depth times scale, may be NULL
 * used      (n_years) share of lives that pass the limit in a year; used_scaled the same with scale, may be NULL */
void fw_lives_run(const fw_lives *l, const fw_lives_ask *ask, const double *sums, double *work, double *depths, double *scaled, double *used,
                  double *used_scaled);

#endif
