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

/* A window whose only contact is a floe that rolls off, or two that wind or tide carries side by side, dissipates some joules while drag moves some
 * kilojoules and floes bring some more: no sum of those can be right to a share of the former. Without, 15 of 600 windows of 5 minutes at 2 and 10 % ice
 * with wind, or all effects, failed for that; without the second alone 3 of 1200. */
static const double DRAGGED = 0.1, CARRIED = 1e-3;

/* What friction, dashpots and crushing are measured against, and a balance of energy at least. */
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
    through = fmax(through, fmax(DRAGGED * l->drag_size, CARRIED * (start + l->inflow)));
    return fabs(start + l->inflow + l->drag_work - (gone(l) + l->turned) - l->outflow - end) / through;
}

double fw_ledger_floes_lost(const fw_ledger *l, double n_now)
{
    return fabs(l->floes_start + l->floes_in - l->floes_out - n_now);
}

double fw_ledger_chatter(const fw_ledger *l) { return l->contact_steps > 0 ? l->chatter / l->contact_steps : 0; }
