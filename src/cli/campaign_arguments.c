#include "cli/campaign_arguments.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/config.h"

bool fw_argument_number(const char *text, int64_t *out)
{
    char *end;
    errno = 0;
    *out = strtoll(text, &end, 10);
    return errno == 0 && end != text && *end == '\0' && *out >= 0;
}

error_t fw_argument_duration(const char *option, const char *text, struct argp_state *state, double *seconds)
{
    fw_msg    m = {.text = ""};
    fw_status s = fw_config_duration(text, seconds, &m);
    if (s == FW_OK && *seconds > 0) return 0;
    if (s == FW_E_NOMEM) return fw_argument_no_memory(state, &m);
    argp_error(state, "%s %s: %s", option, text, m.text[0] ? m.text : "more than 0 s is wanted");
    return EINVAL;
}

error_t fw_argument_no_memory(struct argp_state *state, const fw_msg *m)
{
    argp_failure(state, fw_status_exit_code(FW_E_NOMEM), 0, "%s", m->text);
    return ENOMEM;
}

error_t fw_campaign_arguments_parse(int key, char *text, struct argp_state *state, fw_campaign_arguments *a)
{
    fw_msg m = {.text = ""};
    switch (key) {
    case FW_KEY_SET:
        if (!strchr(text, '=')) {
            argp_error(state, "--set %s: KEY=VALUE is wanted", text);
            return EINVAL;
        }
        if (fw_grow(&a->sets, &a->sets_capacity, a->n_sets + 1, sizeof *a->sets, "--set", &m) != FW_OK)
            return fw_argument_no_memory(state, &m);
        a->sets[a->n_sets++] = text;
        return 0;
    case FW_KEY_SEED:
        if (fw_argument_number(text, &a->seed)) return 0;
        argp_error(state, "--seed %s: a whole number from 0 to %" PRId64 " is wanted", text, INT64_MAX);
        return EINVAL;
    case FW_KEY_BUDGET: return fw_argument_duration("--time-budget", text, state, &a->budget_s);
    case ARGP_KEY_ARG:
        if (state->arg_num > 0) {
            argp_error(state, "one campaign file is wanted, not also %s", text);
            return EINVAL;
        }
        a->campaign = text;
        return 0;
    case ARGP_KEY_END:
        if (a->campaign) return 0;
        argp_error(state, "which campaign file?");
        return EINVAL;
    default: return ARGP_ERR_UNKNOWN;
    }
}
