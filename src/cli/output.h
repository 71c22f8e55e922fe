/* The end of standard output: what a command printed has to have arrived, or the command has failed. */
#ifndef FW_CLI_OUTPUT_H
#define FW_CLI_OUTPUT_H

#include "floewear/status.h"

/* Flush stdout; FW_E_IO with the system's reason when anything printed so far did not get out. */
fw_status fw_output_finish(fw_msg *m);

/* The same as the last line of a command that has nothing else to report: prints "NAME: ..." on failure, returns the exit code. */
int fw_output_end(const char *name);

#endif
