/* The making of service lives: what all points share, then one point after the other. */
#ifndef FW_STUDY_SERVICE_RUN_H
#define FW_STUDY_SERVICE_RUN_H

#include "statistics/lives.h"
#include "statistics/winters.h"
#include "study/answer.h"
#include "study/depth.h"
#include "study/law_factor.h"

enum { FW_SERVICE_FAN = 100, FW_MAP_HEIGHTS = 81 };

typedef struct fw_service_run {
    const fw_campaign   *campaign; /* borrowed, like law */
    const fw_law_factor *law;      /* n = 0: known */
    double               confidence, design_percentile;
    size_t               n_asked, n_percentiles; /* the asked ones are the last of all */
    const double        *asked;                  /* (n_asked) 0 to 100; borrowed */
    double              *percentiles;            /* (n_percentiles) fractions; owned */
    fw_year             *kinds;                  /* owned */
    fw_years             years;
    fw_lives             lives;
    fw_winters           winters; /* at NULL: no point has needed a simulation so far */
    size_t               n_fan, fan[FW_SERVICE_FAN]; /* years that the fan shows, the last one of them the end of life */
    /* Scratch of one point. */
    fw_scores            scores;
    double              *sums, *work, *factor;        /* of the pool, of lives, of laws; owned, with the pool */
    double              *depths, *scaled;             /* (n_fan x n_percentiles); owned */
    double              *used, *used_scaled;          /* (n_years); owned */
} fw_service_run;

/* n_percentiles as asked for, 0 to 100; memory for n_points in out. The campaign, law and percentiles must outlive it. */
fw_status fw_service_open(fw_service_run *s, const fw_campaign *c, size_t n_percentiles, const double *percentiles, double design_percentile,
                          double confidence, const fw_law_factor *law, size_t n_points, fw_service_answer *out, fw_msg *m);
/* rows (n_percentiles): point and bearing already set; i: the point's place among those answered. */
fw_status fw_service_point(fw_service_run *s, const fw_window *w, size_t i, fw_life_row *rows, fw_service_answer *out, fw_msg *m);
void      fw_service_close(fw_service_run *s);

/* The pool of winters and the draws of lives, made when the first point needs them. */
fw_status fw_service_simulate(fw_service_run *s, fw_msg *m);

/* Lives that a simulation makes for this campaign: the number of draws that a law's factor needs. */
size_t fw_service_lives(const fw_campaign *c);

/* Rows of the map for one point from its life at the design percentile. Does nothing without a water level or where nothing wore. */
fw_status fw_life_map_add(fw_service_answer *out, const fw_campaign *c, const fw_window *w, const fw_life_row *life, fw_msg *m);

#endif
