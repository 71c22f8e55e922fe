/* The outlook of a campaign: from a pilot, what each sampling design would reach for its cost, which one is chosen, and what a run will cost.
 *
 * The pilot's windows give the emulator (emulator.h): ln load by scenario, its scatter, and the ring's shape with the scatter of its arcs. Made-up
 * campaigns are then drawn from it under every design, a few of each, and answered by the very code that a run's stop rule asks (answer.h):
 * the half-width is the one that the run would print. Which design pays is judged by half-width^2 x cost of a realisation, cost from the pilot and the
 * cost model; plain sampling stays unless another one is a tenth better.
 *
 * The allocation of the stratified design is Neyman's for unequal costs, share ~ time x sqrt(variance / cost) (Cochran 1977, 5.5): of P(D <= x), x the
 * design percentile at the point where it is largest, and, where a service life or a mean is asked, of the depth itself. 0.3 of the realisations stay
 * proportional, so that no weight is above 3.3 and other percentiles are not forgotten. */
#ifndef FW_STUDY_OUTLOOK_H
#define FW_STUDY_OUTLOOK_H

#include "floewear/campaign.h"
#include "study/answer.h"
#include "study/emulator.h"

enum { FW_OUTLOOK_DESIGNS = 5, FW_OUTLOOK_PILOT = 64, FW_OUTLOOK_FEWEST = 12, FW_OUTLOOK_CAMPAIGNS = 8 /* made up under each design */ };

typedef struct fw_outlook_design {
    char        name[40];   /* "plain", "stratified", "stratified, allocated", "latin_hypercube", "sobol" */
    fw_sampling sampling;   /* allocation owned by the outlook */
    double      half_width; /* after n_virtual realisations; INFINITY: no interval yet */
    double      evaluations;/* of a realisation, mean */
    double      pays;       /* plain's half-width^2 x cost over this one's: how many times fewer CPU hours it takes */
} fw_outlook_design;

typedef struct fw_outlook {
    size_t            n_pilot, n_failed; /* windows run, and failed */
    bool              is_known;          /* enough of them wore: the rest is there */
    fw_emulator       emulator;          /* its strip is gone: for its numbers alone */
    size_t            n_virtual;         /* realisations of a made-up campaign */
    size_t            n_designs;
    fw_outlook_design design[FW_OUTLOOK_DESIGNS];
    size_t            chosen;
    char              reason[320];
    double            cpu_s_per_evaluation;
    double            cpu_mean, cpu_most; /* of the pilot's windows [s] */
    double           *allocation;         /* owned */
} fw_outlook;

typedef struct fw_outlook_options {
    void (*scenario)(const fw_campaign *c, uint64_t id, fw_scenario *out); /* fw_campaign_scenario */
    size_t (*n_strata)(const fw_campaign *c);
    size_t (*stratum)(const fw_campaign *c, const fw_scenario *s);
    fw_scenario_law law;
    void (*say)(void *self, const char *what); /* may be NULL */
    void *say_self;
} fw_outlook_options;

/* pilot (n): windows of the campaign's plain sampling. */
fw_status fw_outlook_make(fw_outlook *out, const fw_campaign *c, size_t n, const fw_record *pilot, const fw_outlook_options *o, fw_msg *m);
void      fw_outlook_free(fw_outlook *x);

/* With n realisations of the chosen design: half-width (falls as 1/sqrt(n)) and CPU seconds. */
double fw_outlook_half_width(const fw_outlook *x, double n);
double fw_outlook_cpu_s(const fw_outlook *x, double n);
/* Realisations that reach a half-width; at least the first look's. */
double fw_outlook_wanted(const fw_outlook *x, double half_width);

#endif
