/* One function per command; each parses its own arguments (argp), prints results to stdout and diagnostics to stderr, and
 * returns the program's exit code. argv[0] is the command's name. */
#ifndef FW_CLI_COMMANDS_H
#define FW_CLI_COMMANDS_H

int fw_cmd_run(int argc, char **argv);
int fw_cmd_plan(int argc, char **argv);
int fw_cmd_accuracy(int argc, char **argv);
int fw_cmd_scene(int argc, char **argv);
int fw_cmd_report(int argc, char **argv);
int fw_cmd_merge(int argc, char **argv);
int fw_cmd_status(int argc, char **argv);
int fw_cmd_keys(int argc, char **argv);
int fw_cmd_effects(int argc, char **argv);
int fw_cmd_laws(int argc, char **argv);

#endif
