/* `floewear effects` and `floewear laws`: reference tables, printed from the tables that act. */
#include <argp.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/json.h"
#include "cli/output.h"
#include "effects/effects.h"
#include "floewear/scenario.h"
#include "physics/abrasion.h"

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

int fw_cmd_effects(int argc, char **argv)
{
    bool is_json = false;
    argp_parse(&EFFECTS_ARGP, argc, argv, 0, NULL, &is_json);
    const fw_effect *e;
    size_t           n = fw_effects_list(&e);
    fw_model         m;
    fw_model_defaults(&m);
    if (is_json) {
        fw_json j = fw_json_onto(stdout);
        fw_json_begin_object(&j);
        fw_json_key(&j, "effects");
        fw_json_begin_array(&j);
        for (size_t i = 0; i < n; i++) {
            char reason[160];
            bool is_on = fw_effects_needed(&e[i], &m, reason, sizeof reason);
            fw_json_begin_object(&j);
            fw_json_key(&j, "name"), fw_json_string(&j, e[i].name);
            fw_json_key(&j, "on"), fw_json_bool(&j, is_on);
            fw_json_key(&j, "reason"), fw_json_string(&j, e[i].needed);
            fw_json_key(&j, "does"), fw_json_string(&j, e[i].does);
            fw_json_end(&j);
        }
        fw_json_end(&j);
        fw_json_end(&j);
        return fw_output_end("floewear effects");
    }
    for (size_t i = 0; i < n; i++)
        printf("%-13s %s\n%-13s %s\n%-13s off: %s\n", e[i].name, e[i].does, "", e[i].needed, "", e[i].off);
    printf("\nSwitch with `effects: auto`, a list of names, or a map {name: on | off} in a campaign or scene file.\n");
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
            fw_json_key(&j, "name"), fw_json_string(&j, all[i].law.name);
            fw_json_key(&j, "coefficient"), fw_json_number(&j, all[i].law.coefficient);
            fw_json_key(&j, "exponent"), fw_json_number(&j, all[i].law.exponent);
            fw_json_key(&j, "uses_temperature"), fw_json_bool(&j, all[i].law.uses_temperature);
            fw_json_key(&j, "equation"), fw_json_string(&j, all[i].equation);
            fw_json_key(&j, "source"), fw_json_string(&j, all[i].source);
            fw_json_key(&j, "range"), fw_json_string(&j, all[i].range);
            fw_json_key(&j, "remark"), fw_json_string(&j, all[i].remark);
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
