/* floewear: the program. Finds the command and hands over; every command parses its own arguments. */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include <argp.h>
#include <gsl/gsl_errno.h>

#include "base/keys.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "floewear/status.h"

typedef struct command {
    const char *name;
    int (*call)(int argc, char **argv);
    const char *full_name; /* what messages call it */
    const char *meaning;
} command;

static const command main_commands[] = {
    {"run", fw_cmd_run, "floewear run", "run a campaign, alone or under mpirun; run again to go on"},
    {"plan", fw_cmd_plan, "floewear plan", "effects, accuracy settings, a pilot, predicted cost; --effects: what each effect moves"},
    {"scene", fw_cmd_scene, "floewear scene", "given floes, no sampling: the deterministic kernel alone"},
    {"accuracy", fw_cmd_accuracy, "floewear accuracy", "error against cost, measured on the campaign; run and plan use its choice"},
    {"report", fw_cmd_report, "floewear report", "percentiles with intervals, service life, ledgers of a results file"},
    {"merge", fw_cmd_merge, "floewear merge", "one campaign from results that were run in parts (run --ids)"},
    {"status", fw_cmd_status, "floewear status", "progress of a running or stopped campaign, from outside"},
    {"keys", fw_cmd_keys, "floewear keys", "every key of campaign and scene files"},
    {"effects", fw_cmd_effects, "floewear effects", "the effects and when a scene needs them"},
    {"laws", fw_cmd_laws, "floewear laws", "the abrasion laws and their ranges"},
};
enum { N_COMMANDS = sizeof main_commands / sizeof main_commands[0] };

static void main_help(FILE *to)
{
    fprintf(to, "floewear %s: Monte Carlo engine for long-term ice abrasion of offshore structures\n\n"
                "usage: floewear COMMAND [ARGUMENTS], mpirun -n RANKS floewear run CAMPAIGN.yaml\n\n", fw_version());
    for (int i = 0; i < N_COMMANDS; i++) fprintf(to, "  %-9s %s\n", main_commands[i].name, main_commands[i].meaning);
    fprintf(to, "\n`floewear COMMAND --help` tells a command's arguments; --version prints version and revision.\n"
                "Exit codes: 0 done, 2 wrong usage or input, 3 too many failed realisations, 4 input or output error,\n"
                "5 internal, 75 stopped early in good order (run again to go on).\n");
}

static int main_unknown(const char *word)
{
    const char *names[N_COMMANDS], *nearest;

    for (int i = 0; i < N_COMMANDS; i++) names[i] = main_commands[i].name;
    nearest = fw_keys_nearest_word(N_COMMANDS, names, word);
    fprintf(stderr, "floewear: there is no command '%s'", word);
    if (nearest) fprintf(stderr, "; did you mean '%s'?", nearest);
    fprintf(stderr, " (floewear --help lists them)\n");
    return 2;
}

int main(int argc, char **argv)
{
    signal(SIGXFSZ, SIG_IGN); /* a file size limit is a full disk: exit code 4, not a death by signal */
    gsl_set_error_handler_off(); /* GSL ends the program otherwise: without memory, or at a law far out of its range */
    argp_err_exit_status = 2; /* of argp in every command: wrong usage */
    if (argc < 2) {
        main_help(stderr);
        return 2;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
        main_help(stdout);
        return fw_output_end("floewear");
    }
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        printf("floewear %s (%s)\n", fw_version(), fw_git_revision());
        return fw_output_end("floewear");
    }
    for (int i = 0; i < N_COMMANDS; i++) {
        const command *c = &main_commands[i];
        char           name[32];

        if (strcmp(argv[1], c->name) != 0) continue;
        snprintf(name, sizeof name, "%s", c->full_name);
        argv[1] = name; /* argp and getopt begin their messages with it */
        return c->call(argc - 1, argv + 1);
    }
    return main_unknown(argv[1]);
}
