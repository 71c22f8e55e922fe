/* The part of `floewear plan` that runs a pilot: which sampling design pays, what a run costs and how precise it gets; and NAME.plan.h5, which tells the
 * choice to `run`.
 *
 *   /pilot        one row per window: id, speed, concentration, mix, load, evaluations, cpu
 *   /designs      half-width and cost of each design that was tried
 *   /allocation   shares of the realisations per stratum, of the allocated stratified design
 *   /choice       one row: the design, and why
 *   /forecast     realisations, half-width, CPU hours */
#ifndef FW_CLI_PLAN_DESIGN_H
#define FW_CLI_PLAN_DESIGN_H

#include <stdio.h>

#include "cli/json.h"
#include "store/tables.h"
#include "study/outlook.h"

/* About what a core of 2020 does in a second, at 40 to 80 % ice. */
#define FW_PLAN_EVALUATIONS_PER_S 1.3e7

typedef struct fw_plan_forecast {
    double n, half_width, cpu_s; /* realisations of the run, what they reach, cost */
    double n_wanted;             /* realisations that the precision wants; NAN: none is asked, or not known */
} fw_plan_forecast;

/* Windows of a pilot: n, or with n < 0 an eighth of the campaign, 24 to FW_OUTLOOK_PILOT. */
size_t           fw_plan_pilot_size(const fw_campaign *c, long n);
/* n < 0: the usual number of windows, as far as they are expected to take minutes. Collects *pilot (n) records, owned by the caller. */
fw_status        fw_plan_pilot(const fw_campaign *c, long n, bool is_quiet, fw_record **pilot, size_t *n_pilot, fw_msg *m);
fw_status        fw_plan_outlook(fw_outlook *out, const fw_campaign *c, size_t n, const fw_record *pilot, bool is_quiet, fw_msg *m);
fw_plan_forecast fw_plan_forecast_make(const fw_campaign *c, const fw_outlook *x);
void             fw_plan_design_print(FILE *to, const fw_campaign *c, const fw_outlook *x, const fw_plan_forecast *f, size_t n_wanted_pilot);
void             fw_plan_design_json(fw_json *j, const fw_campaign *c, const fw_outlook *x, const fw_plan_forecast *f);

/* bare: the campaign as its file says it, before any choice: whose settings the file belongs to. */
fw_status fw_plan_file_write(const char *path, const fw_campaign *bare, const fw_outlook *x, const fw_plan_forecast *f, size_t n, const fw_record *pilot,
                             fw_msg *m);
/* The choice of a file that is open as --set says it, "sampling={design: ...}", to be freed, and as words. FW_E_FORMAT. */
fw_status fw_plan_file_read(const fw_tables *t, char **set, char *words, size_t size, fw_msg *m);

#endif
