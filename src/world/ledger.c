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

double fw_ledger_energy_truncation(const fw_ledger *l, double start, double end)
{
    double gone = l->dashpot + l->friction + l->dropped;
    if (!(gone > 0)) return 0;
    return fabs(start + l->inflow + l->drag_work - gone - l->outflow - end) / gone;
}
