/* Shared by the tests of campaign and scene files. */
#ifndef FW_TESTS_CLI_CONFIG_CHECK_H
#define FW_TESTS_CLI_CONFIG_CHECK_H

#include <stdio.h>
#include <string.h>

#include "cli/config.h"

#define GOOD FW_SOURCE_DIR "/tests/cli/good/"

/* A campaign given as text; its tables are looked for beside the good files. m is emptied first. */
static inline fw_status read_campaign_text(fw_campaign *c, const char *text, fw_msg *m)
{
    memset(m, 0, sizeof *m);
    return fw_config_campaign_text(c, GOOD "made.yaml", text, strlen(text), 0, NULL, -1, m);
}

#endif
