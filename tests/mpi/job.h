/* Start a command line as a test's child, gather what it prints, wait for it, signal it, or kill it with all its
 * ranks. */
#ifndef TESTS_MPI_JOB_H
#define TESTS_MPI_JOB_H

#include <stdbool.h>
#include <sys/types.h>

typedef struct fw_job {
    pid_t pid;
    char  out[4096], err[4096]; /* names of the files that take stdout and stderr */
} fw_job;

/* argv is NULL-terminated; its output goes to FOLDER/NAME.out and .err. n_ranks > 0 puts mpirun -n N before it. */
fw_job fw_job_start(const char *folder, const char *name, int n_ranks, const char *const *argv);
/* Exit code, or 128 + signal; after timeout_s it is killed and -1 comes back. */
int    fw_job_wait(fw_job *j, double timeout_s);
bool   fw_job_is_over(const fw_job *j); /* it has ended by itself; fw_job_wait will not wait */
/* Wait until its stderr says word n times; false after 20 s. */
bool   fw_job_wait_for(const fw_job *j, const char *word, int n);
void   fw_job_signal(const fw_job *j, int number);
/* kill -9 for the process and everything it started, and wait until all are gone. */
void   fw_job_kill(fw_job *j);
/* A process id of some rank (a child of mpirun), 0 when there is none yet. */
pid_t  fw_job_rank(const fw_job *j, int which);
/* Whole file as text, NUL-terminated, to be freed; NULL when there is none. n_bytes may be NULL. */
char  *fw_job_read(const char *path, size_t *n_bytes);

/* Start and wait; the child's output in files as above. */
int    fw_job_run(const char *folder, const char *name, int n_ranks, const char *const *argv);

void   fw_job_sleep(double seconds);
double fw_job_seconds(void);
void   fw_job_make_folder(char *path, size_t size, const char *name); /* a new empty folder for this test */
void   fw_job_remove_folder(const char *path);                        /* with its files; no folders inside */

#endif
