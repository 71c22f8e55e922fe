/* Rows of the ledger: effects that are off, and the contact law that was not taken. */
#include <math.h>

#include "study/ledger_inside.h"

/* Of the design number of this run, in which the effect is off: it may have been on where it was measured, and was left out since. */
static double amount_of(const fw_effects_row *e)
{
    const fw_change *c = isnan(e->percentile.change) ? &e->mean : &e->percentile;
    double           amount = fabs(e->was_on ? -c->change / (1 + c->change) : c->change), error = 0.25 * (c->high - c->low);
    return error > amount ? error : amount; /* what scatter hides may be as large as the scatter */
}

static void say_change(char *to, size_t size, const fw_change *c)
{
    if (isnan(c->change))
        fw_ledger_write(to, size, "-");
    else if (isnan(c->low) || isnan(c->high))
        fw_ledger_write(to, size, "%+.2g %%", 100 * c->change);
    else
        fw_ledger_write(to, size, "%+.3g [%+.3g, %+.3g] %%", 100 * c->change, 100 * c->low, 100 * c->high);
}

static void switched_off(fw_ledger_row *row, const fw_effects_ledger *l, const fw_effects_row *e, const fw_window *w)
{
    char   mean[64], percentile[64];
    double factor = e->was_on ? 1 / (1 - e->evaluations_saved) : 1 - e->evaluations_saved, cpu = e->was_on ? 1 / (1 - e->cpu_saved) : 1 - e->cpu_saved;
    say_change(mean, sizeof mean, &e->mean);
    say_change(percentile, sizeof percentile, &e->percentile);
    SAY(row->row, "%s", e->name);
    row->amount = amount_of(e);
    SAY(row->shrinks_with, "effects: {%s: on}; %s gave mean %s, P%g %s, measured %.90s", e->name, e->change, mean, l->percentile, percentile, l->origin);
    SAY(row->cost_to_halve, "all again with it, %.3g times the work (%.3g force evaluations)", factor, factor * w->depth->evaluations);
    row->cost_to_halve_cpu_s = cpu * w->depth->cpu_s;
}

size_t fw_ledger_effects(fw_ledger_row *row, const fw_campaign *c, const fw_effects_ledger *l, const fw_window *w)
{
    fw_ledger_row *sum = row++;
    double         amount = 0;
    if (l->n_rows == 0) {
        fw_ledger_unmeasured(sum, "switched-off effects", "floewear plan --effects measures what they move");
        return 1;
    }
    for (size_t i = 0; i < l->n_rows; i++) {
        const fw_effects_row *e = &l->rows[i];
        if (!e->bit || (c->model.effects & e->bit) || e->note[0] || e->bit == FW_EFFECT_CRUSH_CONTACT) continue;
        switched_off(row, l, e, w);
        if (row->amount > 0) amount += row->amount;
        row++;
    }
    SAY(sum->row, "switched-off effects");
    sum->is_sum = true;
    sum->amount = amount;
    SAY(sum->shrinks_with, "%s", row > sum + 1 ? "the rows below, summed as if they all went one way" : "none is off that could be on here");
    SAY(sum->cost_to_halve, "%s", row > sum + 1 ? "see there" : "none");
    return (size_t)(row - sum);
}

/* Spring or ice that crushes: two models of one contact, of which neither is left out. */
void fw_ledger_contact_law(fw_ledger_row *row, const fw_campaign *c, const fw_effects_ledger *l, const fw_window *w)
{
    const fw_effects_row *e = NULL;
    for (size_t i = 0; i < l->n_rows; i++)
        if (l->rows[i].bit == FW_EFFECT_CRUSH_CONTACT && !l->rows[i].note[0]) e = &l->rows[i];
    if (!e) {
        fw_ledger_unmeasured(row, "contact law", "floewear plan --effects sets spring and crushing side by side");
        return;
    }
    bool is_crush = (c->model.effects & FW_EFFECT_CRUSH_CONTACT) != 0;
    char mean[64], percentile[64];
    say_change(mean, sizeof mean, &e->mean);
    say_change(percentile, sizeof percentile, &e->percentile);
    SAY(row->row, "contact law");
    row->amount = amount_of(e);
    SAY(row->shrinks_with, "ice that is known: here %s; %s gave mean %s, P%g %s, measured %.80s", is_crush ? "it crushes" : "a spring",
        is_crush ? "the spring" : "crushing", mean, l->percentile, percentile, l->origin);
    double factor = e->was_on ? 1 / (1 - e->evaluations_saved) : 1 - e->evaluations_saved, cpu = e->was_on ? 1 / (1 - e->cpu_saved) : 1 - e->cpu_saved;
    SAY(row->cost_to_halve, "all again with the other one, %.3g times the work (%.3g force evaluations)", factor, factor * w->depth->evaluations);
    row->cost_to_halve_cpu_s = cpu * w->depth->cpu_s;
}
