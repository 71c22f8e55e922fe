/* Inside the effects ledger only: the ways that its windows are run, and which rows they are for. */
#ifndef FW_STUDY_EFFECTS_INSIDE_H
#define FW_STUDY_EFFECTS_INSIDE_H

#include "study/depth.h"
#include "study/effects_ledger.h"

/* One way to run the windows, or to read what was run. */
typedef struct fw_effects_arm {
    fw_campaign campaign; /* the campaign's own with its model or temperature changed; borrows what that owns */
    bool        is_read;  /* not run: the campaign's own records under another temperature */
    fw_depth    depth;    /* owned */
    size_t     *row;      /* (n windows) of depth; FW_EFFECTS_FAILED; owned */
    size_t      n_failed;
    double      evaluations, cpu_s;
} fw_effects_arm;
#define FW_EFFECTS_FAILED ((size_t)-1)

enum { FW_EFFECTS_ARMS = FW_EFFECTS_ROWS + FW_EFFECTS_MOST + 1 };

typedef struct fw_effects_plan {
    size_t          n_arms; /* the first one is the campaign itself */
    fw_effects_arm *arms;   /* (FW_EFFECTS_ARMS), owned */
    size_t          arm[FW_EFFECTS_ROWS]; /* of a row; 0: it is not measured */
    /* The chain of sets from the campaign's own down to none: what_is_off[k] is switched off between chain[k] and chain[k + 1]. */
    size_t n_chain, chain[FW_EFFECTS_MOST + 1], what_is_off[FW_EFFECTS_MOST]; /* arms; rows */
} fw_effects_plan;

/* The rows, without numbers, and the arms that measure them. */
fw_status fw_effects_plan_make(fw_effects_plan *p, fw_effects_ledger *l, const fw_campaign *c, size_t n, const fw_effects_switch *switches, fw_msg *m);
void      fw_effects_plan_free(fw_effects_plan *p);

/* Governing point, its numbers, and the rows' changes. */
fw_status fw_effects_compare(fw_effects_ledger *l, const fw_effects_plan *p, const fw_campaign *c, fw_msg *m);

#endif
