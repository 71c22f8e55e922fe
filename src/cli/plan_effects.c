#include "cli/plan_effects.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "campaign/signals.h"
#include "cli/choice.h"
#include "cli/config.h"
#include "cli/effects_print.h"
#include "cli/effects_tables.h"
#include "cli/output.h"
#include "cli/study_run.h"
#include "effects/effects.h"
#include "realisation/facts.h"

static const double USUAL_S = 300;

/* An effect's row says itself why it cannot be switched on here. Keys of the contact law that speak against the other law are no reason: that is
 * the question. */
static const char *refusal(const fw_campaign *c, const fw_scene_facts *facts, const fw_effect *e)
{
    fw_model       model = c->model;
    fw_scene_facts f = *facts;
    const char    *key = NULL;
    model.effects |= (uint32_t)e->bit;
    f.given &= ~(uint32_t)(FW_GIVEN_LAW_SPRING | FW_GIVEN_ADDED_MASS_OFF | FW_GIVEN_DEFLECTED_OFF);
    model.given = f.given;
    return e->refuse(&model, &f, &key);
}

/* switches: (FW_EFFECTS_MOST) */
static fw_status list_switches(const fw_campaign *c, fw_effects_switch *switches, size_t *n, fw_msg *m)
{
    const fw_effect *const *e;
    fw_scene_facts          facts;
    FW_TRY(fw_facts_campaign(&c->model, &c->site, &facts, m));
    *n = fw_effects_list(&e);
    FW_CHECK(*n <= FW_EFFECTS_MOST, m, FW_E_INTERNAL, "%zu effects, room for %d", *n, (int)FW_EFFECTS_MOST);
    for (size_t i = 0; i < *n; i++) {
        bool is_on = fw_effects_have(&c->model, e[i]->bit);
        switches[i] = (fw_effects_switch){
            .name = e[i]->name, .bit = (uint32_t)e[i]->bit, .no_data = is_on ? NULL : refusal(c, &facts, e[i]), .why = is_on ? e[i]->off : e[i]->does};
    }
    return FW_OK;
}

static fw_status measure(const fw_plan_effects_wanted *w, const fw_campaign *c, const char *path, fw_effects_ledger *l, fw_msg *m)
{
    fw_effects_switch  switches[FW_EFFECTS_MOST];
    fw_study_watch     watch = fw_study_watch_start(0, w->is_quiet);
    fw_tick            tick = fw_study_watch_tick(&watch);
    fw_effects_options o = {.scenario = fw_campaign_plain_scenario,
                            .switches = switches,
                            .cpu_budget_s = w->cpu_budget_s > 0 ? w->cpu_budget_s : USUAL_S,
                            .n_windows = w->n_windows,
                            .way = INFINITY,
                            .tick = &tick,
                            .say = fw_study_watch_say,
                            .say_self = &watch};
    FW_TRY(list_switches(c, switches, &o.n_switches, m));
    FW_TRY(fw_study_watch_end(&watch, fw_effects_ledger_make(l, c, &o, m), m));
    FW_TRY(fw_effects_tables_write(path, c, l, m));
    if (w->is_json)
        fw_effects_print_json(stdout, c, l);
    else
        fw_effects_print_text(stdout, c, l);
    FW_TRY(fw_output_finish(m));
    if (!w->is_quiet) fprintf(stderr, "%s: %.3g CPU s; run, plan and report of this campaign show it\n", path, l->cpu_s_study);
    return FW_OK;
}

fw_status fw_plan_effects(const fw_plan_effects_wanted *w, fw_msg *m)
{
    char               path[4096];
    fw_campaign        c;
    fw_effects_ledger *l = NULL;
    FW_TRY(fw_study_check_alone(m));
    fw_signals_catch();
    FW_TRY(fw_config_campaign(&c, w->campaign, w->n_sets, w->sets, w->seed, m));
    fw_status s = fw_choice_path(path, sizeof path, w->out ? w->out : c.name, FW_CHOICE_EFFECTS, m);
    if (s == FW_OK) s = fw_study_check_place(path, FW_EFFECTS_FILETYPE, m);
    if (s == FW_OK) s = fw_alloc(&l, 1, sizeof *l, "effects ledger", m);
    if (s == FW_OK) s = measure(w, &c, path, l, m);
    free(l);
    fw_campaign_free(&c);
    return s;
}
