/* The rows of the effects ledger: one line each in the table below, and the ways of running that measure them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/effects_inside.h"

/* ---- the open choices of the model ------------------------------------------------------------------------------- */

enum { SET, TIMES, TEMPERATURE };

/* What the source paper leaves open, or gives without a unit or source, and another sensible value of it. */
static const struct choice {
    const char *key;
    uint32_t    needs;  /* the effect without which the number is not used; 0: none */
    int         how;    /* SET a member of the model to value, TIMES: multiply it; TEMPERATURE: after the run */
    size_t      offset; /* of the member */
    double      value;
    const char *why;
} CHOICES[] = {
    {"water.form_drag", FW_EFFECT_FORM_DRAG, SET, offsetof(fw_model, form_drag), 0.9, "the literature's coefficient of a side area; the paper's 10 has no area"},
    {"contact.friction", FW_EFFECT_FRICTION, SET, offsetof(fw_model, friction), 0.05, "wet smooth concrete; more friction turns floes sooner, and they slide less"},
    {"contact.friction", FW_EFFECT_FRICTION, SET, offsetof(fw_model, friction), 0.2, "rough concrete; see above"},
    {"contact.stiffness", 0, TIMES, offsetof(fw_model, stiffness), 0.5, "the paper's is calibrated with finite elements, one number for all floes"},
    {"contact.stiffness", 0, TIMES, offsetof(fw_model, stiffness), 2, "see above"},
    {"contact.slip_damping_ratio", FW_EFFECT_FRICTION, SET, offsetof(fw_model, slip_damping_ratio), 0.1, "the paper gives none; a weaker one slides longer before friction is at its cap"},
    {"ice.temperature", 0, TEMPERATURE, 0, -2, "the law's rate goes as |T|^-m, most near melting; a factor, exact"},
};
enum { N_CHOICES = sizeof CHOICES / sizeof CHOICES[0] };

/* ---- sets -------------------------------------------------------------------------------------------------------- */

/* Without the first nothing is left of the second. */
static const struct goes_with {
    uint32_t without, off;
} GOES_WITH[] = {
    {FW_EFFECT_FLOE_CONTACT, FW_EFFECT_ICE_ON_ICE},
    {FW_EFFECT_FORM_DRAG | FW_EFFECT_SKIN_DRAG, FW_EFFECT_DEFLECTED_FLOW},
};

static uint32_t switched_off(uint32_t set, uint32_t bit)
{
    set &= ~bit;
    for (size_t k = 0; k < sizeof GOES_WITH / sizeof GOES_WITH[0]; k++)
        if (!(set & GOES_WITH[k].without)) set &= ~GOES_WITH[k].off;
    return set;
}

/* Order of the cost shares: what was added last goes first; of the core rotation before the friction that drives it, drag last, because floes that nothing
 * carries away fill the place and cost more than all the rest. */
static const uint32_t LAST_OFF[] = {FW_EFFECT_ROTATION, FW_EFFECT_FRICTION, FW_EFFECT_FLOE_CONTACT, FW_EFFECT_FORM_DRAG};

static uint32_t next_off(uint32_t set)
{
    for (uint32_t bit = 1u << 31; bit > FW_EFFECTS_CORE; bit >>= 1)
        if (set & bit) return bit;
    for (size_t k = 0; k < sizeof LAST_OFF / sizeof LAST_OFF[0]; k++)
        if (set & LAST_OFF[k]) return LAST_OFF[k];
    return 0;
}

/* ---- arms -------------------------------------------------------------------------------------------------------- */

static size_t add_arm(fw_effects_plan *p, const fw_campaign *c)
{
    fw_effects_arm *arm = &p->arms[p->n_arms];
    arm->campaign = *c;
    return p->n_arms++;
}

/* The campaign with another set of effects; the arm that there is already, if there is one. */
static size_t arm_of_set(fw_effects_plan *p, const fw_campaign *c, uint32_t set)
{
    for (size_t k = 0; k < p->n_arms; k++)
        if (p->arms[k].campaign.model.effects == set) return k;
    size_t k = add_arm(p, c);
    p->arms[k].campaign.model.effects = set;
    return k;
}

static bool is_possible(const fw_campaign *c, uint32_t set, fw_msg *why)
{
    fw_model model = c->model;
    model.effects = set;
    return fw_model_check(&model, why) == FW_OK;
}

/* Models that are refused are rows with the reason. */
static bool may_run(const fw_campaign *c, uint32_t set, fw_effects_row *row)
{
    fw_msg why = {""};
    if (is_possible(c, set, &why)) return true;
    snprintf(row->note, sizeof row->note, "not possible here: %.130s", why.text);
    return false;
}

static fw_effects_row *add_row(fw_effects_ledger *l, const char *name, const char *why)
{
    fw_effects_row *row = &l->rows[l->n_rows++];
    snprintf(row->name, sizeof row->name, "%s", name);
    snprintf(row->why, sizeof row->why, "%s", why);
    row->mean = row->percentile = (fw_change){NAN, NAN, NAN};
    row->evaluations_saved = row->cpu_saved = row->evaluations_share = row->cpu_share = NAN;
    return row;
}

static void add_effect(fw_effects_plan *p, fw_effects_ledger *l, const fw_campaign *c, const fw_effects_switch *s)
{
    uint32_t        own = c->model.effects;
    bool            was_on = (own & s->bit) != 0;
    fw_effects_row *row = add_row(l, s->name, s->why);
    row->is_effect = true, row->was_on = was_on, row->bit = s->bit;
    snprintf(row->change, sizeof row->change, was_on ? "on -> off" : "off -> on");
    if (!was_on && s->no_data) {
        snprintf(row->note, sizeof row->note, "not asked for: %.140s", s->no_data);
        return;
    }
    uint32_t set = was_on ? switched_off(own, s->bit) : own | s->bit;
    if (may_run(c, set, row)) p->arm[row - l->rows] = arm_of_set(p, c, set);
}

static void add_choice(fw_effects_plan *p, fw_effects_ledger *l, const fw_campaign *c, const struct choice *choice)
{
    fw_effects_row *row = add_row(l, choice->key, choice->why);
    fw_campaign     own = *c;
    if (choice->how == TEMPERATURE) {
        snprintf(row->change, sizeof row->change, "-> %g degC", choice->value);
        if (!c->model.laws[0].uses_temperature) {
            snprintf(row->note, sizeof row->note, "the law %s has no temperature", c->model.laws[0].name);
            return;
        }
        fw_distribution_constant(&own.site.temperature, choice->value);
    } else {
        double *member = (double *)((char *)&own.model + choice->offset), before = *member;
        *member = choice->how == TIMES ? before * choice->value : choice->value;
        snprintf(row->change, sizeof row->change, "%g -> %g", before, *member);
        if (*member == before)
            snprintf(row->note, sizeof row->note, "the campaign's own value");
        else if (choice->needs && !(c->model.effects & choice->needs))
            snprintf(row->note, sizeof row->note, "not used here");
        else if (choice->offset == offsetof(fw_model, stiffness) && c->model.stiffness_from_pressure)
            snprintf(row->note, sizeof row->note, "not used here: stiffness comes from the ice's pressure");
        if (row->note[0] || !may_run(&own, own.model.effects, row)) return;
    }
    size_t k = add_arm(p, &own);
    p->arms[k].is_read = choice->how == TEMPERATURE;
    p->arm[row - l->rows] = k;
}

/* An effect that the model cannot do without (a crushing limit under an exponent of 2) stays, and is part of the bare rest. */
static void add_chain(fw_effects_plan *p, const fw_effects_ledger *l, const fw_campaign *c, size_t n, const fw_effects_switch *switches)
{
    uint32_t set = c->model.effects, stays = 0, bit;
    p->chain[p->n_chain++] = 0;
    while ((bit = next_off(set & ~stays)) != 0) {
        uint32_t next = switched_off(set, bit);
        if (!is_possible(c, next, NULL)) {
            stays |= bit;
            continue;
        }
        for (size_t i = 0; i < n && i < l->n_rows; i++)
            if (switches[i].bit == bit) p->what_is_off[p->n_chain - 1] = i;
        p->chain[p->n_chain++] = arm_of_set(p, c, next);
        set = next;
    }
}

fw_status fw_effects_plan_make(fw_effects_plan *p, fw_effects_ledger *l, const fw_campaign *c, size_t n, const fw_effects_switch *switches, fw_msg *m)
{
    memset(p, 0, sizeof *p);
    uint32_t known = 0;
    FW_CHECK(n <= FW_EFFECTS_MOST, m, FW_E_ARG, "%zu effects: wanted at most %d", n, FW_EFFECTS_MOST);
    for (size_t i = 0; i < n; i++) known |= switches[i].bit;
    FW_CHECK(!(c->model.effects & ~known), m, FW_E_ARG, "the campaign has effects (bits %x) that are not among those to be switched", c->model.effects & ~known);
    FW_TRY(fw_alloc(&p->arms, FW_EFFECTS_ARMS, sizeof *p->arms, "arms of the effects ledger", m));
    add_arm(p, c);
    for (size_t i = 0; i < n; i++) add_effect(p, l, c, &switches[i]);
    for (size_t i = 0; i < N_CHOICES; i++) add_choice(p, l, c, &CHOICES[i]);
    add_chain(p, l, c, n, switches);
    return FW_OK;
}

void fw_effects_plan_free(fw_effects_plan *p)
{
    for (size_t k = 0; p->arms && k < p->n_arms; k++) {
        fw_depth_free(&p->arms[k].depth);
        free(p->arms[k].row);
    }
    free(p->arms);
    memset(p, 0, sizeof *p);
}
