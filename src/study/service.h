/* Service life: windows to winters to years to a life, for every measuring point.
 *
 * A winter is ice_hours_per_year / window windows whose normal scores are correlated from one to the next (`persistence`), a year a winter
 * times a lognormal factor (`year_to_year_cv`), or a whole year of a table drawn with replacement; a life is their sum. With neither of the
 * three the sum is Pearson's gamma law with the sum's own three moments (statistics/life.h), else simulated lives (statistics/lives.h) with
 * the same draws for all points. A factor on the law's rate that is not known stays the same over a life (law_factor.h). */
#ifndef FW_STUDY_SERVICE_H
#define FW_STUDY_SERVICE_H

#include "floewear/campaign.h"

/* Percentiles of the depth used up after each year: the fan of lives. */
typedef struct fw_fan_row {
    size_t point;
    double bearing_deg, year, percentile, depth_mm;
    double with_law_depth_mm; /* the law's uncertainty in it; NAN: none given */
} fw_fan_row;

/* The law of the year in which the allowance is used up. */
typedef struct fw_allowance_row {
    size_t point;
    double bearing_deg, year;
    double probability, by_then;                 /* that it is used up in this year, and up to its end */
    double with_law_probability, with_law_by_then; /* NAN: none given */
} fw_allowance_row;

/* What a life of one point is made of. Coefficients of variation add in squares. */
typedef struct fw_life_point {
    size_t point;
    double bearing_deg, mean_mm, cv;
    double cv_windows;      /* if they were independent and years alike */
    double cv_persistence;  /* what their resemblance adds */
    double cv_years;        /* what years that differ add */
    double years_half_width; /* relative, of the interval for what a short table leaves unknown; NAN: no table, or fewer than FW_LIFE_YEARS rows */
    double allowance_mm;             /* NAN: none */
    double never, with_law_never;                  /* probability that the life ends first; NAN: no allowance, no law */
    double allowance_year_p5, allowance_year_p50, allowance_year_p95; /* NAN: not within the life */
} fw_life_point;

/* Depth of a life at the design percentile over bearing and height, with statistics of the water level. */
typedef struct fw_map_row {
    size_t point;
    double bearing_deg, height_m, percentile, depth_mm;
} fw_map_row;

/* Empty without a service section; allowance and map also without those. All owned. */
typedef struct fw_service_answer {
    char              assumption[80]; /* how windows and years depend on one another */
    size_t            governing_point; /* with the largest life depth at the design percentile, from 1; not always that of a window */
    double            governing_mm;    /* that depth */
    size_t            n_fan, n_allowance, n_points, n_map;
    fw_fan_row       *fan;       /* point-major, then years, then percentiles */
    fw_allowance_row *allowance; /* point-major */
    fw_life_point    *points;
    fw_map_row       *map;       /* point-major */
} fw_service_answer;

void fw_service_answer_free(fw_service_answer *a);

/* Whole windows in the life, at least one; the mean with a table of years. */
double fw_service_windows(const fw_campaign *c);

#endif
