/* `floewear effects` and `floewear laws`: reference tables, printed from the tables that act. */
#include <argp.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/json.h"
#include "cli/output.h"
#include "effects/effects.h"
#include "floewear/scenario.h"
#include "physics/abrasion.h"
#include "realisation/facts.h"

enum { KEY_JSON = 1000 };

static error_t parse(int key, char *arg, struct argp_state *state)
{
    bool *is_json = state->input;
    if (key == KEY_JSON)
        *is_json = true;
    else if (key == ARGP_KEY_ARG)
        argp_error(state, "no argument is expected, not '%s'", arg);
    else
        return ARGP_ERR_UNKNOWN;
    return 0;
}

static const struct argp_option OPTIONS[] = {{"json", KEY_JSON, NULL, 0, "print JSON", 0}, {0}};
static const struct argp EFFECTS_ARGP = {OPTIONS, parse, NULL, "Prints the effects, and when a scene needs them.",
                                         NULL,    NULL,  NULL};
static const struct argp LAWS_ARGP = {OPTIONS, parse, NULL, "Prints the abrasion laws and their ranges.",
                                      NULL,    NULL,  NULL};

/* The reference is of every effect; `on` is what auto makes of the default model in 40 % ice. */
static fw_status reference_facts(fw_model *m, fw_scene_facts *f, fw_msg *msg)
{
    fw_site site = {0};
    fw_model_defaults(m);
    fw_distribution_constant(&site.speed, 1);
    fw_distribution_constant(&site.concentration, 0.4);
    return fw_facts_campaign(m, &site, f, msg);
}

static void print_effects_json(const fw_model *m, const fw_scene_facts *f)
{
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    fw_json                 j = fw_json_onto(stdout);
    fw_json_begin_object(&j);
    fw_json_key(&j, "effects");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < n; i++) {
        char reason[FW_REASON_SIZE];
        fw_json_begin_object(&j);
        fw_json_put_string(&j, "name", e[i]->name);
        fw_json_put_bool(&j, "on", e[i]->is_needed(m, f, reason));
        fw_json_put_string(&j, "reason", e[i]->needed);
        fw_json_put_string(&j, "does", e[i]->does);
        fw_json_put_string(&j, "equation", e[i]->equation);
        fw_json_put_string(&j, "source", e[i]->source);
        fw_json_put_string(&j, "range", e[i]->range);
        fw_json_put_string(&j, "limit", e[i]->limit);
        fw_json_put_string(&j, "off", e[i]->off);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_end(&j);
}

static void print_effects(void)
{
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    for (size_t i = 0; i < n; i++) {
        printf("%-14s %s\n", e[i]->name, e[i]->does);
        printf("  %-12s %s\n  %-12s %s\n  %-12s %s\n  %-12s %s\n", "equation", e[i]->equation, "source", e[i]->source, "range", e[i]->range, "limit case",
               e[i]->limit);
        printf("  %-12s %s\n  %-12s %s\n", "when", e[i]->needed, "off", e[i]->off);
    }
    printf("\nSwitch with `effects: auto`, a list of names, or a map {name: on | off} in a campaign or scene file.\n");
}

int fw_cmd_effects(int argc, char **argv)
{
    bool is_json = false;
    argp_parse(&EFFECTS_ARGP, argc, argv, 0, NULL, &is_json);
    fw_model       m;
    fw_scene_facts f;
    fw_msg         msg = {""};
    fw_status      s = reference_facts(&m, &f, &msg);
    if (s != FW_OK) {
        fprintf(stderr, "floewear effects: %s\n", msg.text);
        return fw_status_exit_code(s);
    }
    if (is_json)
        print_effects_json(&m, &f);
    else
        print_effects();
    return fw_output_end("floewear effects");
}

int fw_cmd_laws(int argc, char **argv)
{
    bool is_json = false;
    argp_parse(&LAWS_ARGP, argc, argv, 0, NULL, &is_json);
    const fw_abrasion_entry *all;
    size_t                   n = fw_abrasion_list(&all);
    if (is_json) {
        fw_json j = fw_json_onto(stdout);
        fw_json_begin_object(&j);
        fw_json_key(&j, "laws");
        fw_json_begin_array(&j);
        for (size_t i = 0; i < n; i++) {
            fw_json_begin_object(&j);
            fw_json_put_string(&j, "name", all[i].law.name);
            fw_json_put_number(&j, "coefficient", all[i].law.coefficient);
            fw_json_put_number(&j, "exponent", all[i].law.exponent);
            fw_json_put_bool(&j, "uses_temperature", all[i].law.uses_temperature);
            fw_json_put_string(&j, "equation", all[i].equation);
            fw_json_put_string(&j, "source", all[i].source);
            fw_json_put_string(&j, "range", all[i].range);
            fw_json_put_string(&j, "remark", all[i].remark);
            fw_json_end(&j);
        }
        fw_json_end(&j);
        fw_json_end(&j);
        return fw_output_end("floewear laws");
    }
    for (size_t i = 0; i < n; i++)
        printf("%-12s %s\n%-12s source: %s\n%-12s range: %s\n%-12s %s\n", all[i].law.name, all[i].equation, "",
               all[i].source, "", all[i].range, "", all[i].remark);
    printf("%-12s rate = coefficient sigma^exponent, 0 < exponent < 2: your own, as {power: {coefficient: .., "
           "exponent: ..}}\n",
           "power");
    return fw_output_end("floewear laws");
}
