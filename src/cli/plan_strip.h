/* The swept strip (study/swept.h) by itself, before a window is simulated: hits per hour and mean depths over the site's law, in milliseconds. */
#ifndef FW_CLI_PLAN_STRIP_H
#define FW_CLI_PLAN_STRIP_H

#include <stdio.h>

#include "cli/json.h"
#include "floewear/campaign.h"

typedef struct fw_plan_strip {
    double  hits_per_hour; /* over the site's law */
    double  evaluations;   /* contact force evaluations that it took */
    double  usual;         /* what floes that press one another usually wear over it, in the law's mean */
    size_t  n_points, most; /* most: index of the point with the largest mean */
    double *mean_mm;       /* (n_points) of a window; owned */
    char    why[160];      /* there is no strip; empty: there is one */
} fw_plan_strip;

fw_status fw_plan_strip_make(fw_plan_strip *out, const fw_campaign *c, fw_msg *m);
void      fw_plan_strip_free(fw_plan_strip *s);
void      fw_plan_strip_print(FILE *to, const fw_campaign *c, const fw_plan_strip *s);
void      fw_plan_strip_json(fw_json *j, const fw_campaign *c, const fw_plan_strip *s);

#endif
