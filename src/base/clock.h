/* The clocks that everybody reads. */
#ifndef FW_BASE_CLOCK_H
#define FW_BASE_CLOCK_H

double fw_seconds(void);     /* monotonic clock [s] */
double fw_cpu_seconds(void); /* processor time of this process [s] */

#endif
