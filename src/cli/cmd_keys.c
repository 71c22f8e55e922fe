/* `floewear keys`: the reference of every key. */
#include <argp.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/config.h"
#include "cli/output.h"

typedef struct options {
    bool as_json;
} options;

static error_t parse(int key, char *arg, struct argp_state *state)
{
    options *o = state->input;

    (void)arg;
    switch (key) {
    case 'j': o->as_json = true; return 0;
    case ARGP_KEY_ARG: argp_error(state, "this command takes no files"); return EINVAL;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int fw_cmd_keys(int argc, char **argv)
{
    static const struct argp_option rows[] = {{"json", 'j', NULL, 0, "print JSON", 0}, {0}};
    static const struct argp        argp = {
               rows, parse, NULL, "Print every key of campaign and scene files: unit, range, default, meaning.",
               NULL, NULL,  NULL};
    options o = {false};

    argp_err_exit_status = fw_status_exit_code(FW_E_ARG);
    if (argp_parse(&argp, argc, argv, 0, NULL, &o) != 0) return fw_status_exit_code(FW_E_ARG);
    fw_config_print_keys(stdout, o.as_json);
    return fw_output_end("floewear keys");
}
