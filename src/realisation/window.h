/* Inside realisation: a window while it runs, from its first ice to the instant that one asks for. */
#ifndef FW_REALISATION_WINDOW_H
#define FW_REALISATION_WINDOW_H

#include "abrasion/wear.h"
#include "floewear/realisation.h"
#include "kernel/kernel.h"
#include "kernel/plain.h"
#include "realisation/flow.h"
#include "realisation/ice.h"

typedef struct fw_window_run {
    const fw_model *model;
    fw_setup        setup;
    fw_weather      weather;
    fw_ice          ice;
    fw_world       *world;
    fw_kernel      *kernel;
    fw_plain       *plain; /* instead of kernel, for benchmarks */
    fw_wear         wear;
    const fw_tick  *tick; /* of the present call */
    double          t_all;
    double          turned;  /* when the current last changed [s] */
    fw_status       stopped; /* what the tick said */
    bool            is_ice;  /* it failed for want of ice, which no finer step cures */
} fw_window_run;

/* Ice round the structure, an open ledger, no wear collected yet. fw_window_close also after an error. r stays where it is. */
fw_status fw_window_open(fw_window_run *r, const fw_model *model, const fw_scenario *sc, fw_msg *m);
/* To t_end, where all floes stand at the same instant; the tick (NULL: none) is told the share of t_all every few milliseconds, and what it says
 * is in r->stopped. */
fw_status fw_window_go(fw_window_run *r, double t_end, double t_all, const fw_tick *tick, fw_msg *m);
double    fw_window_now(const fw_window_run *r); /* [s], also where it failed; 0 before there is a world */
/* Where ice is needed now and `more` upstream of that [m]. */
fw_box    fw_window_box(const fw_window_run *r, double more);
/* Ice there. */
fw_status fw_window_feed(fw_window_run *r, double more, fw_msg *m);
void      fw_window_close(fw_window_run *r);

#endif
