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
static double throughput(const fw_ledger *l) { return fmax(l->dashpot + l->friction + l->dropped, l->into_springs); }

double fw_ledger_energy_given(const fw_ledger *l)
{
    double given = fmax(0, -l->friction) + fmax(0, -l->dashpot);
    return given > 0 ? given / (given + fabs(throughput(l))) : 0;
}

double fw_ledger_energy_truncation(const fw_ledger *l, double start, double end)
{
    double gone = l->dashpot + l->friction + l->dropped, through = throughput(l);
    if (!(through > 0)) return 0;
    return fabs(start + l->inflow + l->drag_work - gone - l->outflow - end) / through;
}

double fw_ledger_floes_lost(const fw_ledger *l, double n_now)
{
    return fabs(l->floes_start + l->floes_in - l->floes_out - n_now);
}

double fw_ledger_chatter(const fw_ledger *l) { return l->contact_steps > 0 ? l->chatter / l->contact_steps : 0; }
