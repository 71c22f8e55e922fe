/* The sanity check beside a campaign's result: what the swept strip (swept.h), which knows of no ice on ice, makes of the same scenarios.
 *
 * Over the whole ring the ratio campaign / strip is 1 in thin ice and grows with the concentration alone (swept.h: fw_swept_crowding), on the default
 * ice and contact. A ratio that does not lie there is a reason to look closer: at the effects that are on, or at the result. At single
 * points it is no such number: the strip leaves the middle, which faces the current, nearly bare (floes roll off it), ice that presses does not. The strip is
 * also taken over the site's own law: how far the scenarios drawn are from it in the mean, which is what a control variate takes off.
 *
 * The strip's load of a scenario is a sum of rows, so a record costs a few additions and no ring. */
#ifndef FW_STUDY_SANITY_H
#define FW_STUDY_SANITY_H

#include "floewear/campaign.h"
#include "study/directions.h"
#include "study/swept.h"

typedef struct fw_sanity_row {
    size_t point; /* from 1 */
    double bearing_deg;
    double strip_mm; /* mean depth of a window over the records' scenarios, by the strip */
    double law_mm;   /* the same over the site's law */
    double ratio;    /* campaign's mean depth over strip_mm; NAN: the strip has none there */
} fw_sanity_row;

/* Of the mean load over the ring. NAN where the strip has none. */
typedef struct fw_sanity_ring {
    double ratio;           /* of the campaign's records over the strip in their scenarios */
    double usual;           /* what that is on the default ice at these concentrations */
    double law_over_sample; /* the strip over the site's law, over the strip in the scenarios of the records */
} fw_sanity_ring;

typedef struct fw_sanity {
    fw_swept swept;
    size_t   law;      /* of abrasion */
    size_t   n_laws;   /* of direction, as in directions.h */
    double  *records;  /* (n_laws, mixes x speeds) sums of shares over records [1/m]; owned */
    double  *total;    /* (mixes x speeds) a row's sum over the ring; owned */
    double   weight;   /* of the records, and by it: */
    double   load, strip, crowded; /* sums over the ring of the records' loads, of the strip's, of those with fw_swept_crowding [MPa^m km] */
    char     why[160]; /* there is no strip; empty: there is one */
} fw_sanity;

/* Solves the strip for the campaign's speeds. Where a hit fails, or the model is none that can be run, out->why says so and the others do nothing.
 * FW_E_NOMEM. */
fw_status fw_sanity_begin(fw_sanity *out, const fw_campaign *c, size_t law, fw_msg *m);
/* Failed ones are passed over. weight: of the record among all, 1 where all count alike. */
void      fw_sanity_add(fw_sanity *s, const fw_record *r, double weight);
/* factor: mean of the rate [mm per MPa^m km]; rows: (d->n_points), strip_mm and law_mm are filled. */
fw_status fw_sanity_end(const fw_sanity *s, const fw_campaign *c, const fw_directions *d, double factor, fw_sanity_row *rows, fw_sanity_ring *ring,
                        fw_msg *m);
/* ln of the strip's load of a scenario, summed over the ring; -INFINITY: none. Not after why is set. */
double    fw_sanity_ln_strip(const fw_sanity *s, const fw_scenario *sc);
void      fw_sanity_free(fw_sanity *s);

#endif
