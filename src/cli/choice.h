/* The choices of `floewear accuracy`, `floewear plan` and `floewear plan --effects` as `run` and `plan` take them: from NAME.accuracy.h5, NAME.plan.h5 and
 * NAME.effects.h5 beside the results, or from the file that --accuracy-from names, if it belongs to this very campaign (all settings equal). What it chose is applied like
 * --set, so that it stands in the campaign's settings, in its hash, in the journal and in NAME.h5.
 *
 * Effects are left out only under `effects: auto` and an effects_tolerance above 0 (study/effects_ledger.h has the rule): a file that says
 * itself what is on has decided. */
#ifndef FW_CLI_CHOICE_H
#define FW_CLI_CHOICE_H

#include "cli/accuracy_file.h"
#include "floewear/campaign.h"
#include "study/effects_ledger.h"

typedef enum fw_choice_file { FW_CHOICE_ACCURACY, FW_CHOICE_EFFECTS, FW_CHOICE_PLAN, FW_CHOICE_JOURNAL, FW_CHOICE_RESULTS } fw_choice_file;

/* "results/a.h5", "results/a", "results/a.accuracy.h5" and "results/a.effects.h5" all mean results/a.accuracy.h5, results/a.effects.h5 and so on, or
 * the results/a.h5 that they lie beside. */
fw_status fw_choice_path(char *path, size_t size, const char *out, fw_choice_file kind, fw_msg *m);

/* The key of the first line in which two settings differ; both are lists of "key = value\n" in one order. */
void fw_choice_first_difference(const char *a, const char *b, char *key, size_t size);

typedef struct fw_choice_wanted {
    const char        *campaign; /* the file */
    size_t             n_sets;
    const char *const *sets; /* (n_sets) */
    int64_t            seed; /* < 0: the file's */
    const char        *from; /* --accuracy-from; NULL: look beside out */
    const char        *out;  /* stem of the results; NULL: the campaign's name */
    bool               is_planning; /* a design is about to be chosen: none is taken */
} fw_choice_wanted;

typedef struct fw_choice {
    bool        is_taken;
    char        line[512]; /* which choice is used and why, for stderr */
    fw_measured measured;  /* the ledger's rows: the file's, else the Raahe campaign's */

    char design_line[512]; /* how scenarios are drawn and why, for stderr; empty: there is nothing to say */

    char              effects_line[512]; /* which effects are left out and why, or why none is; empty: there is nothing to say */
    uint32_t          dropped;           /* fw_effect_bit set */
    fw_effects_ledger effects;           /* no rows: not measured */
} fw_choice;

/* The campaign with the choice applied. A file beside the results that is damaged or belongs to another campaign is passed over, and
 * line says so; one that was named is refused: FW_E_IO, FW_E_FORMAT, FW_E_MISMATCH. */
fw_status fw_choice_campaign(fw_campaign *c, const fw_choice_wanted *wanted, fw_choice *out, fw_msg *m);

#endif
