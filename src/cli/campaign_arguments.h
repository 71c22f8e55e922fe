/* What `run` and `accuracy` are told about the campaign on the command line: its file, --set, --seed, --time-budget. */
#ifndef FW_CLI_CAMPAIGN_ARGUMENTS_H
#define FW_CLI_CAMPAIGN_ARGUMENTS_H

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"

typedef struct fw_campaign_arguments {
    const char  *campaign; /* the file; borrowed from argv, as the sets are */
    const char **sets;     /* (n_sets); owned, free() it */
    size_t       n_sets, sets_capacity;
    int64_t      seed; /* < 0: the file's */
    double       budget_s;
} fw_campaign_arguments;

/* Keys of the options; a command's own keys are other numbers. */
enum { FW_KEY_SET = 0x1000, FW_KEY_SEED, FW_KEY_BUDGET };
#define FW_OPTION_SET \
    {"set", FW_KEY_SET, "KEY=VALUE", 0, "change one key of the file, as in ice.concentration=60%; may be repeated", 0}
#define FW_OPTION_SEED {"seed", FW_KEY_SEED, "N", 0, "instead of the file's seed", 0}

/* The rest of a command's argp parser: these options, one campaign file, not none. ARGP_ERR_UNKNOWN: not ours. */
error_t fw_campaign_arguments_parse(int key, char *text, struct argp_state *state, fw_campaign_arguments *a);

/* A whole number from 0 on, and nothing behind it. */
bool fw_argument_number(const char *text, int64_t *out);
/* A duration of more than 0 s; says what is wrong with the option's. */
error_t fw_argument_duration(const char *option, const char *text, struct argp_state *state, double *seconds);

/* argp's own errors are wrong usage: this one is said and leaves with FW_E_NOMEM's code, or is returned where argp must not
 * end the program. */
error_t fw_argument_no_memory(struct argp_state *state, const fw_msg *m);

#endif
