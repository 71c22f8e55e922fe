/* Stop requests: the first SIGINT, SIGTERM, SIGUSR1, SIGUSR2 or SIGHUP asks for an orderly end, a second one ends the
 * process at once. mpirun turns its own SIGINT and SIGTERM into SIGTERM for every rank (and SIGKILL a second later);
 * SIGUSR1 and SIGUSR2 it passes on, and Slurm sends them ahead of a time limit. */
#ifndef FW_CAMPAIGN_SIGNALS_H
#define FW_CAMPAIGN_SIGNALS_H

#include "floewear/status.h"

void fw_signals_catch(void);     /* install the handlers; SIGHUP stays ignored under nohup */
int  fw_signals_received(void);  /* the first signal's number, or 0 */
/* An fw_tick's call: FW_E_STOPPED after a signal. self is not used. */
fw_status fw_signals_tick(void *self, double done);

#endif
