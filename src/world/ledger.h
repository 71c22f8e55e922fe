/* The books of a run: energy, momentum and counts. Every entry is added where the force acts; the checks compare sums that
 * were reached on different ways, so a lost impulse or a wrong sign shows. */
#ifndef FW_WORLD_LEDGER_H
#define FW_WORLD_LEDGER_H

typedef struct fw_ledger {
    /* energy [J] */
    double kinetic_change;             /* sum over steps of the change of kinetic energy of stepped floes */
    double impulse_work;               /* sum of impulse times mean velocity, the same thing reached from the forces */
    double impulse_size;               /* sum of |impulse| |mean velocity|: what both are measured against */
    double drag_work;                  /* quadrature of drag power over steps, and the exact change in free flight */
    double drag_size;                  /* without sign, of floes in contact */
    double inflow, outflow;            /* kinetic and stored energy of floes that entered or left the awake set */
    double dashpot, friction, dropped; /* dissipated; dropped: spring energy lost where tension is refused */
    double crushed, rolling;           /* by ice that crushes; by the moment of its flats */
    double turned;                     /* what is stored in flats and goes, or comes, as other places of a rim come under the wall */
    double into_springs;               /* what went into springs: contacts without a dashpot dissipate nothing */
    /* floes: everyone who came is here or has left */
    double floes_start, floes_in, floes_out;
    /* momentum [N s] */
    double momentum_error; /* sum over steps of |m dv - impulses| */
    double momentum_size;  /* sum of |impulses| */
    /* structure */
    double normal_impulse; /* [N s] */
    double peak_force;     /* [N] */
    double contact_time;   /* [s] with a force */
    double hits;           /* first touches after 1 s apart */
    /* what the watch-dogs saw */
    double refined;           /* steps repeated for one of them, finer */
    double chatter, contact_steps; /* steps in which slip jumped from cap to cap and back; steps of all contacts */
    double late_overlap;      /* largest one found before its touch, over the smaller radius */
    /* range of the rigid-disc picture */
    double max_overlap;       /* [m] */
    double max_overlap_share; /* over the smaller radius */
    double overlap_time;      /* [s] with any overlap beyond a tenth of the smaller radius */
    /* extent of the disturbed ice */
    double awake_floes; /* most at once */
    double reach;       /* farthest upstream of the structure's axis [m] */
    /* cost */
    double force_evaluations; /* one per contact and stage; of a lone floe per state that drag is asked at */
    double steps, rejected, macro_steps, rebuilds, touches, late_touches;
} fw_ledger;

double fw_ledger_energy_relative(const fw_ledger *l);
double fw_ledger_momentum_relative(const fw_ledger *l);
/* Balance of the trajectory: start + inflow + drag = dissipated + outflow + end, relative to what was dissipated or, where that is more, went
 * through springs; at least to a tenth of what water and air did to floes in contact, and to a thousandth of what floes brought.
 * start, end: kinetic plus stored energy of the awake floes [J]. */
double fw_ledger_energy_truncation(const fw_ledger *l, double start, double end);
/* What friction, dashpots and crushing gave instead of took, relative to the same; sums over all contacts. */
double fw_ledger_energy_given(const fw_ledger *l);
/* Floes that nobody can account for; n_now: awake ones. */
double fw_ledger_floes_lost(const fw_ledger *l, double n_now);
/* Share of the steps of all contacts in which slip chattered. */
double fw_ledger_chatter(const fw_ledger *l);

#endif
