#include "campaign/protocol.h"

#include <mpi.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

void fw_word_fill(fw_word *w, uint64_t hash, fw_status status, const char *text)
{
    memset(w, 0, sizeof *w);
    w->hash   = hash;
    w->status = (int32_t)status;
    gethostname(w->host, sizeof w->host - 1);
    snprintf(w->text, sizeof w->text, "%s", text ? text : "");
}

bool fw_protocol_is_on(void)
{
    int is_on = 0, is_over = 0;

    MPI_Initialized(&is_on);
    MPI_Finalized(&is_over);
    return is_on && !is_over;
}

int fw_protocol_rank(void)
{
    int rank = 0;

    if (fw_protocol_is_on()) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

int fw_protocol_ranks(void)
{
    int n = 1;

    if (fw_protocol_is_on()) MPI_Comm_size(MPI_COMM_WORLD, &n);
    return n;
}

void fw_protocol_begin(uint64_t hash, bool is_work)
{
    fw_begin begin = {.hash = hash, .is_work = is_work};
    int      n     = fw_protocol_ranks();

    for (int r = 1; r < n; r++) MPI_Send(&begin, (int)sizeof begin, MPI_BYTE, r, FW_TAG_BEGIN, MPI_COMM_WORLD);
}

void fw_nap_take(fw_nap *n)
{
    struct timespec t = {0};

    n->nanoseconds = n->nanoseconds ? n->nanoseconds * 2 : 100000;
    if (n->nanoseconds > 1000000) n->nanoseconds = 1000000;
    t.tv_nsec = n->nanoseconds;
    nanosleep(&t, NULL);
}
