#include "mpi/job.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MAX_ARGUMENTS = 64, MAX_FAMILY = 64 };

double fw_job_seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void fw_job_sleep(double seconds)
{
    struct timespec t = {.tv_sec = (time_t)seconds, .tv_nsec = (long)(1e9 * (seconds - (double)(time_t)seconds))};

    nanosleep(&t, NULL);
}

fw_job fw_job_start(const char *folder, const char *name, int n_ranks, const char *const *argv)
{
    const char *line[MAX_ARGUMENTS];
    char        count[16];
    fw_job      j;
    int         n = 0;

    snprintf(j.out, sizeof j.out, "%s/%s.out", folder, name);
    snprintf(j.err, sizeof j.err, "%s/%s.err", folder, name);
    if (n_ranks > 0) {
        snprintf(count, sizeof count, "%d", n_ranks);
        line[n++] = "mpirun";
        line[n++] = "-q";
        line[n++] = "--oversubscribe";
        line[n++] = "-n";
        line[n++] = count;
    }
    while (*argv && n < MAX_ARGUMENTS - 1) line[n++] = *argv++;
    line[n] = NULL;

    unlink(j.out); /* nobody shall read what the last job of this name said */
    unlink(j.err);
    j.pid = fork();
    if (j.pid == 0) {
        int in = open("/dev/null", O_RDONLY), out = open(j.out, O_WRONLY | O_CREAT | O_TRUNC, 0666),
            err = open(j.err, O_WRONLY | O_CREAT | O_TRUNC, 0666);

        setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
        setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
        dup2(in, 0);
        dup2(out, 1);
        dup2(err, 2);
        execvp(line[0], (char *const *)(void *)line);
        _exit(127);
    }
    return j;
}

static void job_show(const fw_job *j, int code)
{
    char *text = fw_job_read(j->err, NULL);

    fprintf(stderr, "exit code %d: %s\n", code, text ? text : "");
    free(text);
}

int fw_job_wait(fw_job *j, double timeout_s)
{
    double end    = fw_job_seconds() + timeout_s;
    int    status = 0;

    while (waitpid(j->pid, &status, WNOHANG) == 0) {
        if (fw_job_seconds() > end) {
            fw_job_kill(j);
            return -1;
        }
        fw_job_sleep(0.005);
    }
    j->pid = 0;
    status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (status == 1 || status > 75) job_show(j, status); /* none of floewear's own */
    return status;
}

bool fw_job_is_over(const fw_job *j)
{
    siginfo_t info = {.si_pid = 0};

    return waitid(P_PID, (id_t)j->pid, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == j->pid;
}

bool fw_job_wait_for(const fw_job *j, const char *word, int n)
{
    double end = fw_job_seconds() + 20.0;

    while (fw_job_seconds() < end) {
        char *text = fw_job_read(j->err, NULL);
        int   seen = 0;

        for (const char *at = text; at && (at = strstr(at, word)); at += strlen(word)) seen++;
        free(text);
        if (seen >= n) return true;
        fw_job_sleep(0.01);
    }
    return false;
}

void fw_job_signal(const fw_job *j, int number)
{
    kill(j->pid, number);
}

/* Parent and state of a process from /proc; false when it is gone. */
static bool job_stat(pid_t pid, pid_t *parent, char *state)
{
    char  path[64], text[512];
    FILE *f;
    char *end;
    int   ppid = 0;
    bool  is_there;

    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    f = fopen(path, "r");
    if (!f) return false;
    is_there = fgets(text, sizeof text, f) && (end = strrchr(text, ')')) &&
               sscanf(end + 1, " %c %d", state, &ppid) == 2;
    fclose(f);
    *parent = ppid;
    return is_there;
}

static int job_children(pid_t of, pid_t *children, int max)
{
    DIR           *proc = opendir("/proc");
    struct dirent *entry;
    int            n = 0;

    while (proc && n < max && (entry = readdir(proc))) {
        pid_t pid = (pid_t)strtol(entry->d_name, NULL, 10), parent;
        char  state;

        if (pid > 0 && job_stat(pid, &parent, &state) && parent == of) children[n++] = pid;
    }
    if (proc) closedir(proc);
    return n;
}

pid_t fw_job_rank(const fw_job *j, int which)
{
    pid_t children[MAX_FAMILY];
    int   n = job_children(j->pid, children, MAX_FAMILY);

    return which < n ? children[which] : 0;
}

void fw_job_kill(fw_job *j)
{
    pid_t family[MAX_FAMILY], parent;
    char  state;
    int   n = job_children(j->pid, family, MAX_FAMILY);

    kill(j->pid, SIGKILL);
    for (int i = 0; i < n; i++) kill(family[i], SIGKILL);
    waitpid(j->pid, NULL, 0);
    for (int i = 0; i < n; i++) { /* adopted by init, which may leave a zombie: that holds no lock any more */
        while (job_stat(family[i], &parent, &state) && state != 'Z') fw_job_sleep(0.002);
    }
    j->pid = 0;
}

char *fw_job_read(const char *path, size_t *n_bytes)
{
    FILE  *f    = fopen(path, "rb");
    size_t size = 1u << 16, n = 0, k;
    char  *text = f ? malloc(size + 1) : NULL;

    while (text && (k = fread(text + n, 1, size - n, f)) > 0) {
        n += k;
        if (n == size) {
            char *more = realloc(text, 2 * size + 1);

            if (!more) break;
            text = more;
            size *= 2;
        }
    }
    if (f) fclose(f);
    if (text) text[n] = '\0';
    if (n_bytes) *n_bytes = n;
    return text;
}

int fw_job_run(const char *folder, const char *name, int n_ranks, const char *const *argv)
{
    fw_job j = fw_job_start(folder, name, n_ranks, argv);

    return fw_job_wait(&j, 60.0);
}

void fw_job_make_folder(char *path, size_t size, const char *name)
{
    const char *base = getenv("TMPDIR");

    snprintf(path, size, "%s/floewear-%s-XXXXXX", base && *base ? base : ".", name);
    if (!mkdtemp(path)) {
        perror(path);
        exit(1);
    }
}

void fw_job_remove_folder(const char *path)
{
    DIR           *folder = opendir(path);
    struct dirent *entry;
    char           name[4096 + 256];

    while (folder && (entry = readdir(folder))) {
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.') unlink(name);
    }
    if (folder) closedir(folder);
    rmdir(path);
}
