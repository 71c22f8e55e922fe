#include "world/ledger.h"

#include <math.h>

double fw_ledger_energy_relative(const fw_ledger *l)
{
    return l->impulse_size > 0 ? fabs(l->kinetic_change - l->impulse_work) / l->impulse_size : 0;
}

double fw_ledger_momentum_relative(const fw_ledger *l)
{
    return l->momentum_size > 0 ? l->momentum_error / l->momentum_size : 0;
}

/* What a balance of energy is measured against. */
static double gone(const fw_ledger *l) { return l->dashpot + l->friction + l->dropped + (l->crushed + l->rolling); }
static double throughput(const fw_ledger *l) { return fmax(gone(l), l->into_springs); }

double fw_ledger_energy_given(const fw_ledger *l)
{
    double given = fmax(0, -l->friction) + fmax(0, -l->dashpot) + (fmax(0, -l->crushed) + fmax(0, -l->rolling));
    return given > 0 ? given / (given + fabs(throughput(l))) : 0;
}

double fw_ledger_energy_truncation(const fw_ledger *l, double start, double end)
{
    double through = throughput(l);
    if (!(through > 0)) return 0;
    return fabs(start + l->inflow + l->drag_work - (gone(l) + l->turned) - l->outflow - end) / through;
}

double fw_ledger_floes_lost(const fw_ledger *l, double n_now)
{
    return fabs(l->floes_start + l->floes_in - l->floes_out - n_now);
}

double fw_ledger_chatter(const fw_ledger *l) { return l->contact_steps > 0 ? l->chatter / l->contact_steps : 0; }
