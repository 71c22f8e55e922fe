#include "realisation/verdict.h"

#include <math.h>

/* What floating point leaves of sums that are reached on two ways: 5e-13 after 3 h of dense ice. */
static const double BOOKS = 1e-10;
/* What solved contacts leave of a dashpot that is none, over what goes through springs: 5e-9 in a crowd without damping. */
static const double GIVEN = 1e-6;
/* Share of the contacts' steps whose slip jumps to and fro between the caps of friction: none has been seen in a sound run, beyond the
 * limit of an explicit scheme it is most of them. */
static const double CHATTER = 1e-3;

static bool is_ring_sound(const fw_record *r)
{
    size_t n = fw_record_n_rings(r->n_arcs, r->n_laws);
    for (size_t i = 0; i < n; i++)
        if (!(r->rings[i] >= 0 && isfinite(r->rings[i]))) return false;
    return true;
}

fw_status fw_verdict(const fw_record *r, const fw_world *w, double energy_tolerance, fw_msg *m)
{
    double lost = fw_ledger_floes_lost(&w->ledger, (double)w->n_bodies);
    const struct law {
        const char *name;
        double      value, most;
    } LAWS[] = {
        {"largest overlap over the smaller radius", r->max_overlap_share, 0.999999},
        {"floes that nobody can account for", lost, 0},
        {"energy bookkeeping (impulses times mean velocities against the change of kinetic energy)", r->energy_relative, BOOKS},
        {"momentum bookkeeping (impulses against the change of momentum)", r->momentum_relative, BOOKS},
        {"wear load on the ring against the patch integral", r->wear_conservation, BOOKS},
        {"energy given by friction or dashpots", fw_ledger_energy_given(&w->ledger), GIVEN},
        {"slip chatter, share of the contacts' steps", r->slip_chatter, CHATTER},
        {"energy balance of the trajectory", r->energy_truncation, energy_tolerance},
    };
    for (size_t i = 0; i < sizeof LAWS / sizeof LAWS[0]; i++)
        FW_CHECK(LAWS[i].value <= LAWS[i].most, m, FW_E_NUMERIC, "%s: %.3g, wanted at most %.3g", LAWS[i].name, LAWS[i].value, LAWS[i].most);
    FW_CHECK(is_ring_sound(r), m, FW_E_NUMERIC, "path or wear load of an arc is negative or not finite");
    return FW_OK;
}
